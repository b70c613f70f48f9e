#include "simulation/analysis/failure.h"

#include <fmt/format.h>

#include "simulation/analysis/stability.h"
#include "simulation/analysis/step_warning.h"

namespace hookpoint::simulation {

StepStatus with_advice(StepStatus status, const Experiment& experiment) {
  if (!status.depends_on_step) return status;
  const StabilityBound bound = stability_bound(experiment);
  if (experiment.deltat <= bound.step) {
    if (bound.left_out.empty() || status.kind != StepStatus::Kind::not_finite) return status;
    status.advice = fmt::format(
        "its accelerations are no longer finite, with a step below the bound {:.4g} s, which "
        "leaves out what feeds back otherwise: {}; lower its gains or raise its rate",
        bound.step, first_of(bound.left_out));
    return status;
  }
  status.kind = StepStatus::Kind::step_too_large;
  status.advice = *step_warning(experiment, bound);
  return status;
}

}  // namespace hookpoint::simulation
