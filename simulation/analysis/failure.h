// Why a step failed, as far as the stability of the experiment tells.
#pragma once

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// `status`, with better advice where it depends on the step: a failure above the largest stable
/// step is the step's or its controllers', one below it may be of feedback that the bound leaves
/// out. Costs a stability_bound.
StepStatus with_advice(StepStatus status, const Experiment& experiment);

}  // namespace hookpoint::simulation
