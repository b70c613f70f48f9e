#include "reference/creep.h"

#include <cmath>

#include "reference/experiment_checks.h"
#include "reference/resting_body.h"
#include "reference/settings.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

/// (J M^-1 J^T)_tt of the row along the fall at the end of `arm` [1/kg].
double row_diagonal(const RestingBody& body, const Vector3d& arm) {
  const Vector3d moment = rotate(conjugate(body.orientation), cross(arm, body.downhill));
  return 1. / body.mass->mass + dot(moment, inverse(body.mass->inertia) * moment);
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

std::optional<double> dart_friction_mixing(const simulation::Experiment& experiment) {
  const Settings kind = settings_of(experiment, "dart");
  const DartSettings settings = dart_settings(kind, experiment.deltat, ground_material(experiment));
  if (settings.own_mixing) return settings.constraint.tangential_mixing;
  const auto body = resting_body(experiment);
  if (!body || (settings.tessellated && !touches_by_points(experiment, 0))) return std::nullopt;
  const double diagonal = row_diagonal(*body, body->arms[0]);
  for (const Vector3d& arm : body->arms)
    if (std::abs(row_diagonal(*body, arm) - diagonal) > 1e-6 * diagonal) return std::nullopt;
  return settings.constraint.relative_mixing * diagonal * experiment.deltat;
}

std::optional<double> simbody_friction_mixing(const simulation::Experiment& experiment) {
  const SimbodySettings settings = simbody_settings(settings_of(experiment, "simbody"));
  const auto material = ground_material(experiment);
  if (settings.penalty) return 1. / material.tangential_damping;
  const auto body = resting_body(experiment);
  if (!body || !(body->pull < material.static_friction * body->press)) return std::nullopt;
  const double speed = settings.transition_velocity *
                       stiction_speed(body->pull / (material.static_friction * body->press));
  return speed * static_cast<double>(body->arms.size()) / body->pull;
}

}  // namespace hookpoint::reference
