#include "reference/simbody/creep.h"

#include "math/bisect.h"
#include "reference/simbody/engine.h"
#include "reference/simbody/settings.h"
#include "reference/steady_creep.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {

double simbody_stiction_speed(double share) {
  return bisect([share](double x) { return x * x * x * (10. + x * (6. * x - 15.)) - share; }, 0.,
                1.);
}

simulation::ClosedForm<simulation::CreepVelocity> simbody_creep(
    const simulation::Experiment& experiment) {
  const auto resting = resting_body(experiment);
  if (!resting) return resting.none();
  RestingBody body = *resting;
  const SimbodySettings settings = simbody_settings(settings_of(experiment, simbody_peer));
  const auto material = ground_material(experiment);
  if (!settings.penalty) {
    // All points at one speed have one coefficient, so that how they share the load is no matter.
    const double share = body.pull / (material.static_friction * body.press);
    if (!(share < 1.)) return simulation::NoClosedForm{"friction does not carry the body"};
    return simulation::CreepVelocity{settings.transition_velocity * simbody_stiction_speed(share),
                                     0.};
  }
  // A point is a ball on a ground that is lowered by its radius, and touches below the point; a
  // ball of the scene is as large and the ground where it is.
  if (touching_shapes(experiment, experiment.robots[0].base).empty())
    for (std::size_t i = 0; i < body.arms.size(); ++i)
      if (body.radii[i] == 0.) body.arms[i] -= point_ball_radius * body.normal;
  const auto loads = normal_loads(body, body.pull);
  if (!loads) return loads.none();
  const double damping = material.tangential_damping;
  std::vector<FrictionDamper> dampers;
  for (const Vector3d& arm : body.arms) {
    const double load = load_at(body, *loads, arm);
    if (!(load > 0.)) return simulation::NoClosedForm{"the body would tip"};
    dampers.push_back({damping, damping, material.kinetic_friction * load});
  }
  const auto creep = steady_creep(body, dampers);
  if (!creep) return creep.none();
  return lasting(*creep, experiment);
}

}  // namespace hookpoint::reference
