// The closed form of the largest stable step, as a robot that should rest meets it.
#include "simulation/analysis/stability.h"

#include <cmath>

#include "studies/measure/body_on_plane.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {

Prediction predicted::restless(const RunContext& context, const PeerContact&) {
  const simulation::Experiment& experiment = *context.experiment;
  const double bound = simulation::stability_bound(experiment).step;
  if (!std::isfinite(bound))
    return NoClosedForm{
        "there is no largest stable step: an adaptive integrator, an impulse law or "
        "another engine"};
  if (experiment.deltat > bound) return 1.;
  if (!experiment.forces.empty())
    return NoClosedForm{"the Force " + experiment.forces.front().name + " may move the robot"};
  if (not_one_rigid_body(context).empty()) {
    const BodyOnPlane body = body_on_plane(context);
    if (body.speed > 0. || !body.sticks()) return NoClosedForm{"the body slides"};
  }
  return 0.;
}

}  // namespace hookpoint::studies
