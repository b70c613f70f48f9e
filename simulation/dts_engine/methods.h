// The contact law and the integrator that an experiment names.
#pragma once

#include <memory>
#include <string>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Its force law; for an integrator that chooses its own steps (`adaptive`) as a differential equation.
/// Throws ExperimentError when there is no such law.
const contact::LawDescription& force_law_of(const Experiment& experiment, bool adaptive);

/// The row of its integrator. Throws ExperimentError when there is none.
const integrators::StepperDescription& stepper_of(const Experiment& experiment);

/// Throws ExperimentError where an implicit integrator would have too many unknowns; `what` is moved by
/// it: "robot 'block'".
std::unique_ptr<integrators::Stepper> stepper_within_budget(const Experiment& experiment,
                                                            const std::string& what,
                                                            const integrators::System& system);

}  // namespace hookpoint::simulation
