#include "translation/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/predictions.h"
#include "translation/impact.h"

namespace hookpoint::translation {

DesiredContact desired_of(const contact::LawDescription& law, const contact::Constants& material,
                          const Situation& at) {
  const double depth = law.static_depth(at.load, material);
  if (!(depth > 0.) || !std::isfinite(depth))
    throw NothingToTranslate(fmt::format(
        "nothing in the law `{}` holds the load by a depth in the ground, so there is no stiffness "
        "to translate",
        law.name));
  const contact::LinearContact linear = law.linearise(at.load, material);
  DesiredContact desired;
  desired.stiffness = at.load / depth;
  desired.damping = linear.normal_damping;
  desired.tangential_stiffness = linear.tangential_stiffness;
  desired.tangential_damping = linear.tangential_damping;
  desired.static_friction = material.static_friction;
  desired.kinetic_friction = material.kinetic_friction;
  return desired;
}

Behaviour behaviour_of(const contact::LawDescription& law, const contact::Constants& material,
                       const Situation& at) {
  Behaviour result;
  result.friction_shape = "cone";
  result.static_depth = law.static_depth(at.load, material);
  const auto creep = law.creep_speed(std::tan(slope), material);
  if (holds(material.static_friction) && !creep)
    result.add_unknown("the law has no closed form of creep");
  else
    result.set_creep(material.static_friction, creep.value_or(0.));
  result.rebound = law.restitution(at.mass, impact_speed, material);
  const contact::LinearContact linear = law.linearise(at.load, material);
  result.largest_stable_step =
      explicit_stable_step(at.mass, linear.normal_stiffness, linear.normal_damping);
  return result;
}

Translation translate_to(const Target& target, const DesiredContact& desired, const Situation& at) {
  Parameters parameters = target.nearest(desired, at);
  Behaviour behaviour = target.behaviour(parameters, at);
  return {&target, std::move(parameters), std::move(behaviour), target.cannot(desired, at)};
}

Reading read_from(const Target& target, const std::vector<std::string>& settings,
                  const Situation& at) {
  Parameters parameters(target.parameters);
  for (const std::string& setting : settings) parameters.read(setting);
  const Behaviour behaviour = target.behaviour(parameters, at);
  if (behaviour.rigid || !behaviour.static_depth || !(*behaviour.static_depth > 0.))
    throw ParameterError(
        fmt::format("a contact of {} with these parameters has no stiffness to read{}{}",
                    target.title, behaviour.unknown.empty() ? "" : ": ", behaviour.unknown));
  Reading reading{{&target, parameters, behaviour, {}}, {}};
  DesiredContact& desired = reading.desired;
  desired.static_friction = parameters.number(target.static_friction);
  desired.kinetic_friction = parameters.number(target.kinetic_friction);
  desired.stiffness = at.load / *behaviour.static_depth;
  const double zeta =
      contact::kelvin_voigt_damping_ratio(std::max(behaviour.rebound.value_or(0.), 1e-3));
  desired.damping = behaviour.damping.value_or(2. * zeta * std::sqrt(desired.stiffness * at.mass));
  desired.tangential_stiffness = desired.stiffness;
  desired.tangential_damping = desired.damping;
  if (behaviour.creep && *behaviour.creep > 0.) {
    // Of a spring and damper taken implicitly, c_t + dt k_t newtons per speed of creep.
    const double resistance = tangential_on_slope(at) / *behaviour.creep;
    desired.tangential_stiffness = std::min(desired.stiffness, 0.5 * resistance / at.deltat);
    desired.tangential_damping = resistance - at.deltat * desired.tangential_stiffness;
  }
  return reading;
}

}  // namespace hookpoint::translation
