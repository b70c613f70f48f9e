#include "reference/dart/creep.h"

#include "reference/dart/engine.h"
#include "reference/dart/settings.h"
#include "reference/steady_creep.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

/// (J M^-1 J^T)_ii of the row along `direction` at the end of `arm` [1/kg].
double row_diagonal(const RestingBody& body, const Vector3d& arm, const Vector3d& direction) {
  const Vector3d moment = rotate(conjugate(body.orientation), cross(arm, direction));
  return 1. / body.mass->mass + dot(moment, inverse(body.mass->inertia) * moment);
}

}  // namespace

simulation::ClosedForm<simulation::CreepVelocity> dart_creep(
    const simulation::Experiment& experiment) {
  const Settings kind = settings_of(experiment, dart_peer);
  const auto material = ground_material(experiment);
  const DartSettings settings = dart_settings(kind, experiment.deltat, material);
  const auto body = resting_body(experiment);
  if (!body) return body.none();
  if (settings.tessellated && !touching_shapes(experiment, experiment.robots[0].base).empty())
    return simulation::NoClosedForm{"DART's contacts of a mesh are those of its triangles"};
  const double friction = single_friction(material);
  if (settings.own_mixing) {
    const auto creep = creep_by_mixing(*body, friction, settings.constraint.tangential_mixing);
    if (!creep) return creep.none();
    if (creep->limited) return point_at_limit;
    return lasting(*creep, experiment);
  }
  const auto limits = limits_without_friction(*body, friction);
  if (!limits) return limits.none();
  std::vector<FrictionDamper> dampers = *limits;
  const double mixing = settings.constraint.relative_mixing * experiment.deltat;
  for (std::size_t i = 0; i < body->arms.size(); ++i) {
    dampers[i].along = 1. / (mixing * row_diagonal(*body, body->arms[i], body->downhill));
    dampers[i].across = 1. / (mixing * row_diagonal(*body, body->arms[i], body->across));
  }
  const auto creep = steady_creep(*body, dampers);
  // Its friction is a box along and across the fall: at the limit as steady_creep has it only where
  // the body goes straight down.
  if (!creep) return creep.none();
  if (creep->limited && !creep->straight) return point_at_limit;
  return lasting(*creep, experiment);
}

}  // namespace hookpoint::reference
