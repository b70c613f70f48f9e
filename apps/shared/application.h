// What every command and the Python module start from: the language's classes, where files are
// found, and the engines by name: ours and the peers' rows (reference/engines.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/shared/consent.h"
#include "apps/shared/settings.h"
#include "apps/shared/trust.h"
#include "language/document/document.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/scene/peer_choices.h"
#include "studies/measure/engine_table.h"

namespace hookpoint::application {

/// Prints to stderr in colour when that is a terminal.
void print_diagnostics(const language::Diagnostics& diagnostics);
/// "hookpoint: error: message" on stderr.
void print_error(const std::string& message);

/// "trail=value" cut at the first '='; several as the language takes them.
language::Override override_from(const std::string& setting);
language::EvaluateOptions options_from(const std::vector<std::string>& settings);

/// What becomes of the warnings of a load.
enum class Warnings { reported, dropped };

class Application {
 public:
  /// Receives what is wrong with a file, if anything.
  using ReceiveDiagnostics = std::function<void(const language::Diagnostics&)>;
  explicit Application(Consent consent = {}, ReceiveDiagnostics tell = print_diagnostics);

  const language::Schema& schema() const { return vocabularies_.back()->schema; }
  language::Library& library() { return vocabularies_.back()->library; }
  const studies::EngineTable& engines() const { return engines_; }
  /// The files of Engine blocks that were read.
  std::vector<std::string> engine_files() const;
  /// Builds the world with the engine that the experiment names. Throws
  /// simulation::ExperimentError.
  std::unique_ptr<simulation::Engine> make_engine(const simulation::Experiment& experiment) const;

  /// Of that engine; of one that this build has not, its name alone.
  simulation::EngineDescription describe_engine(const simulation::Experiment& experiment) const;

  /// Reports to `tell`, a warning once; what this class itself finds wrong is reported too.
  void tell(const language::Diagnostics& diagnostics) const;
  /// Loads the plugins that `file` and its Includes name, and the engines of their Engine blocks and
  /// of the folder `engines` beside it; they join the schema. Reports what is wrong and is then false. `evaluate` begins with it; a caller of the library must call
  /// this first.
  bool load_plugins(const std::filesystem::path& file);
  /// Loads one. "" or what is wrong, as a predicate.
  std::string load_plugin(const std::filesystem::path& library);

  /// The settings that give `field` of the file's World, as it is with those `beside` them, this
  /// value: "w.duration=5 s". Of a file that is wrong none; evaluating it tells why.
  std::vector<std::string> world_settings(const std::filesystem::path& file,
                                          const std::string& field, const std::string& value,
                                          const std::vector<std::string>& beside = {});
  /// `file` as it is written from here; one that is not there is looked up as an Include is.
  std::filesystem::path find(const std::filesystem::path& file);
  /// The same, and what was found elsewhere is reported on stderr.
  std::filesystem::path locate(const std::filesystem::path& file);
  /// Loads the plugins of the scenes that the file's studies run, which the file itself need not
  /// name. False after errors, which are reported.
  bool load_scene_plugins(const language::Object& root, const std::filesystem::path& file);

  /// From now on `text` is the file `path`, which need not exist.
  void give(const std::filesystem::path& path, const std::string& text);
  /// Evaluates `file` and tells its diagnostics; null when it has errors.
  std::unique_ptr<language::Object> evaluate(const std::filesystem::path& file,
                                             const std::vector<std::string>& settings);
  /// The same, with all that the command line sets.
  std::unique_ptr<language::Object> evaluate_set(const std::filesystem::path& file,
                                                 const Settings& settings);
  /// The experiment of an evaluated file's world; its diagnostics are reported, empty when it has
  /// errors.
  std::optional<simulation::Experiment> load(const language::Object& root,
                                             Warnings warnings = Warnings::reported) const;
  /// Both in one.
  std::optional<simulation::Experiment> load(const std::filesystem::path& file,
                                             const std::vector<std::string>& settings);

 private:
  /// The classes known at a time and the files read by them. Plugins make a new one; trees point
  /// into the one that they are of, so all are kept.
  struct Vocabulary {
    Vocabulary(const std::vector<std::filesystem::path>& search_path,
               const simulation::PeerChoices& peers);
    language::Schema schema;
    language::Library library;
  };
  std::string load_library(const std::filesystem::path& library) const;
  void take_new_classes();
  /// Those of a file of Engine blocks; false after errors, which are reported.
  bool add_engines(const std::filesystem::path& file);
  bool add_engines_of(const std::filesystem::path& file);
  void add_vocabulary();

  Trust plugin_trust_, engine_trust_;
  ReceiveDiagnostics tell_;
  mutable std::set<std::string> warned_;  ///< place and message
  std::map<std::filesystem::path, std::string> given_;
  std::vector<std::filesystem::path> search_path_;
  std::vector<std::unique_ptr<Vocabulary>> vocabularies_;
  studies::EngineTable engines_;
  simulation::PeerChoices peers_;                       ///< what a World may say of them
  std::map<std::filesystem::path, bool> engine_files_;  ///< that were read: whether they are right
};

}  // namespace hookpoint::application
