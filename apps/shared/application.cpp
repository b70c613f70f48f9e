#include "apps/shared/application.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "apps/shared/engine_block.h"
#include "apps/shared/installation.h"
#include "apps/view/widgets/ghosts.h"
#include "apps/view/widgets/panel.h"
#include "apps/view/widgets/schema.h"
#include "control/plugin/plugin.h"
#include "reference/engines.h"
#include "reference/process/engine.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/scene/load.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"
#include "studies/task/task_kinds.h"
#include "text/display.h"
#include "text/terminal.h"

namespace hookpoint::application {
namespace {

/// After the folders above the file that asks (language/search.h): those of HOOKPOINT_PATH, then
/// the installation's own.
std::vector<std::filesystem::path> search_path(const Installation& installation) {
  std::vector<std::filesystem::path> folders = folders_of("HOOKPOINT_PATH");
  folders.push_back(installation.configs);
  if (!installation.plugins.empty()) folders.push_back(installation.plugins);
  return folders;
}

language::Schema make_schema(const simulation::PeerChoices& peers) {
  language::Schema schema;
  simulation::add_experiment_classes(schema, peers);
  add_engine_class(schema);
  view::add_display_classes(schema);
  studies::add_study_classes(schema);
  return schema;
}

std::vector<std::string> scene_files(const language::Object& root) {
  std::vector<std::string> files;
  for (const studies::TaskKind& kind : studies::task_kinds())
    for (const language::Object* block : root.children_of(kind.block))
      for (std::string& file : kind.scenes(*block)) files.push_back(std::move(file));
  return files;
}

}  // namespace

language::Override override_from(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  return {setting.substr(0, equals), setting.substr(equals + 1)};
}

language::EvaluateOptions options_from(const std::vector<std::string>& settings) {
  language::EvaluateOptions options;
  for (const std::string& setting : settings) options.overrides.push_back(override_from(setting));
  return options;
}

Application::Vocabulary::Vocabulary(const std::vector<std::filesystem::path>& search_path,
                                    const simulation::PeerChoices& peers)
    : schema(make_schema(peers)), library(schema, search_path) {}

Application::Application(Consent consent, ReceiveDiagnostics tell)
    : plugin_trust_(plugin_trust, consent.plugins, find_installation().plugins),
      engine_trust_(engine_trust, consent.engines, find_installation().configs / "engines"),
      tell_(std::move(tell)),
      search_path_(search_path(find_installation())),
      peers_(reference::peer_choices()) {
  engines_.add("dts", {simulation::describe_dts, simulation::make_dts});
  for (const reference::Peer& peer : reference::known_peers())
    engines_.add(std::string(peer.name), {[&peer] { return peer.describe(); }, peer.make,
                                          peer.creep, peer.static_softness});
  // As any file, one of a folder of HOOKPOINT_PATH stands in the place of the installation's.
  std::set<std::filesystem::path> found;
  for (const std::filesystem::path& folder : search_path_)
    for (const std::filesystem::path& file : engine_files_in(folder))
      if (found.insert(file.filename()).second) add_engines(file);
  add_vocabulary();
}

bool Application::add_engines(const std::filesystem::path& file) {
  const auto [known, is_new] = engine_files_.try_emplace(std::filesystem::weakly_canonical(file));
  if (!is_new) return known->second;
  bool right = true;
  const auto engines = read_engines(
      file, search_path_, [this](const auto& name) { return engines_.find(name) != nullptr; },
      [&](const language::Diagnostics& diagnostics) {
        right = diagnostics.error_count() == 0;
        tell(diagnostics);
      });
  for (reference::ProgramDefinition definition : engines) {
    if (const std::string problem = engine_trust_.problem(file); !problem.empty())
      definition.refusal = "it is a program, which " + problem;
    peers_.engines.push_back(definition.name);
    for (const std::string& name : definition.settings)
      if (!peers_.knows_setting(name))
        peers_.settings.push_back({name, name + ": of engine " + definition.name});
    const reference::ProgramEngine program(definition);
    engines_.add(definition.name,
                 {.describe = [program] { return program.describe(); },
                  .make = [program](const auto& experiment) { return program.make(experiment); },
                  .is_program = true});
  }
  return known->second = right;
}

std::vector<std::string> Application::engine_files() const {
  std::vector<std::string> files;
  for (const auto& [file, right] : engine_files_) files.push_back(file.string());
  return files;
}

bool Application::add_engines_of(const std::filesystem::path& file) {
  const std::size_t before = peers_.engines.size();
  bool right = true;
  for (const std::filesystem::path& beside : engine_files_in(file.parent_path()))
    right = add_engines(beside) && right;
  for (const std::filesystem::path& declaring : library().declaring(file, engine_class_name))
    right = add_engines(declaring) && right;
  if (peers_.engines.size() > before) add_vocabulary();
  return right;
}

void Application::tell(const language::Diagnostics& diagnostics) const {
  tell_(diagnostics.without([this](const language::Diagnostic& warning) {
    const language::Position& place = warning.position;
    const std::string file = place.file == nullptr ? "" : place.file->path;
    return !warned_.insert(file + ":" + std::to_string(place.offset) + ": " + warning.message)
                .second;
  }));
}

std::unique_ptr<simulation::Engine> Application::make_engine(
    const simulation::Experiment& experiment) const {
  if (const auto* engine = engines_.find(experiment.engine)) return engine->make(experiment);
  throw simulation::ExperimentError("this build has no engine `" + experiment.engine +
                                    "`; `hookpoint engines` lists those it has");
}

simulation::EngineDescription Application::describe_engine(
    const simulation::Experiment& experiment) const {
  return engines_.describe(experiment.engine);
}

std::string Application::load_library(const std::filesystem::path& library) const {
  std::string problem = plugin_trust_.problem(library);
  if (!problem.empty()) return problem;
  return control::load_plugin(library, [this](const control::ComponentClass& type) {
    return simulation::component_class_problem(schema(), type);
  });
}

void Application::take_new_classes() {
  for (const auto& [name, type] : control::Registry::instance().classes()) {
    if (schema().find(name) != nullptr) continue;
    return add_vocabulary();
  }
}

void Application::add_vocabulary() {
  vocabularies_.push_back(std::make_unique<Vocabulary>(search_path_, peers_));
  for (const auto& [path, text] : given_) library().give(path, text);
}

void Application::give(const std::filesystem::path& path, const std::string& text) {
  given_.emplace(path, text);
  library().give(path, text);
}

bool Application::load_plugins(const std::filesystem::path& file) {
  language::Diagnostics diagnostics;
  const bool loaded = library().load_plugins(
      file, [this](const std::filesystem::path& found) { return load_library(found); },
      diagnostics);
  tell(diagnostics);
  take_new_classes();
  return loaded && add_engines_of(file);
}

std::string Application::load_plugin(const std::filesystem::path& library) {
  std::string problem = load_library(library);
  take_new_classes();
  return problem;
}

std::vector<std::string> Application::world_settings(const std::filesystem::path& file,
                                                     const std::string& field,
                                                     const std::string& value,
                                                     const std::vector<std::string>& beside) {
  language::Diagnostics unreported;
  std::vector<std::string> settings;
  const auto root = library().evaluate(file, options_from(beside), unreported);
  if (!root) return settings;
  for (const language::Object* world : root->children_of("World"))
    settings.push_back(world->name + "." + field + "=" + value);
  return settings;
}

std::filesystem::path Application::find(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.empty() || std::filesystem::exists(file, ignored)) return file;
  std::filesystem::path found = library().find(file, {});
  return found.empty() ? file : found;
}

