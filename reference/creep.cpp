#include "reference/creep.h"

#include <algorithm>
#include <cmath>

#include "reference/experiment_checks.h"
#include "reference/settings.h"
#include "reference/steady_creep.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

using simulation::CreepVelocity;

/// The velocity, unless a turn of more than 0.2 rad within the run makes it another one.
std::optional<CreepVelocity> lasting(const SteadyCreep& creep,
                                     const simulation::Experiment& experiment) {
  if (std::abs(creep.spin) * experiment.duration > 0.2) return std::nullopt;
  return creep.velocity;
}

/// (J M^-1 J^T)_ii of the row along `direction` at the end of `arm` [1/kg].
double row_diagonal(const RestingBody& body, const Vector3d& arm, const Vector3d& direction) {
  const Vector3d moment = rotate(conjugate(body.orientation), cross(arm, direction));
  return 1. / body.mass->mass + dot(moment, inverse(body.mass->inertia) * moment);
}

/// ODE's and DART's limit of a row: that of the loads without friction.
std::optional<std::vector<FrictionDamper>> limits_without_friction(const RestingBody& body,
                                                                   double friction) {
  const auto loads = normal_loads(body, 0.);
  if (!loads) return std::nullopt;
  std::vector<FrictionDamper> dampers;
  for (const Vector3d& arm : body.arms)
    dampers.push_back({0., 0., friction * load_at(body, *loads, arm)});
  return dampers;
}

/// Of friction rows that yield by `mixing` [m/(N s)] times their force.
std::optional<SteadyCreep> creep_by_mixing(const RestingBody& body, double friction,
                                           double mixing) {
  auto dampers = limits_without_friction(body, friction);
  if (!dampers) return std::nullopt;
  for (FrictionDamper& damper : *dampers) damper.along = damper.across = 1. / mixing;
  return steady_creep(body, *dampers);
}

/// x with 10 x^3 - 15 x^4 + 6 x^5 = `share`, which is within 0 and 1.
double stiction_speed(double share) {
  double low = 0., high = 1.;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (x * x * x * (10. + x * (6. * x - 15.)) < share ? low : high) = x;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::optional<CreepVelocity> ode_creep(const simulation::Experiment& experiment) {
  const auto body = resting_body(experiment);
  if (!body) return std::nullopt;
  const ConstraintConstants constants = constraint_constants("ode", experiment);
  // A body let go falls g dt^2 in its first step. Where that is most of the surface layer some
  // contacts end within it and some below it, and which is the solver's secret.
  const double fall = norm(experiment.gravity) * experiment.deltat * experiment.deltat;
  if (constants.surface_layer > 0. && fall > 0.5 * constants.surface_layer) return std::nullopt;
  if (constants.tangential_mixing == 0.) return CreepVelocity{};
  const double friction = single_friction(ground_material(experiment));
  const auto creep = creep_by_mixing(*body, friction, constants.tangential_mixing);
  const auto loads = normal_loads(*body, body->pull);
  if (!creep || creep->limited || !loads) return std::nullopt;
  auto velocity = lasting(*creep, experiment);
  if (!velocity || constants.surface_layer == 0.) return velocity;
  const double height = body->in_slope(body->origin - body->arms.front()).z;
  velocity->downhill += constants.normal_mixing * loads->y * height;
  velocity->sideways += constants.normal_mixing * loads->z * height;
  return velocity;
}

std::optional<CreepVelocity> dart_creep(const simulation::Experiment& experiment) {
  const Settings kind = settings_of(experiment, "dart");
  const auto material = ground_material(experiment);
  const DartSettings settings = dart_settings(kind, experiment.deltat, material);
  const auto body = resting_body(experiment);
  if (!body || (settings.tessellated && !touches_by_points(experiment, 0))) return std::nullopt;
  const double friction = single_friction(material);
  if (settings.own_mixing) {
    const auto creep = creep_by_mixing(*body, friction, settings.constraint.tangential_mixing);
    return creep && !creep->limited ? lasting(*creep, experiment) : std::nullopt;
  }
  auto dampers = limits_without_friction(*body, friction);
  if (!dampers) return std::nullopt;
  const double mixing = settings.constraint.relative_mixing * experiment.deltat;
  for (std::size_t i = 0; i < body->arms.size(); ++i) {
    (*dampers)[i].along = 1. / (mixing * row_diagonal(*body, body->arms[i], body->downhill));
    (*dampers)[i].across = 1. / (mixing * row_diagonal(*body, body->arms[i], body->across));
  }
  const auto creep = steady_creep(*body, *dampers);
  // Its friction is a box along and across the fall: at the limit as steady_creep has it only where
  // the body goes straight down.
  if (!creep || (creep->limited && !creep->straight)) return std::nullopt;
  return lasting(*creep, experiment);
}

std::optional<CreepVelocity> simbody_creep(const simulation::Experiment& experiment) {
  auto body = resting_body(experiment);
  if (!body) return std::nullopt;
  const SimbodySettings settings = simbody_settings(settings_of(experiment, "simbody"));
  const auto material = ground_material(experiment);
  if (!settings.penalty) {
    // All points at one speed have one coefficient, so that how they share the load is no matter.
    const double share = body->pull / (material.static_friction * body->press);
    if (!(share < 1.)) return std::nullopt;
    return CreepVelocity{settings.transition_velocity * stiction_speed(share), 0.};
  }
  if (touches_by_points(experiment, 0))  // each is a ball, which touches below the point
    for (Vector3d& arm : body->arms) arm -= point_ball_radius * body->normal;
  const auto loads = normal_loads(*body, body->pull);
  if (!loads) return std::nullopt;
  const double damping = material.tangential_damping;
  std::vector<FrictionDamper> dampers;
  for (const Vector3d& arm : body->arms) {
    const double load = load_at(*body, *loads, arm);
    if (!(load > 0.)) return std::nullopt;  // the body would tip
    dampers.push_back({damping, damping, material.kinetic_friction * load});
  }
  const auto creep = steady_creep(*body, dampers);
  return creep ? lasting(*creep, experiment) : std::nullopt;
}

}  // namespace hookpoint::reference
