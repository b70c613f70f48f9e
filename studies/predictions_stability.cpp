// The closed form of the largest stable step, as a robot that should rest meets it.
#include <cmath>

#include "simulation/stability.h"
#include "studies/predictions.h"

namespace hookpoint::studies {

std::optional<double> restless(const RunContext& context) {
  const double bound = simulation::stability_bound(*context.experiment).step;
  if (!std::isfinite(bound)) return std::nullopt;
  return context.experiment->deltat > bound ? 1. : 0.;
}

}  // namespace hookpoint::studies
