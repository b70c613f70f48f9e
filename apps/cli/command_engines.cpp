#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "apps/shared/engines_json.h"
#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "text/display.h"

namespace hookpoint::cli {

std::string version_text() {
  const application::Application application;
  std::string text = "hookpoint " HOOKPOINT_VERSION "\n";
  for (const auto& [name, engine] : application.engines()) {
    if (engine.is_program) continue;
    const simulation::EngineDescription d = engine.describe();
    if (d.found) text += fmt::format("engine {} {}\n", name, d.version);
  }
  text.pop_back();
  return text;
}

namespace {

void print_table(const application::Application& application) {
  fmt::print("{:<16} {:<10} {:<9} {:<6} {}\n", "engine", "version", "precision", "found",
             "settings");
  for (const auto& [name, engine] : application.engines()) {
    const simulation::EngineDescription d = engine.describe();
    fmt::print("{:<16} {:<10} {:<9} {:<6} {}{}\n", d.name, d.version, d.precision,
               d.found ? "yes" : "no", fmt::join(d.settings, ", "),
               d.missing.empty() ? "" : "; " + text::printable(d.missing));
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

int engines(const EnginesArguments& arguments) {
  application::Application application(arguments.consent);
  if (arguments.file) {
    const std::filesystem::path file = application.locate(*arguments.file);
    if (!std::filesystem::exists(file)) {
      application::print_error("there is no file " + text::printable(file.string()));
      return wrong_input;
    }
    if (!application.load_plugins(file)) return wrong_input;
  }
  if (arguments.json) {
    std::cout << application::engines_json(application);
  } else {
    print_table(application);
  }
  return fine;
}

}  // namespace hookpoint::cli
