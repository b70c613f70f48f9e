#include "reference/static_depth.h"

#include "reference/experiment_checks.h"

namespace hookpoint::reference {

std::optional<double> matched_softness(const simulation::Experiment& experiment) {
  if (experiment.settings != "matched") return std::nullopt;
  return 1. / ground_material(experiment).normal_stiffness;
}

}  // namespace hookpoint::reference
