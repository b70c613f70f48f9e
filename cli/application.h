// What every command starts from: the language's classes, where files are found, and the engines by
// name. The only place that names every engine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document.h"
#include "simulation/engine.h"
#include "studies/engine_table.h"

namespace hookpoint::cli {

class Application {
 public:
  Application();

  const language::Schema& schema() const { return schema_; }
  language::Library& library() { return *library_; }
  const studies::EngineTable& engines() const { return engines_; }
  /// Builds the world with the engine that the experiment names. Throws
  /// simulation::ExperimentError.
  std::unique_ptr<simulation::Engine> make_engine(const simulation::Experiment& experiment) const;

  /// Evaluates `file` and prints its diagnostics on stderr; null when it has errors.
  std::unique_ptr<language::Object> evaluate(const std::filesystem::path& file,
                                             const std::vector<std::string>& settings);
  /// The experiment of an evaluated file's world; its diagnostics are printed, empty when it has
  /// errors.
  std::optional<simulation::Experiment> load(const language::Object& root) const;
  /// Both in one.
  std::optional<simulation::Experiment> load(const std::filesystem::path& file,
                                             const std::vector<std::string>& settings);

 private:
  language::Schema schema_;
  std::vector<std::filesystem::path> search_path_;
  std::unique_ptr<language::Library> library_;
  studies::EngineTable engines_;
};

/// Prints to stderr in colour when that is a terminal.
void print_diagnostics(const language::Diagnostics& diagnostics);
/// "hookpoint: error: message" on stderr.
void print_error(const std::string& message);

}  // namespace hookpoint::cli
