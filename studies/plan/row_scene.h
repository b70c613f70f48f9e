// Where a row's experiment comes from. A plan of 100,000 rows has no room for their experiments:
// each is loaded when it is asked for.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "language/document.h"
#include "simulation/experiment.h"

namespace hookpoint::studies {

/// The file of a ground and values of its Params, the language's text.
struct RowGround {
  std::filesystem::path file;
  std::map<std::string, std::string> parameters;
};

/// A scene's file and what is set in it from outside.
struct RowScene {
  std::filesystem::path file;
  language::EvaluateOptions options;  ///< `amend` is this header's
  std::string timed_world = {};  ///< trail of its World where its run is as long as a study says
  std::optional<RowGround> ground = {};  ///< in the place of the scene's own
};

struct LoadedScene {
  simulation::Experiment experiment;
  std::string printed;            ///< what it was made of, after includes, loops and expressions
  std::set<std::string> sources;  ///< files that it was made from and that its run reads
  std::unique_ptr<language::Object> tree = nullptr;  ///< what it was loaded from
};

/// What a ground's file lays down: a Terrain and Materials alone. Null when `diagnostics` got an
/// error.
std::unique_ptr<language::Object> lay_down(language::Library& library, const RowGround& ground,
                                           language::Diagnostics& diagnostics);
/// The scene on its ground. Null when `diagnostics` got an error.
std::unique_ptr<language::Object> lay_down(language::Library& library, const RowScene& scene,
                                           language::Diagnostics& diagnostics);

/// Nothing when `diagnostics` got an error.
std::optional<LoadedScene> load_scene(language::Library& library, const RowScene& scene,
                                      language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
