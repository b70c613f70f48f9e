#include "studies/plan/step_warning.h"

#include <fmt/format.h>

#include "simulation/analysis/stability.h"

namespace hookpoint::studies {

std::optional<std::string> step_warning(const simulation::Experiment& experiment) {
  const double bound = simulation::stability_bound(experiment).step;
  if (experiment.deltat <= bound) return std::nullopt;
  return fmt::format(
      "deltat {:.4g} s is above the largest stable step {:.4g} s of {} under the law {}",
      experiment.deltat, bound, experiment.integrator, experiment.contact);
}

}  // namespace hookpoint::studies
