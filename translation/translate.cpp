#include "translation/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/predictions.h"
#include "translation/impact.h"

namespace hookpoint::translation {

Wanted wanted_of(const contact::LawDescription& law, const contact::Constants& material,
                 const Situation& at) {
  const double depth = law.static_depth(at.load, material);
  if (!(depth > 0.) || !std::isfinite(depth))
    throw NothingToTranslate(fmt::format(
        "nothing in the law `{}` holds the load by a depth in the ground, so there is no stiffness "
        "to translate",
        law.name));
  const contact::LinearContact linear = law.linearise(at.load, material);
  Wanted wanted;
  wanted.stiffness = at.load / depth;
  wanted.damping = linear.normal_damping;
  wanted.tangential_stiffness = linear.tangential_stiffness;
  wanted.tangential_damping = linear.tangential_damping;
  wanted.static_friction = material.static_friction;
  wanted.kinetic_friction = material.kinetic_friction;
  return wanted;
}

Behaviour behaviour_of(const contact::LawDescription& law, const contact::Constants& material,
                       const Situation& at) {
  Behaviour result;
  result.friction_shape = "cone";
  result.static_depth = law.static_depth(at.load, material);
  if (!holds(material.static_friction)) {
    result.unknown = slides_text;
  } else {
    result.creep = law.creep_speed(std::tan(slope), material);
    if (!result.creep) result.unknown = "the law has no closed form of creep";
  }
  result.rebound = law.restitution(at.mass, impact_speed, material);
  const contact::LinearContact linear = law.linearise(at.load, material);
  result.largest_stable_step =
      explicit_stable_step(at.mass, linear.normal_stiffness, linear.normal_damping);
  return result;
}

Translation translate_to(const Target& target, const Wanted& wanted, const Situation& at) {
  Parameters parameters = target.nearest(wanted, at);
  Behaviour behaviour = target.behaviour(parameters, at);
  return {&target, std::move(parameters), std::move(behaviour), target.cannot(wanted, at)};
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
  Reading reading{{&target, parameters, behaviour, {}}, target.friction(parameters)};
  Wanted& wanted = reading.wanted;
  wanted.stiffness = at.load / *behaviour.static_depth;
  const double zeta =
      contact::kelvin_voigt_damping_ratio(std::max(behaviour.rebound.value_or(0.), 1e-3));
  wanted.damping = behaviour.damping.value_or(2. * zeta * std::sqrt(wanted.stiffness * at.mass));
  wanted.tangential_stiffness = wanted.stiffness;
  wanted.tangential_damping = wanted.damping;
  if (behaviour.creep && *behaviour.creep > 0.) {
    // Of a spring and damper taken implicitly, c_t + dt k_t newtons per speed of creep.
    const double resistance = tangential_on_slope(at) / *behaviour.creep;
    wanted.tangential_stiffness = std::min(wanted.stiffness, 0.5 * resistance / at.deltat);
    wanted.tangential_damping = resistance - at.deltat * wanted.tangential_stiffness;
  }
  return reading;
}

}  // namespace hookpoint::translation
