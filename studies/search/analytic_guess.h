// The first guess of a search: what `advise` derives from weight, penetration and rebound, in terms
// of the constants that are varied.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/search/varied_constant.h"

namespace hookpoint::studies {

/// A scene and the constants of it that are searched.
struct SearchedScene {
  const VariedScene& scene;
  std::span<const VariedConstant> varied;
  std::span<const std::optional<double>> own;  ///< values of the files themselves, one a constant
};

struct AnalyticGuess {
  std::vector<double> values;  ///< one a constant, in its unit, within its range
  std::string words;           ///< how it was come by
};

/// Advice on the scene with its own constants (simulation/analysis/advice.h). A varied field of the
/// Material takes what is advised for it; of varied Params those values are taken with which the
/// Material's constants come nearest, in the sum of their squared logarithmic distances, to the
/// advised ones. A constant that advice does not speak of keeps its own value. Under a peer or an
/// impulse law advice is for the law `hookpoint`. Nothing, with the reason in `why`, where there is
/// none to be had.
std::optional<AnalyticGuess> analytic_guess(const SearchedScene& searched, std::string& why);

}  // namespace hookpoint::studies
