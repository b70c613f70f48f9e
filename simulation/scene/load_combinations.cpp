#include <fmt/format.h>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "language/names.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/unread_constants.h"

namespace hookpoint::simulation {
namespace {

void check_impulse_law(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  const integrators::StepperDescription* stepper = integrators::find_stepper(experiment.integrator);
  if (world.given("integrator") && stepper != nullptr && stepper->order != 1) {
    loading.error(place_of(world, "integrator"),
                  fmt::format("contact law {} advances time from impact to impact and cannot be "
                              "paired with {}; leave the "
                              "integrator out or choose a force law",
                              experiment.contact, experiment.integrator));
  }
}

/// "cvode_bdf, cvode_adams and arkode": the integrators that choose their own steps.
std::string adaptive_integrators() {
  std::vector<std::string> names;
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    if (stepper.adaptive()) names.emplace_back(stepper.name);
  }
  const std::string last = names.back();
  names.pop_back();
  return language::join(names, ", ") + " and " + last;
}

/// Only a warning, and none where a scene states tolerances for whichever integrator a study gives
/// it.
void check_tolerances(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  const integrators::StepperDescription* stepper = integrators::find_stepper(experiment.integrator);
  if (stepper == nullptr || stepper->adaptive()) return;
  for (const char* field : {"relative_tolerance", "absolute_tolerance"}) {
    if (!world.given(field)) continue;
    const bool chosen = set_from_outside(world, "integrator") ||
                        (set_from_outside(world, "engine") && loading.experiment.engine != "dts");
    if (chosen && !set_from_outside(world, field)) continue;
    loading.diagnostics.warning(
        place_of(world, field),
        fmt::format("{} says nothing to {}, whose steps are all deltat; only {} read it", field,
                    experiment.integrator, adaptive_integrators()));
  }
}

}  // namespace

bool set_from_outside(const language::Object& object, std::string_view field) {
  return object.given(field) && object.find(field)->from_outside;
}

void check_combinations(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (experiment.constraint_mixing && !experiment.engine.starts_with("ode")) {
    loading.error(place_of(world, "constraint_mixing"),
                  fmt::format("constraint_mixing is a constant of ODE, and the engine is {}; leave "
                              "it out or choose engine ode or ode_quickstep",
                              experiment.engine));
  }
  if (experiment.engine != "dts") return;  // what a peer lacks, it says itself
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  if (law != nullptr && law->is_impulse_law) {
    check_impulse_law(world, loading);
  } else {
    check_tolerances(world, loading);
  }
  if (experiment.settings != "default") {
    loading.error(
        place_of(world, "settings"),
        fmt::format("settings = {} is of another engine, and the engine is dts; leave it out or "
                    "choose another engine",
                    experiment.settings));
  }
}

}  // namespace hookpoint::simulation
