// Newton, and warp.sim before it: SolverSemiImplicit's f = ke d + kd v while it approaches, ke d while
// it leaves, and friction kf v up to mu f (kernels_contact.py, eval_body_contact).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "translation/damping.h"
#include "translation/impact.h"
#include "translation/targets.h"

namespace hookpoint::translation {
namespace {

const std::array parameters_of_newton{
    Parameter{
        "ke", "N/m", {{2.5e3}, ""}, {}, "stiffness: of both shapes the mean, not in series", 1e-9},
    Parameter{"kd",
              "N s/m",
              {{100.}, ""},
              {},
              "damping while the contact approaches; none while it leaves; the mean"},
    Parameter{
        "kf",
        "N s/m",
        {{1000.}, ""},
        {},
        "damping of friction below its limit: a contact that stands creeps at f_t/kf; the mean",
        1e-9},
    Parameter{"mu", "1", {{0.5}, ""}, {}, "coefficient of friction; the mean"},
};

Parameters nearest(const DesiredContact& desired, const Situation& at) {
  Parameters result(parameters_of_newton);
  result.set("ke", desired.stiffness);
  result.set("kd", one_sided_damping(desired, at));
  // Half of what the step bears.
  result.set("kf", std::min(1. / desired_mixing(desired, at), at.mass / at.deltat));
  result.set("mu", desired.kinetic_friction);
  return result;
}

Behaviour behaviour(const Parameters& parameters, const Situation& at) {
  const double ke = parameters.number("ke"), kd = parameters.number("kd");
  Behaviour result;
  result.friction_shape = "cone, smoothed (friction_smoothing)";
  result.static_depth = at.load / ke;
  result.set_creep(parameters.number("mu"), tangential_on_slope(at) / parameters.number("kf"));
  const double stable = explicit_stable_step(at.mass, ke, kd);
  result.largest_stable_step = std::min(stable, 2. * at.mass / parameters.number("kf"));
  if (at.deltat > *result.largest_stable_step) {
    result.add_unknown("the step is above the largest stable one");
  } else {
    predict_rebound(result, at, [&](double depth, double approach) {
      return depth > 0. ? ke * depth + kd * std::max(0., approach) : 0.;
    });
  }
  return result;
}

std::string snippet(const Parameters& parameters, const Situation& /*at*/) {
  return fmt::format(
      "# the same on both shapes: their mean counts; for SolverSemiImplicit and SolverFeatherstone\n"
      "cfg = newton.ModelBuilder.ShapeConfig(ke={}, kd={}, kf={}, mu={}, ka=0.0)",
      parameters.text("ke"), parameters.text("kd"), parameters.text("kf"), parameters.text("mu"));
}

std::vector<std::string> cannot(const DesiredContact& desired, const Situation& /*at*/) {
  std::vector<std::string> notes = notes_on_friction(desired);
  notes.emplace_back(
      "its damper acts on approach alone: kd gives the same rebound, other speeds in between");
  notes.emplace_back(
      "friction has no spring, so a foot on a slope creeps; a greater kf creeps less and needs a smaller step");
  notes.emplace_back(
      "friction near rest is smoothed over friction_smoothing (1 m/s): below it a foot may be held by more than "
      "mu f");
  notes.emplace_back(
      "SolverXPBD reads mu alone of these; SolverMuJoCo takes ke and kd per unit of mass: translate to mujoco");
  return notes;
}

}  // namespace

const Target newton_target{
    .name = "newton",
    .title = "Newton (and warp.sim)",
    .basis = Basis::formula,
    .source = "newton, newton/_src/solvers/semi_implicit/kernels_contact.py, eval_body_contact",
    .parameters = parameters_of_newton,
    .nearest = nearest,
    .behaviour = behaviour,
    .static_friction = "mu",
    .kinetic_friction = "mu",
    .snippet = snippet,
    .cannot = cannot};

}  // namespace hookpoint::translation
