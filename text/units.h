// Unit names, unit expressions (kg.m^2/s) and dimensions as text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/dimension.h"

namespace hookpoint::text {

/// A value x in this unit is x * numerator / denominator in SI. Two factors, so that 5 ms is the
/// double nearest to 0.005.
struct Unit {
  double numerator = 1., denominator = 1.;
  Dimension dimension;
};

/// A unit expression found at the beginning of a text.
struct ScannedUnit {
  Unit unit;
  std::size_t length = 0;  ///< bytes
};

/// The unit of that name ("kN"), or null.
const Unit* find_unit(std::string_view name);
/// All unit names, for suggestions and the manual.
const std::vector<std::string>& unit_names();
/// The longest unit expression with which `text` begins: known names joined by . and /, each with
/// an optional ^integer.
std::optional<ScannedUnit> scan_unit(std::string_view text);
/// A schema's unit, whole: "", "m/s", "1/m". Nothing when it is not a unit.
std::optional<Unit> parse_unit(std::string_view text);
/// "kg.m/s^2"; "" for a pure number.
std::string unit_text(const Dimension& dimension);
/// The dimension as a user reads it: "kg.m/s^2", or "no unit".
std::string describe_dimension(const Dimension& dimension);

/// Whether a value of dimension `value` may be used where `expected` is wanted: pure numbers may,
/// and a value without angle (5 N.m) fits one per angle (N.m/rad).
bool fits(const Dimension& value, const Dimension& expected);
/// Whether the two may be added or compared; they may differ in angle when one has none (pi/2 + 5
/// deg).
bool comparable(const Dimension& a, const Dimension& b);

Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
/// Every exponent times `exponent`.
Dimension power(const Dimension& dimension, int exponent);

}  // namespace hookpoint::text
