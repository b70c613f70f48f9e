#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "output/json.h"

namespace hookpoint::cli {

namespace {

std::string handling_name(simulation::EngineGap::Handling handling) {
  using enum simulation::EngineGap::Handling;
  return handling == refused ? "refused" : handling == noticed ? "noticed" : "stated";
}

}  // namespace

std::string version_text() {
  const Application application;
  std::string text = "hookpoint " HOOKPOINT_VERSION "\n";
  for (const auto& [name, engine] : application.engines())
    if (engine.description.found)
      text += fmt::format("engine {} {}\n", name, engine.description.version);
  text.pop_back();
  return text;
}

std::string engines_json(const Application& application) {
  output::JsonWriter json;
  json.begin_object().key("engines").begin_array();
  for (const auto& [name, engine] : application.engines()) {
    const simulation::EngineDescription& d = engine.description;
    json.begin_object()
        .member("name", d.name)
        .member("version", d.version)
        .member("precision", d.precision)
        .member("found", d.found);
    json.key("settings").begin_array();
    for (const std::string& setting : d.settings) json.value(setting);
    json.end_array().key("gaps").begin_array();
    for (const simulation::EngineGap& gap : d.gaps) {
      json.begin_object()
          .member("feature", gap.feature)
          .member("handling", handling_name(gap.handling))
          .member("instead", gap.instead)
          .end_object();
    }
    json.end_array().end_object();
  }
  json.end_array().key("laws").begin_array();
  for (const contact::LawDescription& law : contact::law_table()) {
    json.begin_object()
        .member("name", law.name)
        .member("doc", law.summary)
        .member("source", law.source)
        .end_object();
  }
  json.end_array().key("integrators").begin_array();
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    json.begin_object()
        .member("name", stepper.name)
        .member("order", stepper.order)
        .member("doc", stepper.summary)
        .end_object();
  }
  json.end_array().end_object();
  return json.text();
}

namespace {

void print_table(const Application& application) {
  fmt::print("{:<16} {:<10} {:<9} {:<6} {}\n", "engine", "version", "precision", "found",
             "settings");
  for (const auto& [name, engine] : application.engines()) {
    const simulation::EngineDescription& d = engine.description;
    fmt::print("{:<16} {:<10} {:<9} {:<6} {}\n", d.name, d.version, d.precision,
               d.found ? "yes" : "no", fmt::join(d.settings, ", "));
  }
  fmt::print("\n{:<20} {:<34} {}\n", "contact law", "source", "what it is");
  for (const contact::LawDescription& law : contact::law_table())
    fmt::print("{:<20} {:<34} {}\n", law.name, law.source, law.summary);
  fmt::print("\n{:<20} {:<6} {}\n", "integrator", "order", "what it is");
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    fmt::print("{:<20} {:<6} {}\n", stepper.name, stepper.order, stepper.summary);
  }
}

}  // namespace

int engines(bool json) {
  const Application application;
  if (json) {
    std::cout << engines_json(application);
  } else {
    print_table(application);
  }
  return fine;
}

}  // namespace hookpoint::cli
