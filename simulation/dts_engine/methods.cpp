#include "simulation/dts_engine/methods.h"

#include "integrators/adaptive.h"
#include "simulation/dts_engine/step.h"

namespace hookpoint::simulation {

const contact::LawDescription& force_law_of(const Experiment& experiment, bool adaptive) {
  const auto* const law = contact::find_force_law(experiment.contact);
  if (law == nullptr) throw ExperimentError("there is no contact law `" + experiment.contact + "`");
  return adaptive ? law->rate_form() : *law;
}

const integrators::StepperDescription& stepper_of(const Experiment& experiment) {
  const auto* stepper = integrators::find_stepper(experiment.integrator);
  if (stepper == nullptr)
    throw ExperimentError("there is no integrator `" + experiment.integrator + "`");
  return *stepper;
}

std::unique_ptr<integrators::Stepper> stepper_within_budget(const Experiment& experiment,
                                                            const std::string& what,
                                                            const integrators::System& system) {
  try {
    return integrators::make_stepper(
        experiment.integrator, system,
        {experiment.relative_tolerance, experiment.absolute_tolerance});
  } catch (const integrators::TooManyUnknowns& error) {
    throw ExperimentError(what + " under " + experiment.integrator + ": " +
                          too_many_unknowns(error.unknowns, error.states));
  }
}

}  // namespace hookpoint::simulation
