#include "studies/search/material_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "output/figures/plot.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// The number of 15 digits that the value differs from by no more than the factor of a unit adds,
/// else the value: 20.2421 kN/m is 20242.1 N/m, not 20242.100000000002 N/m.
double without_noise_of_units(double value) {
  constexpr int digits = 15;
  char text[32];
  const auto written =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  double shorter = value;
  std::from_chars(text, written.ptr, shorter);
  const double noise = 2. * std::numeric_limits<double>::epsilon() * std::abs(value);
  return std::abs(shorter - value) <= noise ? shorter : value;
}

/// In SI; "1/m" is no unit that a file may write after a number.
std::string field_line(const language::Field& field) {
  const std::string& unit = field.schema->unit;
  const bool named = !unit.empty() && (unit.front() < '0' || unit.front() > '9');
  return fmt::format("  {} = {}{};\n", field.schema->name,
                     text::shortest(without_noise_of_units(field.numbers.front())),
                     named ? " " + unit : "");
}

}  // namespace

std::string comment_line(const std::string& text) { return "// " + output::one_line(text) + "\n"; }

std::string material_block(const language::Object& material, const std::string& name) {
  std::string text = "Material " + name + " {\n";
  for (const language::Field& field : material.fields)
    if (!field.numbers.empty()) text += field_line(field);
  return text + "}\n";
}

}  // namespace hookpoint::studies
