#include "studies/search/varied_constant.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "language/names.h"
#include "studies/blocks/vary.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

double to_six_digits(double value) {
  char digits[32];
  const auto written =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 5);
  std::from_chars(digits, written.ptr, value);
  return value;
}

std::optional<VariedConstant> varied_constant(const Object& block, const VariedScene& scene,
                                              Diagnostics& diagnostics) {
  const auto place = scene.place_of(block.name);
  if (!place) {
    diagnostics.error(block.position,
                      fmt::format("neither the terrain nor the scene has a Param `{}`, nor "
                                  "their Material or World a number of that name{}",
                                  block.name, language::did_you_mean(block.name, scene.names())));
    return std::nullopt;
  }
  VariedConstant constant = varied_range(block, diagnostics);
  constant.place = *place;
  return constant;
}

VariedConstant varied_range(const Object& block, Diagnostics& diagnostics) {
  VaryRange range = load_vary(block, diagnostics);
  return {block.name, ConstantPlace::parameter, std::move(range.unit), range.from,
          range.to,   range.logarithmic,        range.from_place,      range.to_place};
}

void report_at_ends(const Diagnostics& found, std::span<const VariedConstant> constants,
                    const VariedScene& scene, bool greatest, Diagnostics& diagnostics) {
  for (const language::Diagnostic& diagnostic : found.all()) {
    language::Position place = diagnostic.position;
    for (const VariedConstant& constant : constants) {
      const std::string trail = scene.trail_of(constant.name, constant.place);
      if (place.file != nullptr && place.file->path == "<--set " + trail + ">")
        place = greatest ? constant.to_place : constant.from_place;
    }
    diagnostics.report_again(diagnostic, place);
  }
}

void check_ends(std::span<const VariedConstant> constants, const VariedScene& scene,
                Diagnostics& diagnostics) {
  for (const VariedConstant& constant : constants)
    for (const bool greatest : {false, true}) {
      const double end = greatest ? constant.to : constant.from;
      Diagnostics found;
      if (scene.load(std::vector{constant.setting(end)}, 1, found)) continue;
      report_at_ends(found, {&constant, 1}, scene, greatest, diagnostics);
      diagnostics.note(greatest ? constant.to_place : constant.from_place,
                       fmt::format("with `{}` at this end of its range", constant.name));
    }
}

void refuse_fixed(const Object& owner, std::span<const VariedConstant> constants,
                  Diagnostics& diagnostics) {
  for (const Object* fix : owner.children_of("Fix"))
    if (std::ranges::find(constants, fix->name, &VariedConstant::name) != constants.end())
      diagnostics.error(fix->position,
                        fmt::format("`{}` is varied: it cannot be fixed as well", fix->name));
}

double VariedConstant::at(double share) const {
  return to_six_digits(logarithmic ? from * std::pow(to / from, share)
                                   : from + share * (to - from));
}

double VariedConstant::share_of(double value) const {
  if (!(value > from)) return 0.;
  if (!(value < to)) return 1.;
  return logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
}

ConstantSetting VariedConstant::setting(double value) const {
  return {place, name, unit.with_unit(value)};
}

std::vector<ConstantSetting> settings_of(std::span<const VariedConstant> constants,
                                         std::span<const double> values) {
  std::vector<ConstantSetting> settings;
  for (std::size_t i = 0; i < values.size(); ++i)
    settings.push_back(constants[i].setting(values[i]));
  return settings;
}

}  // namespace hookpoint::studies
