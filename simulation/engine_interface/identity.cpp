#include "simulation/engine_interface/identity.h"

#include "control/registry.h"
#include "output/files/hash.h"

namespace hookpoint::simulation {

std::vector<std::string> plugins_of(const Experiment& experiment) {
  std::set<std::string> origins;
  for (const ComponentSpec& component : experiment.components) {
    const auto* type = control::Registry::instance().find(component.type);
    if (type != nullptr && !type->origin.empty()) origins.insert(type->origin);
  }
  return {origins.begin(), origins.end()};
}

std::string experiment_hash(const std::string& text, const Experiment& experiment) {
  output::Hash hash;
  hash.add(text);
  for (const FileSpec& file : experiment.files)
    hash.add(file.name).add(output::hash_of_file(file.path));
  for (const std::string& plugin : plugins_of(experiment)) hash.add(output::hash_of_file(plugin));
  return hash.text();
}

std::string run_hash(const std::string& experiment, const EngineDescription& engine) {
  output::Hash hash;
  hash.add(experiment).add(output::hash_of_program());
  hash.add(engine.name).add(engine.version).add(engine.precision).add(engine.found ? "" : "none");
  if (!engine.program.empty()) hash.add(engine.program);
  return hash.text();
}

std::set<std::string> files_read(const Experiment& experiment) {
  std::set<std::string> paths;
  for (const FileSpec& file : experiment.files) paths.insert(file.path);
  for (const std::string& plugin : plugins_of(experiment)) paths.insert(plugin);
  return paths;
}

std::vector<output::InputFile> hashed(const std::set<std::string>& paths) {
  std::vector<output::InputFile> inputs;
  for (const std::string& path : paths) inputs.push_back({path, output::hash_of_file(path)});
  return inputs;
}

std::string engine_text(const EngineDescription& engine) {
  return engine.name + " " + engine.version + ", " + engine.precision +
         (engine.program.empty() ? "" : ", program " + engine.program);
}

}  // namespace hookpoint::simulation
