// What both generators of experiments draw from: names, numbers and values of the schema's fields.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "language/schema/describe.h"
#include "language/schema/schema.h"
#include "tests/support/drawn.h"

namespace hookpoint::fuzz {

using language::FieldSchema;

/// Where values of a unit usually lie: magnitudes, log-uniform.
struct Usual {
  double least, greatest;
};

inline Usual usual(const std::string& unit) {
  static const std::map<std::string, Usual> table{
      {"m", {0.02, 0.5}},     {"kg", {0.1, 5.}},       {"rad", {0.02, 1.5}},
      {"s", {1e-3, 0.1}},     {"m/s", {0.01, 1.}},     {"rad/s", {0.01, 3.}},
      {"N", {0.1, 30.}},      {"N.m", {0.1, 10.}},     {"N/m", {1e3, 1e5}},
      {"N.s/m", {1., 300.}},  {"Hz", {20., 1000.}},    {"m/s^2", {1., 10.}},
      {"N.m/rad", {1., 50.}}, {"kg.m^2", {1e-3, 0.1}}, {"N.m.s/rad", {0.01, 1.}}};
  const auto found = table.find(unit);
  return found == table.end() ? Usual{0.1, 2.} : found->second;
}

/// A text that grows by what is drawn. Of three seeds one draws no degenerate value, one a few, one
/// many.
class DrawnText {
 public:
  DrawnText(const language::Schema& schema, std::uint64_t seed)
      : schema_(schema),
        random_(seed * 2654435761u + 1),
        degenerate_(seed % 3 == 0   ? 0.
                    : seed % 3 == 1 ? 0.01
                                    : 0.08) {}

 protected:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  bool chance(double part) { return test_support::drawn_part(random_) < part; }
  double between(double least, double greatest) {
    return test_support::drawn(random_, least, greatest);
  }
  template <class Element>
  const Element& one_of(const std::vector<Element>& list) {
    return list[below(list.size())];
  }

  void write(const std::string& line) { text_ += line + "\n"; }
  static std::string number(double value) { return language::number_text(value); }
  const std::vector<std::string>& choices(const std::string& type, const std::string& field) {
    return schema_.find(type)->find(field)->choices;
  }

  static bool in_range(const FieldSchema& field, double value) {
    const bool above = field.exclusive_minimum ? value > field.minimum : value >= field.minimum;
    const bool below = field.exclusive_maximum ? value < field.maximum : value <= field.maximum;
    return above && below;
  }

  double degenerate_number(const FieldSchema& field) {
    static constexpr std::array values{0.,  -1.,  5e-324, 1e-300,  1e-12,  1e-6,
                                       1e6, 1e12, 1e300,  1.7e308, -1e-12, -1e12};
    for (int tries = 0; tries < 8; ++tries) {
      const double value = values[below(values.size())];
      if (in_range(field, value) || chance(0.03)) return value;
    }
    return std::isfinite(field.minimum) && !field.exclusive_minimum ? field.minimum : 1.;
  }

  double usual_number(const FieldSchema& field) {
    Usual range = usual(field.unit);
    char* end = nullptr;
    const double preset = std::strtod(field.default_text.c_str(), &end);
    if (end != field.default_text.c_str() && *end == '\0' && preset != 0. &&
        std::abs(preset) < 1e6 && chance(0.7))
      range = {0.3 * std::abs(preset), 3. * std::abs(preset)};
    double value = range.least * std::pow(range.greatest / range.least, between(0., 1.));
    if (field.minimum < 0. && chance(0.4)) value = -value;
    value = std::min(std::max(value, field.minimum), field.maximum);
    return in_range(field, value) ? value : 1.;
  }

  std::string one_number(const FieldSchema& field) {
    return number(chance(degenerate_) ? degenerate_number(field) : usual_number(field));
  }

  const language::Schema& schema_;
  std::mt19937_64 random_;
  const double degenerate_;  ///< part of values that are
  std::string text_;
};

}  // namespace hookpoint::fuzz
