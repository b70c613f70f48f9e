#include "contact/combination.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hookpoint::contact {
namespace {

using Constants = MaterialConstants<double>;
using Constant = double Constants::*;

double in_series(double a, double b) { return a + b > 0. ? a * b / (a + b) : 0.; }

constexpr std::array table{
    CombinationRule{Combination::foot, "foot", "a", [](double a, double /*b*/) { return a; }},
    CombinationRule{Combination::ground, "ground", "b", [](double /*a*/, double b) { return b; }},
    CombinationRule{Combination::minimum, "minimum", "min(a, b)",
                    [](double a, double b) { return std::min(a, b); }},
    CombinationRule{Combination::maximum, "maximum", "max(a, b)",
                    [](double a, double b) { return std::max(a, b); }},
    CombinationRule{Combination::product, "product", "a b",
                    [](double a, double b) { return a * b; }},
    CombinationRule{Combination::geometric, "geometric", "sqrt(a b)",
                    [](double a, double b) { return std::sqrt(a * b); }},
    CombinationRule{Combination::harmonic, "harmonic", "2 a b/(a + b)",
                    [](double a, double b) { return 2. * in_series(a, b); }},
    CombinationRule{Combination::series, "series", "a b/(a + b)", in_series},
};

constexpr std::array<Constant, 5> springs{
    &Constants::normal_stiffness, &Constants::normal_damping, &Constants::tangential_stiffness,
    &Constants::tangential_damping, &Constants::nominal_stiffness};
constexpr std::array<Constant, 6> coefficients{
    &Constants::static_friction,    &Constants::kinetic_friction,    &Constants::restitution,
    &Constants::rolling_resistance, &Constants::spinning_resistance, &Constants::adhesion};

double across(const Constants& material) {
  return material.friction_across > 0. ? material.friction_across : material.kinetic_friction;
}

}  // namespace

std::span<const CombinationRule> combination_rules() { return table; }

std::vector<std::string> combination_names() {
  std::vector<std::string> names;
  for (const CombinationRule& row : table) names.emplace_back(row.name);
  return names;
}

Constants combine(const Constants& foot, const Constants& ground, Combination rule) {
  Constants made = rule == Combination::ground ? ground : foot;
  const CombinationRule& row = table[static_cast<std::size_t>(rule)];
  for (const Constant spring : springs) made.*spring = in_series(foot.*spring, ground.*spring);
  for (const Constant coefficient : coefficients)
    made.*coefficient = row.combine(foot.*coefficient, ground.*coefficient);
  made.friction_across = foot.friction_across > 0. || ground.friction_across > 0.
                             ? row.combine(across(foot), across(ground))
                             : 0.;
  return made;
}

}  // namespace hookpoint::contact
