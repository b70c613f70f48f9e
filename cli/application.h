// What every command starts from: the language's classes, where files are found, and the engines by
// name. The only place that names every engine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/plugin_trust.h"
#include "language/document.h"
#include "simulation/engine.h"
#include "studies/engine_table.h"

namespace hookpoint::cli {

class Application {
 public:
  /// `allow_plugins`: those of any folder, not of the trusted ones alone.
  explicit Application(bool allow_plugins = false);

  const language::Schema& schema() const { return vocabularies_.back()->schema; }
  language::Library& library() { return vocabularies_.back()->library; }
  const studies::EngineTable& engines() const { return engines_; }
  /// Builds the world with the engine that the experiment names. Throws
  /// simulation::ExperimentError.
  std::unique_ptr<simulation::Engine> make_engine(const simulation::Experiment& experiment) const;

  /// Loads the plugins that `file` and its Includes name; their classes join the schema. Prints
  /// what is wrong and is then false. `evaluate` begins with it; who asks the library must have
  /// asked this before.
  bool load_plugins(const std::filesystem::path& file);
  /// Loads one. "" or what is wrong, as a predicate.
  std::string load_plugin(const std::filesystem::path& library);

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
  /// The classes known at a time and the files read by them. Plugins make a new one; trees point
  /// into the one that they are of, so all are kept.
  struct Vocabulary {
    explicit Vocabulary(const std::vector<std::filesystem::path>& search_path);
    language::Schema schema;
    language::Library library;
  };
  std::string load_library(const std::filesystem::path& library) const;
  void take_new_classes();

  PluginTrust trust_;
  std::vector<std::filesystem::path> search_path_;
  std::vector<std::unique_ptr<Vocabulary>> vocabularies_;
  studies::EngineTable engines_;
};

/// Prints to stderr in colour when that is a terminal.
void print_diagnostics(const language::Diagnostics& diagnostics);
/// "hookpoint: error: message" on stderr.
void print_error(const std::string& message);

}  // namespace hookpoint::cli
