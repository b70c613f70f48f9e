// What every command starts from: the language's classes, where files are found, and the engines by
// name. The only place that names every engine.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/plugin_trust.h"
#include "language/document.h"
#include "simulation/engine.h"
#include "studies/engine_table.h"

namespace hookpoint::cli {

/// Prints to stderr in colour when that is a terminal.
void print_diagnostics(const language::Diagnostics& diagnostics);
/// "hookpoint: error: message" on stderr.
void print_error(const std::string& message);

class Application {
 public:
  /// Who is told what is wrong with a file, if anything.
  using Told = std::function<void(const language::Diagnostics&)>;
  /// `allow_plugins`: those of any folder, not of the trusted ones alone.
  explicit Application(bool allow_plugins = false, Told tell = print_diagnostics);

  const language::Schema& schema() const { return vocabularies_.back()->schema; }
  language::Library& library() { return vocabularies_.back()->library; }
  const studies::EngineTable& engines() const { return engines_; }
  /// Builds the world with the engine that the experiment names. Throws
  /// simulation::ExperimentError.
  std::unique_ptr<simulation::Engine> make_engine(const simulation::Experiment& experiment) const;

  /// Tells who is to be told; what this class finds wrong it tells itself.
  void tell(const language::Diagnostics& diagnostics) const { tell_(diagnostics); }
  /// Loads the plugins that `file` and its Includes name; their classes join the schema. Tells
  /// what is wrong and is then false. `evaluate` begins with it; who asks the library must have
  /// asked this before.
  bool load_plugins(const std::filesystem::path& file);
  /// Loads one. "" or what is wrong, as a predicate.
  std::string load_plugin(const std::filesystem::path& library);

  /// The settings that give `field` of the file's World this value: "w.duration=5 s". Of a file
  /// that is wrong none; evaluating it tells why.
  std::vector<std::string> world_settings(const std::filesystem::path& file,
                                          const std::string& field, const std::string& value);
  /// Loads the plugins of the scenes that the file's studies run, which the file itself need not
  /// name. False after errors, which are told.
  bool load_scene_plugins(const language::Object& root, const std::filesystem::path& file);

  /// From now on `text` is the file `path`, which need not exist.
  void give(const std::filesystem::path& path, const std::string& text);
  /// Evaluates `file` and tells its diagnostics; null when it has errors.
  std::unique_ptr<language::Object> evaluate(const std::filesystem::path& file,
                                             const std::vector<std::string>& settings);
  /// The experiment of an evaluated file's world; its diagnostics are told, empty when it has
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
  void add_vocabulary();

  PluginTrust trust_;
  Told tell_;
  std::map<std::filesystem::path, std::string> given_;
  std::vector<std::filesystem::path> search_path_;
  std::vector<std::unique_ptr<Vocabulary>> vocabularies_;
  studies::EngineTable engines_;
};

}  // namespace hookpoint::cli
