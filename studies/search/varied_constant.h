// A constant of a scene that a search varies, from its Vary block.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/blocks/written_values.h"
#include "studies/search/varied_scene.h"

namespace hookpoint::studies {

/// A Vary block. Values are in the unit that its author wrote, to six digits: what stands in a
/// file is what was run.
struct VariedConstant {
  std::string name;
  ConstantPlace place = ConstantPlace::parameter;
  WrittenUnit unit;
  double from = 0., to = 1.;
  bool logarithmic = false;
  language::Position from_place = {}, to_place = {};  ///< of the ends of the range

  /// The value at a share 0..1 of the range.
  double at(double share) const;
  /// The share of the range at which a value lies, 0 below and 1 above it.
  double share_of(double value) const;
  ConstantSetting setting(double value) const;
};

/// Of a Vary block; errors go to `diagnostics`, nothing where the scene has no such constant.
std::optional<VariedConstant> varied_constant(const language::Object& block,
                                              const VariedScene& scene,
                                              language::Diagnostics& diagnostics);

/// The range of a Vary block, whatever it is of; errors go to `diagnostics`.
VariedConstant varied_range(const language::Object& block, language::Diagnostics& diagnostics);

/// Reports what was found with constants at the ends `greatest` of their ranges: what is wrong with
/// the value of one stands there in its Vary block.
void report_at_ends(const language::Diagnostics& found, std::span<const VariedConstant> constants,
                    const VariedScene& scene, bool greatest, language::Diagnostics& diagnostics);

/// Reports each end of a range that the scene does not take, the other constants left alone.
void check_ends(std::span<const VariedConstant> constants, const VariedScene& scene,
                language::Diagnostics& diagnostics);

/// Reports the Fix blocks of `owner` that set one of the constants: a run would ignore them.
void refuse_fixed(const language::Object& owner, std::span<const VariedConstant> constants,
                  language::Diagnostics& diagnostics);

/// `value` with six significant digits.
double to_six_digits(double value);

/// What these values set in the scene, one a constant; of no values nothing.
std::vector<ConstantSetting> settings_of(std::span<const VariedConstant> constants,
                                         std::span<const double> values);

}  // namespace hookpoint::studies
