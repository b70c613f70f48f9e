#include "reference/ode/creep.h"

#include "reference/experiment_checks.h"
#include "reference/ode/engine.h"
#include "reference/static_depth.h"
#include "reference/steady_creep.h"

namespace hookpoint::reference {

simulation::ClosedForm<simulation::CreepVelocity> ode_creep(
    const simulation::Experiment& experiment) {
  const auto body = resting_body(experiment);
  if (!body) return body.none();
  const ConstraintConstants constants = ode_peer.constraint_constants(experiment);
  // A body let go falls g dt^2 in its first step. Where that is most of the surface layer some
  // contacts end within it and some below it, and which ones the solver alone knows.
  const double fall = norm(experiment.gravity) * experiment.deltat * experiment.deltat;
  if (constants.surface_layer > 0. && fall > 0.5 * constants.surface_layer)
    return simulation::NoClosedForm{
        "the fall of ODE's first step, g deltat^2, is most of its surface layer: which contacts "
        "end "
        "below it is known to the solver alone"};
  if (constants.tangential_mixing == 0.) return simulation::CreepVelocity{};
  const double friction = single_friction(ground_material(experiment));
  const auto creep = creep_by_mixing(*body, friction, constants.tangential_mixing);
  const auto loads = normal_loads(*body, body->pull);
  if (!creep) return creep.none();
  if (creep->limited) return point_at_limit;
  if (!loads) return loads.none();
  const auto level = lasting(*creep, experiment);
  if (!level || constants.surface_layer == 0.) return level;
  simulation::CreepVelocity velocity = *level;
  const double height = body->in_slope(body->origin - body->arms.front()).z;
  velocity.downhill += constants.normal_mixing * loads->y * height;
  velocity.sideways += constants.normal_mixing * loads->z * height;
  return velocity;
}

simulation::ClosedForm<double> ode_softness(const simulation::Experiment& experiment) {
  if (settings_of(experiment, ode_peer) == Settings::matched) return matched_softness(experiment);
  const ConstraintConstants constants = ode_peer.constraint_constants(experiment);
  if (constants.surface_layer > 0.)
    return simulation::NoClosedForm{
        "within ODE's surface layer nothing pushes a contact out: its depth is that of the "
        "landing"};
  return constants.normal_mixing * experiment.deltat / constants.normal_error_reduction;
}

}  // namespace hookpoint::reference
