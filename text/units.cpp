#include "text/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <numbers>

namespace hookpoint::text {
namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr Dimension one{}, mass{1, 0, 0, 0}, length{0, 1, 0, 0}, time{0, 0, 1, 0},
    angle{0, 0, 0, 1};
constexpr Dimension frequency{0, 0, -1, 0}, force{1, 1, -2, 0}, energy{1, 2, -2, 0};
constexpr Dimension watts{1, 2, -3, 0}, pressure{1, -1, -2, 0}, angular_rate{0, 0, -1, 1};
constexpr double pi = std::numbers::pi;

constexpr std::array units{
    NamedUnit{"kg", {1., 1., mass}},
    NamedUnit{"g", {1., 1e3, mass}},
    NamedUnit{"mg", {1., 1e6, mass}},
    NamedUnit{"m", {1., 1., length}},
    NamedUnit{"km", {1e3, 1., length}},
    NamedUnit{"cm", {1., 1e2, length}},
    NamedUnit{"mm", {1., 1e3, length}},
    NamedUnit{"um", {1., 1e6, length}},
    NamedUnit{"s", {1., 1., time}},
    NamedUnit{"ms", {1., 1e3, time}},
    NamedUnit{"us", {1., 1e6, time}},
    NamedUnit{"ns", {1., 1e9, time}},
    NamedUnit{"min", {60., 1., time}},
    NamedUnit{"h", {3600., 1., time}},
    NamedUnit{"Hz", {1., 1., frequency}},
    NamedUnit{"kHz", {1e3, 1., frequency}},
    NamedUnit{"N", {1., 1., force}},
    NamedUnit{"mN", {1., 1e3, force}},
    NamedUnit{"kN", {1e3, 1., force}},
    NamedUnit{"MN", {1e6, 1., force}},
    NamedUnit{"J", {1., 1., energy}},
    NamedUnit{"mJ", {1., 1e3, energy}},
    NamedUnit{"kJ", {1e3, 1., energy}},
    NamedUnit{"W", {1., 1., watts}},
    NamedUnit{"kW", {1e3, 1., watts}},
    NamedUnit{"Pa", {1., 1., pressure}},
    NamedUnit{"kPa", {1e3, 1., pressure}},
    NamedUnit{"MPa", {1e6, 1., pressure}},
    NamedUnit{"GPa", {1e9, 1., pressure}},
    NamedUnit{"rad", {1., 1., angle}},
    NamedUnit{"mrad", {1., 1e3, angle}},
    NamedUnit{"deg", {pi, 180., angle}},
    NamedUnit{"rpm", {pi, 30., angular_rate}},
    NamedUnit{"%", {1., 1e2, one}},
};

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
  return at;
}

std::size_t name_end(std::string_view text, std::size_t at) {
  if (at < text.size() && text[at] == '%') return at + 1;
  while (at < text.size() && is_letter(text[at])) ++at;
  return at;
}

Unit multiply(const Unit& a, const Unit& b) {
  return {a.numerator * b.numerator, a.denominator * b.denominator, a.dimension * b.dimension};
}

Unit raise(const Unit& unit, int exponent) {
  Unit result;
  const Unit base =
      exponent < 0 ? Unit{unit.denominator, unit.numerator, power(unit.dimension, -1)} : unit;
  for (int i = 0; i < std::abs(exponent); ++i) result = multiply(result, base);
  return result;
}

/// `^2` or `^-1` at `at`: moves `at` behind it. An exponent that is no small whole number is left
/// to the expression.
int scan_exponent(std::string_view text, std::size_t& at) {
  std::size_t cursor = skip_blanks(text, at);
  if (cursor >= text.size() || text[cursor] != '^') return 1;
  cursor = skip_blanks(text, cursor + 1);
  int exponent = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + cursor, end, exponent);
  const bool decimal =
      stop < end && (is_letter(*stop) || (*stop == '.' && stop + 1 < end &&
                                          std::isdigit(static_cast<unsigned char>(stop[1]))));
  if (error != std::errc{} || decimal || std::abs(exponent) > 9) return 1;
  at = static_cast<std::size_t>(stop - text.data());
  return exponent;
}

