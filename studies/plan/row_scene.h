// Where a row's experiment comes from. A plan of 100,000 rows has no room for their experiments:
// each is loaded when it is asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "language/document.h"
#include "simulation/experiment.h"

namespace hookpoint::studies {

/// A scene's file and what is set in it from outside.
struct RowScene {
  std::filesystem::path file;
  language::EvaluateOptions options;
  std::string timed_world = {};  ///< trail of its World where its run is as long as a study says
};

struct LoadedScene {
  simulation::Experiment experiment;
  std::string printed;            ///< what it was made of, after includes, loops and expressions
  std::set<std::string> sources;  ///< files that it was made from and that its run reads
};

/// Nothing when `diagnostics` got an error.
std::optional<LoadedScene> load_scene(language::Library& library, const RowScene& scene,
                                      language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
