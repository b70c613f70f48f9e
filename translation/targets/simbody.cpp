// Simbody: Hertz's contact of a ball on a plane with the dissipation of Hunt and Crossley,
// f = 4/3 E sqrt(R) d^(3/2) (1 + 3/2 c d'), and friction that is full at a transition velocity.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/bisect.h"
#include "contact/predictions.h"
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
              "c of each surface, in f (1 + 3/2 c v): rebound 1 - c v of a slow blow"},
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

/// x with 10 x^3 - 15 x^4 + 6 x^5 = `share`, which is within 0 and 1.
double stiction_part(double share) {
  return contact::bisect(
      [share](double x) { return x * x * x * (10. + x * (6. * x - 15.)) - share; }, 0., 1.);
}

Parameters nearest(const Wanted& wanted, const Situation& at) {
  const double depth = at.load / wanted.stiffness;
  Parameters result(parameters_of_simbody);
  result.set("stiffness", 0.75 * at.load / (std::sqrt(at.radius) * std::pow(depth, 1.5)) / of_pair);
  result.set("dissipation", hunt_crossley_damping(wanted, at) / 1.5);
  result.set("us", wanted.static_friction);
  result.set("ud", wanted.kinetic_friction);
  double transition = 1e-3;  // ExampleContactPlayground.cpp
  if (wanted.most_creep && holds(wanted.static_friction))
    transition = std::min(
        transition, *wanted.most_creep / stiction_part(std::tan(slope) / wanted.static_friction));
  result.set("transition_velocity", transition);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  Behaviour result;
  result.friction_shape = "cone, full at the transition velocity";
  const double modulus = parameters.number("stiffness") * of_pair;
  result.static_depth = std::pow(0.75 * at.load / (modulus * std::sqrt(at.radius)), 2. / 3.);
  const double friction = parameters.number("us");
  if (holds(friction)) {
    result.creep =
        parameters.number("transition_velocity") * stiction_part(std::tan(slope) / friction);
  } else {
    result.unknown = slides_text;
  }
  result.rebound =
      contact::hunt_crossley_restitution(1.5 * parameters.number("dissipation") * impact_speed);
  return result;
}

Wanted friction(const Parameters& parameters) {
  Wanted wanted;
  wanted.static_friction = parameters.number("us");
  wanted.kinetic_friction = parameters.number("ud");
  return wanted;
}

std::string snippet(const Parameters& parameters, const Situation& /*at*/) {
  const auto number = [&](const char* name) {
    return numbers_text(parameters.value(name).numbers);
  };
  return fmt::format(
      "// the same on both surfaces; arguments: stiffness, dissipation, us, ud, viscous\n"
      "ContactMaterial material({}, {}, {}, {}, 0);\n"
      "contactForces.setTransitionVelocity({});",
      number("stiffness"), number("dissipation"), number("us"), number("ud"),
      number("transition_velocity"));
}

std::vector<std::string> cannot(const Wanted& /*wanted*/, const Situation& at) {
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
    "simbody",
    "Simbody",
    Basis::measured,
    "Simbody, CompliantContactSubsystem.h and ContactSurface.h; Sherman, Seth & Delp 2011",
    parameters_of_simbody,
    nearest,
    behaviour,
    friction,
    snippet,
    cannot};

}  // namespace hookpoint::translation
