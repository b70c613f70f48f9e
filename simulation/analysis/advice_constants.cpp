#include "simulation/analysis/advice_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "math/bisect.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

/// x in [10^low, 10^high] with f(x) = 0 for an f that falls with x; an end where it has no zero.
/// The zero is bracketed from below: far beyond it a prediction that is integrated may not be had.
template <class Function>
double bisect_decades(const Function& f, double low, double high) {
  if (f(std::pow(10., low)) <= 0.) return std::pow(10., low);
  while (low < high && f(std::pow(10., low + 1.)) > 0.) low += 1.;
  if (low >= high) return std::pow(10., high);
  return std::pow(10., bisect([&](double x) { return -f(std::pow(10., x)); }, low, low + 1.));
}

}  // namespace

MaterialField field_named(std::string_view name) {
  for (const MaterialField& field : material_fields()) {
    if (name == field.name) return field;
  }
  throw std::logic_error(fmt::format("a Material has no constant `{}`", name));
}

std::optional<MaterialField> stiffness_field(const contact::LawDescription& law) {
  const contact::Constant stiffness = law.normal_constants.stiffness;
  return stiffness == nullptr ? std::nullopt : std::optional(field_of(stiffness));
}

std::optional<MaterialField> damping_field(const contact::LawDescription& law) {
  const contact::Constant damping = law.normal_constants.damping;
  return damping == nullptr ? std::nullopt : std::optional(field_of(damping));
}

double stiffness_for_depth(const contact::LawDescription& law, const MaterialField& field,
                           double load, double depth, Constants material) {
  return bisect_decades(
      [&](double stiffness) {
        material.*field.member = stiffness;
        return law.static_depth(load, material) - depth;
      },
      -6., 18.);
}

bool carries_above_ground(const contact::LawDescription& law, double load, double share,
                          const Constants& material) {
  return law.static_depth(share * load, material) < 0.;
}

Constants exponential_for_depth(double load, double depth, double share, Constants material) {
  // d1 exp(d2 (d + d0)) = W and d1 exp(d2 d0) = s W (docs/advice.md).
  material.exponential_rate = -std::log(share) / depth;
  material.exponential_force =
      share * load * std::exp(-material.exponential_rate * material.exponential_height);
  return material;
}

double damping_for_rebound(const contact::LawDescription& law, const MaterialField& field,
                           double mass, double speed, double rebound, Constants material) {
  const auto excess = [&](double damping) {
    material.*field.member = damping;
    return law.restitution(mass, speed, material) - rebound;
  };
  if (excess(0.) <= 0.) return 0.;
  return bisect_decades(excess, -12., 18.);
}

}  // namespace hookpoint::simulation