std::filesystem::path Application::locate(const std::filesystem::path& file) {
  std::filesystem::path found = find(file);
  if (found != file)
    std::cerr << "hookpoint: note: " << file.string() << " is " << found.string() << '\n';
  return found;
}

bool Application::load_scene_plugins(const language::Object& root,
                                     const std::filesystem::path& file) {
  for (const std::string& scene : scene_files(root)) {
    const std::filesystem::path found = library().find(scene, file);
    if (!found.empty() && !load_plugins(found)) return false;
  }
  return true;
}

std::unique_ptr<language::Object> Application::evaluate(const std::filesystem::path& file,
                                                        const std::vector<std::string>& settings) {
  if (!load_plugins(file)) return nullptr;
  language::Diagnostics diagnostics;
  auto root = library().evaluate(file, options_from(settings), diagnostics);
  tell(diagnostics);
  return root;
}

std::unique_ptr<language::Object> Application::evaluate_set(const std::filesystem::path& file,
                                                            const Settings& settings) {
  if (!load_plugins(file)) return nullptr;
  std::vector<std::string> all = settings.trails;
  for (const auto& [field, value] : settings.world)
    for (std::string& setting : world_settings(file, field, value, settings.trails))
      all.push_back(std::move(setting));
  return evaluate(file, all);
}

std::optional<simulation::Experiment> Application::load(const language::Object& root,
                                                        Warnings warnings) const {
  language::Diagnostics diagnostics;
  auto experiment = simulation::load_experiment(root, diagnostics, search_path_);
  // What its windows name must be there, whether or not they are opened.
  if (experiment) {
    view::make_panel(root, *experiment, {}, diagnostics);
    view::check_ghosts(root, diagnostics);
  }
  tell(warnings == Warnings::reported ? diagnostics
                                      : diagnostics.without([](const auto&) { return true; }));
  if (diagnostics.error_count() > 0) return std::nullopt;
  return experiment;
}

std::optional<simulation::Experiment> Application::load(const std::filesystem::path& file,
                                                        const std::vector<std::string>& settings) {
  const auto root = evaluate(file, settings);
  if (!root) return std::nullopt;
  return load(*root);
}

void print_diagnostics(const language::Diagnostics& diagnostics) {
  diagnostics.print(std::cerr, text::wants_colours(STDERR_FILENO));
}

void print_error(const std::string& message) {
  std::cerr << "hookpoint: error: " << text::printable(message) << '\n';
}

}  // namespace hookpoint::application
