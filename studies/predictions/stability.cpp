// The closed form of the largest stable step, as a robot that should rest meets it.
#include "simulation/analysis/stability.h"

#include <cmath>

#include "studies/predictions/predictions.h"

namespace hookpoint::studies {

std::optional<double> restless(const RunContext& context) {
  const double bound = simulation::stability_bound(*context.experiment).step;
  if (!std::isfinite(bound)) return std::nullopt;
  return context.experiment->deltat > bound ? 1. : 0.;
}

}  // namespace hookpoint::studies
