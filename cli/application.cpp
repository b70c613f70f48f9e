#include "cli/application.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "reference/engines.h"
#include "simulation/dts_engine.h"
#include "simulation/load.h"
#include "simulation/schema.h"
#include "studies/schema.h"
#include "view/schema.h"

namespace hookpoint::cli {
namespace {

/// The project's configs/, then the folders of HOOKPOINT_PATH.
std::vector<std::filesystem::path> search_path() {
  std::vector<std::filesystem::path> folders{HOOKPOINT_CONFIGS};
  if (const char* more = std::getenv("HOOKPOINT_PATH")) {
    std::stringstream list(more);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  return folders;
}

/// Sticking contacts of ODE's exact solver yield by CFM times their friction; its iterative solver
/// and Bullet have no closed form.
std::optional<double> ode_friction_mixing(const simulation::Experiment& experiment) {
  return reference::constraint_constants("ode", experiment).tangential_mixing;
}

/// "trail=value" cut at the first '='.
language::Override override_from(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  return {setting.substr(0, equals), setting.substr(equals + 1)};
}

}  // namespace

Application::Application() : search_path_(search_path()) {
  simulation::add_experiment_classes(schema_);
  view::add_display_classes(schema_);
  studies::add_study_classes(schema_);
  library_ = std::make_unique<language::Library>(schema_, search_path_);
  engines_["dts"] = {simulation::describe_dts(), simulation::make_dts, nullptr};
  for (const reference::Peer& peer : reference::peers()) {
    engines_[std::string(peer.name)] = {peer.describe(), peer.make,
                                        peer.name == "ode" ? ode_friction_mixing : nullptr};
  }
}

std::unique_ptr<simulation::Engine> Application::make_engine(
    const simulation::Experiment& experiment) const {
  const auto found = engines_.find(experiment.engine);
  if (found != engines_.end()) return found->second.make(experiment);
  throw simulation::ExperimentError("this build has no engine `" + experiment.engine +
                                    "`; `hookpoint engines` lists those it has");
}

std::unique_ptr<language::Object> Application::evaluate(const std::filesystem::path& file,
                                                        const std::vector<std::string>& settings) {
  language::EvaluateOptions options;
  for (const std::string& setting : settings) options.overrides.push_back(override_from(setting));
  language::Diagnostics diagnostics;
  auto root = library_->evaluate(file, options, diagnostics);
  print_diagnostics(diagnostics);
  return root;
}

std::optional<simulation::Experiment> Application::load(const language::Object& root) const {
  language::Diagnostics diagnostics;
  auto experiment = simulation::load_experiment(root, diagnostics, search_path_);
  print_diagnostics(diagnostics);
  return experiment;
}

std::optional<simulation::Experiment> Application::load(const std::filesystem::path& file,
                                                        const std::vector<std::string>& settings) {
  const auto root = evaluate(file, settings);
  if (!root) return std::nullopt;
  return load(*root);
}

void print_diagnostics(const language::Diagnostics& diagnostics) {
  diagnostics.print(std::cerr, isatty(STDERR_FILENO) != 0);
}

void print_error(const std::string& message) {
  std::cerr << "hookpoint: error: " << message << '\n';
}

}  // namespace hookpoint::cli
