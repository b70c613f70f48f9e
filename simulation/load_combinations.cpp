#include <fmt/format.h>

#include "contact/force_law.h"
#include "simulation/load_parts.h"

namespace hookpoint::simulation {
namespace {

void check_impulse_law(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (world.given("integrator") && experiment.integrator == "rk4") {
    loading.error(place_of(world, "integrator"),
                  fmt::format("contact law {} advances time from impact to impact and cannot be "
                              "paired with rk4; leave the "
                              "integrator out or choose a force law",
                              experiment.contact));
  }
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    if (experiment.robots[i].chains.empty()) continue;
    loading.error(place_of(world, "contact"),
                  fmt::format("contact law {} moves single rigid bodies only, and robot `{}` has "
                              "chains; choose a force law, "
                              "such as hookpoint",
                              experiment.contact, experiment.robots[i].name));
    loading.diagnostics.note(loading.bases[i]->parent->position, "the robot is here");
  }
}

void check_peer(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    if (experiment.robots[i].chains.empty()) continue;
    loading.error(place_of(world, "engine"),
                  fmt::format("engine {} runs single rigid bodies so far, and robot `{}` has "
                              "chains; choose engine dts",
                              experiment.engine, experiment.robots[i].name));
    loading.diagnostics.note(loading.bases[i]->parent->position, "the robot is here");
  }
}

}  // namespace

void check_combinations(const language::Object& world, Loading& loading) {
  const Experiment& experiment = loading.experiment;
  if (experiment.engine != "dts") return check_peer(world, loading);
  const contact::LawDescription* law = contact::find_law(experiment.contact);
  if (law != nullptr && law->is_impulse_law) check_impulse_law(world, loading);
  if (experiment.settings != "default") {
    loading.error(place_of(world, "settings"),
                  fmt::format("settings = {} is for a peer, and the engine is dts; leave it out or "
                              "choose another engine",
                              experiment.settings));
  }
}

}  // namespace hookpoint::simulation
