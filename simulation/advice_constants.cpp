#include "simulation/advice_constants.h"

#include <array>
#include <cmath>
#include <string_view>

namespace hookpoint::simulation {
namespace {

using contact::ForceLaw;
using Constants = contact::MaterialConstants<double>;

MaterialField field_named(std::string_view name) {
  for (const MaterialField& field : material_fields()) {
    if (name == field.name) return field;
  }
  return material_fields()[0];
}

/// The first of `names` whose constant changes `prediction` when it grows by a part in a thousand.
template <class Prediction>
std::optional<MaterialField> first_that_matters(const std::array<std::string_view, 2>& names,
                                                const Constants& material,
                                                const Prediction& prediction) {
  for (const std::string_view name : names) {
    const MaterialField field = field_named(name);
    Constants more = material;
    const double value = material.*field.member;
    more.*field.member = value > 0. ? 1.001 * value : 1.;
    if (prediction(more) != prediction(material)) return field;
  }
  return std::nullopt;
}

/// x in [10^low, 10^high] with f(x) = 0 for an f that falls with x; an end where it has no zero.
template <class Function>
double bisect_decades(const Function& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (f(std::pow(10., middle)) > 0. ? low : high) = middle;
  }
  return std::pow(10., 0.5 * (low + high));
}

}  // namespace

std::optional<MaterialField> stiffness_field(const ForceLaw& law, double load,
                                             const Constants& material) {
  return first_that_matters(
      {"nominal_stiffness", "normal_stiffness"}, material,
      [&](const Constants& changed) { return contact::static_depth(law, load, changed); });
}

std::optional<MaterialField> damping_field(const ForceLaw& law, double mass, double speed,
                                           const Constants& material) {
  return first_that_matters(
      {"normal_damping", "hysteresis_damping"}, material,
      [&](const Constants& changed) { return contact::restitution(law, mass, speed, changed); });
}

double stiffness_for_depth(const ForceLaw& law, const MaterialField& field, double load,
                           double depth, Constants material) {
  return bisect_decades(
      [&](double stiffness) {
        material.*field.member = stiffness;
        return contact::static_depth(law, load, material) - depth;
      },
      -6., 18.);
}

double damping_for_rebound(const ForceLaw& law, const MaterialField& field, double mass,
                           double speed, double rebound, Constants material) {
  const auto excess = [&](double damping) {
    material.*field.member = damping;
    return contact::restitution(law, mass, speed, material) - rebound;
  };
  if (excess(0.) <= 0.) return 0.;
  return bisect_decades(excess, -12., 18.);
}

}  // namespace hookpoint::simulation
