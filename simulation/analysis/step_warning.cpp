#include "simulation/analysis/step_warning.h"

#include <fmt/format.h>

namespace hookpoint::simulation {
namespace {

std::string what_is_unstable(const Experiment& experiment, const StabilityBound& bound) {
  const std::string law = bound.contacts == StabilityBound::Contacts::none
                              ? ""
                              : " under the law " + experiment.contact;
  if (!(bound.step > 0.))
    return fmt::format("no step of {} is stable{}", experiment.integrator, law);
  return fmt::format("deltat {:.4g} s is above the largest stable step {:.4g} s of {}{}",
                     experiment.deltat, bound.step, experiment.integrator, law);
}

std::string what_to_do(const StabilityBound& bound) {
  if (std::string controllers = controller_advice(bound); !controllers.empty()) return controllers;
  const char* softer = bound.contacts == StabilityBound::Contacts::none
                           ? " or springs and stops softer"
                           : " or the ground softer";
  if (bound.step > 0.)
    return fmt::format("make the step smaller (deltat = auto){}, or choose another integrator",
                       softer);
  return "give what vibrates some damping, or choose another integrator";
}

}  // namespace

std::optional<std::string> step_warning(const Experiment& experiment) {
  if (experiment.chosen_from && experiment.deltat <= *experiment.chosen_from) return std::nullopt;
  return step_warning(experiment, stability_bound(experiment));
}

std::optional<std::string> step_warning(const Experiment& experiment, const StabilityBound& bound) {
  if (experiment.deltat <= bound.step) return std::nullopt;
  return fmt::format("{}: what springs back gains energy; {}", what_is_unstable(experiment, bound),
                     what_to_do(bound));
}

}  // namespace hookpoint::simulation