/// One factor, `m` or `s^2`, from `at`: moves `at` behind it.
std::optional<Unit> scan_factor(std::string_view text, std::size_t& at) {
  const std::size_t begin = skip_blanks(text, at), end = name_end(text, begin);
  const Unit* unit = find_unit(text.substr(begin, end - begin));
  if (unit == nullptr) return std::nullopt;
  at = end;
  return raise(*unit, scan_exponent(text, at));
}

void append_factor(std::string& text, std::string_view name, int exponent) {
  if (exponent == 0) return;
  if (!text.empty() && text.back() != '/') text += '.';
  text += name;
  if (exponent != 1) text += '^' + std::to_string(exponent);
}

}  // namespace

const Unit* find_unit(std::string_view name) {
  for (const NamedUnit& unit : units) {
    if (unit.name == name) return &unit.unit;
  }
  return nullptr;
}

const std::vector<std::string>& unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const NamedUnit& unit : units) all.emplace_back(unit.name);
    return all;
  }();
  return names;
}

std::optional<ScannedUnit> scan_unit(std::string_view text) {
  std::size_t at = 0;
  const std::optional<Unit> first = scan_factor(text, at);
  if (!first) return std::nullopt;
  ScannedUnit scanned{*first, at};
  while (true) {
    std::size_t cursor = skip_blanks(text, at);
    if (cursor >= text.size() || (text[cursor] != '.' && text[cursor] != '/')) return scanned;
    const bool divide = text[cursor] == '/';
    const std::optional<Unit> factor = scan_factor(text, ++cursor);
    if (!factor) return scanned;
    scanned.unit = multiply(scanned.unit, divide ? raise(*factor, -1) : *factor);
    scanned.length = at = cursor;
  }
}

std::optional<Unit> parse_unit(std::string_view text) {
  if (text.empty() || text == "1") return Unit{};
  if (text.starts_with("1/")) {
    const std::optional<Unit> inverse = parse_unit(text.substr(2));
    return inverse ? std::optional(raise(*inverse, -1)) : std::nullopt;
  }
  const std::optional<ScannedUnit> scanned = scan_unit(text);
  if (!scanned || scanned->length != text.size()) return std::nullopt;
  return scanned->unit;
}

std::string unit_text(const Dimension& dimension) {
  if (dimension == force) return "N";
  if (dimension == energy) return "N.m";
  std::string above, below;
  const std::array<std::pair<std::string_view, int>, 4> factors{{{"kg", dimension.mass},
                                                                 {"m", dimension.length},
                                                                 {"rad", dimension.angle},
                                                                 {"s", dimension.time}}};
  const bool any_above =
      std::ranges::any_of(factors, [](const auto& factor) { return factor.second > 0; });
  for (const auto& [name, exponent] : factors) {
    if (exponent > 0 || !any_above) append_factor(above, name, exponent);
    if (exponent < 0 && any_above) {
      below += '/';
      append_factor(below, name, -exponent);
    }
  }
  return above + below;
}

std::string describe_dimension(const Dimension& dimension) {
  return dimension.dimensionless() ? "no unit" : unit_text(dimension);
}

bool fits(const Dimension& value, const Dimension& expected) {
  if (value.dimensionless()) return true;
  return value.mass == expected.mass && value.length == expected.length &&
         value.time == expected.time && (value.angle == expected.angle || value.angle == 0);
}

bool comparable(const Dimension& a, const Dimension& b) {
  return a.mass == b.mass && a.length == b.length && a.time == b.time &&
         (a.angle == b.angle || a.angle == 0 || b.angle == 0);
}

Dimension operator*(const Dimension& a, const Dimension& b) {
  return {a.mass + b.mass, a.length + b.length, a.time + b.time, a.angle + b.angle};
}

Dimension operator/(const Dimension& a, const Dimension& b) { return a * power(b, -1); }

Dimension power(const Dimension& dimension, int exponent) {
  return {dimension.mass * exponent, dimension.length * exponent, dimension.time * exponent,
          dimension.angle * exponent};
}

}  // namespace hookpoint::text
