// Simbody: Hertz's contact of a ball on a plane with the dissipation of Hunt and Crossley,
// f = 4/3 E sqrt(R) d^(3/2) (1 + 3/2 c d'), and friction that is full at a transition velocity.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/predictions.h"
#include "reference/simbody/creep.h"
#include "reference/simbody/settings.h"
#include "translation/damping.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_simbody{
    Parameter{
        "stiffness",
        "Pa",
        {{1e7}, ""},
        {},
        "plane strain modulus E of each surface. Two like ones make E/2^(3/2), so the force is "
        "4/3 E/2^(3/2) sqrt(R) d^(3/2) [N] of a ball of radius R",
        1e-9},
    Parameter{"dissipation",
              "s/m",
              {{0.}, ""},
              {},
              "c of each surface, in f (1 + 3/2 c v): rebound 1 - c v of a slow impact"},
    Parameter{
        "us", "1", {{0.}, ""}, {}, "static friction of each surface; of two 2 us1 us2/(us1 + us2)"},
    Parameter{"ud", "1", {{0.}, ""}, {}, "dynamic friction, as us"},
    Parameter{"transition_velocity",
              "m/s",
              {{0.01}, ""},
              {},
              "speed at which friction is full: a foot that stands creeps at a part of it",
              1e-12},
};

/// E of the pair over that of each of two like surfaces: k = E^(2/3) in series.
const double of_pair = std::pow(0.5, 1.5);

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  const double depth = at.load / desired.stiffness;
  Parameters result(parameters_of_simbody);
  result.set("stiffness", 0.75 * at.load / (std::sqrt(at.radius) * std::pow(depth, 1.5)) / of_pair);
  result.set("dissipation", hunt_crossley_damping(desired, at) / 1.5);
  result.set("us", desired.static_friction);
  result.set("ud", desired.kinetic_friction);
  double transition =
      reference::simbody_settings(reference::Settings::recommended).transition_velocity;
  if (desired.most_creep && holds(desired.static_friction))
    transition =
        std::min(transition, *desired.most_creep / reference::simbody_stiction_speed(
                                                       std::tan(slope) / desired.static_friction));
  result.set("transition_velocity", transition);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  Behaviour result;
  result.friction_shape = "cone, full at the transition velocity";
  const double modulus = parameters.number("stiffness") * of_pair;
  result.static_depth = std::pow(0.75 * at.load / (modulus * std::sqrt(at.radius)), 2. / 3.);
  const double friction = parameters.number("us");
  const double share = std::min(1., std::tan(slope) / friction);
  result.set_creep(friction, parameters.number("transition_velocity") *
                                 reference::simbody_stiction_speed(share));
  result.rebound =
      contact::hunt_crossley_restitution(1.5 * parameters.number("dissipation") * impact_speed);
  return result;
}

std::string snippet(const Parameters& parameters, const Situation& /*at*/) {
  return fmt::format(
      "// the same on both surfaces; arguments: stiffness, dissipation, us, ud, viscous\n"
      "ContactMaterial material({}, {}, {}, {}, 0);\n"
      "contactForces.setTransitionVelocity({});",
      parameters.text("stiffness"), parameters.text("dissipation"), parameters.text("us"),
      parameters.text("ud"), parameters.text("transition_velocity"));
}

std::vector<std::string> cannot(const DesiredContact& /*desired*/, const Situation& at) {
  return {
      fmt::format(
          "it has no linear spring. Hertz's force goes with depth^(3/2): the depth is right "
          "at {} N and for a ball of radius {} m (--radius) alone",
          numbers_text({at.load}), numbers_text({at.radius})),
      fmt::format("its damping goes with the force: the rebound is right at {} m/s alone",
                  numbers_text({impact_speed})),
      "friction has no spring: a foot on a slope creeps at a part of the transition velocity, whose "
      "smaller values cost steps"};
}

}  // namespace

const Target simbody_target{
    .name = "simbody",
    .title = "Simbody",
    .basis = Basis::measured,
    .source =
        "Simbody, CompliantContactSubsystem.h and ContactSurface.h; Sherman, Seth & Delp 2011",
    .parameters = parameters_of_simbody,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "us",
    .kinetic_friction = "ud",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
