#include "reference/static_depth.h"

#include "reference/experiment_checks.h"

namespace hookpoint::reference {

simulation::ClosedForm<double> matched_softness(const simulation::Experiment& experiment) {
  if (experiment.settings != "matched")
    return simulation::NoClosedForm{
        "how deep a contact rests in other engines is known at `settings = matched` alone"};
  return 1. / ground_material(experiment).normal_stiffness;
}

}  // namespace hookpoint::reference
