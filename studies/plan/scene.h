// A scene under settings: its file, the ground that is laid under it, and what is set in both from
// outside. Rows of a study, candidates of a tuning and cases of a calibration are such scenes, and
// each is loaded when it runs: a plan of 100,000 rows has no room for their experiments.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "language/document/document.h"
#include "simulation/experiment/experiment.h"
#include "studies/blocks/subject.h"

namespace hookpoint::studies {

/// The file of a ground and values of its Params, the language's text.
struct GroundPlan {
  std::filesystem::path file;
  std::map<std::string, std::string> parameters;
};

/// The names of the Params that a scene's file declares, and that of the ground which is laid under
/// it.
struct DeclaredParameters {
  std::vector<std::string> scene, ground;
};

/// A scene's file and what is set in it from outside.
struct ScenePlan {
  std::filesystem::path file;
  language::EvaluateOptions options;      ///< `amend` is this header's
  std::string world = {};                 ///< trail of its World, where fields of it are set
  bool timed = false;                     ///< its run is as long as a study says
  std::optional<GroundPlan> ground = {};  ///< in the place of the scene's own

  /// A Param goes to the scene and to its ground, as far as they declare it.
  void give(const DeclaredParameters& declared, const std::string& parameter,
            const std::string& value);
  void set(const std::string& trail, const std::string& value);
  void set_world(const std::string& field, const std::string& value);
  /// The words that are not "".
  void set_world(const Composition& words);
};

/// A scene as it was loaded: the tree, and the experiment that it says.
struct LoadedScene {
  std::unique_ptr<language::Object> tree;
  simulation::Experiment experiment;

  /// The tree after includes, loops and expressions.
  std::string printed() const { return language::print(*tree); }
  /// Files that it was made from and that its run reads.
  std::set<std::string> sources() const;
  /// Hash of the experiment and of the files that its run reads.
  std::string hash() const;
};

/// What a ground's file creates: a Terrain and Materials alone. Null when `diagnostics` got an
/// error.
std::unique_ptr<language::Object> lay_down(language::Library& library, const GroundPlan& ground,
                                           language::Diagnostics& diagnostics);
/// The scene on its ground. Null when `diagnostics` got an error.
std::unique_ptr<language::Object> lay_down(language::Library& library, const ScenePlan& scene,
                                           language::Diagnostics& diagnostics);

/// Nothing when `diagnostics` got an error.
std::optional<LoadedScene> load_scene(language::Library& library, const ScenePlan& scene,
                                      language::Diagnostics& diagnostics);

/// The names of the Params that a file declares.
std::vector<std::string> parameter_names(language::Library& library,
                                         const std::filesystem::path& file,
                                         language::Diagnostics& diagnostics);

/// What the command line sets in every scene that has it.
struct SceneSettings {
  std::vector<language::Override> trails;
  std::vector<std::pair<std::string, std::string>> world;  ///< fields of its World, and values
};

/// The first name of a trail: "world" of "world.deltat".
std::string first_name(const std::string& trail);

/// Those of `settings` that a scene takes: it has a Param of the trail's name, or an object at its
/// top of the trail's first name. Fields of its World come last.
std::vector<language::Override> settings_of_scene(const SceneSettings& settings,
                                                  const std::vector<std::string>& parameters,
                                                  const language::Object& scene,
                                                  const std::string& world);

/// What `options` set, as --set takes it: "slope=5 deg", "world.engine=ode".
std::vector<std::string> setting_words(const language::EvaluateOptions& options);

/// The first of `settings` that sets a field which `one` and `other`, the same scene without the
/// settings, have with different values; null for none.
const language::Override* changed_setting(const std::vector<language::Override>& settings,
                                          const language::Object& one,
                                          const language::Object& other);
/// What is said of it.
std::string decided_already(const language::Override& setting);

/// Why a run of `subject` cannot have `setting`, as it decides of it otherwise; nothing when it
/// can.
std::optional<std::string> setting_problem(const language::Override& setting,
                                           const std::string& world, const SubjectPlan& subject);

}  // namespace hookpoint::studies
