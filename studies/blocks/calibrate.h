// The Calibrate block itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "language/schema/schema.h"
#include "studies/blocks/varied_scene.h"

namespace hookpoint::studies {

/// How the correlations of the constants are found.
enum class Bootstrap {
  refits,   ///< every sample is fitted from the optimum on
  one_step  ///< every sample is solved with the model linearised at the optimum
};

/// What is made least, and how.
enum class FitMethod {
  least_squares,  ///< the sum of all squares, by derivatives
  cmaes           ///< the mean distance, without derivatives
};

/// How much is fitted, and how.
struct CalibrationWork {
  std::size_t folds = 5;  ///< of the cases; fewer than 2: no cross-validation
  std::size_t resamples = 200;
  Bootstrap bootstrap = Bootstrap::one_step;
  std::size_t starts = 16;
  FitMethod method = FitMethod::least_squares;
  int population = 12, generations = 10;  ///< of cmaes
  std::size_t most_cases = 0;             ///< that a search of cmaes looks at; 0: all
  std::uint64_t seed = 1;
};

struct CalibrateBlock : VariedSceneBlock, CalibrationWork {
  Placed<std::vector<std::string>> subjects;
};

void add_calibrate_class(language::Schema& schema);

/// Under --quick with less work.
CalibrateBlock load_calibrate(const language::Object& block, bool quick);

}  // namespace hookpoint::studies
