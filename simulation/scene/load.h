// The load step: a checked object tree becomes an Experiment, every number resolved. What no single
// field can show, because it needs the whole experiment, is checked here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Whose choices the law, the engine and the settings of a World are.
enum class RunOf {
  scene,  ///< of the file, and of who runs it
  study,  ///< of a study, whose scene serves runs of several laws and engines
};

/// The experiment of the one World below `root`; nothing when `diagnostics` got an error. A
/// terrain's file is looked up beside the .hook file that names it, then along `search_path`. Cost:
/// linear in the tree, plus the terrain's file. `given`: files that are taken instead of being
/// looked up, by the names that the experiment gives them.
std::optional<Experiment> load_experiment(
    const language::Object& root, language::Diagnostics& diagnostics,
    const std::vector<std::filesystem::path>& search_path = {},
    const std::vector<FileSpec>& given = {}, RunOf run = RunOf::scene);

/// The port of an Expect as its file writes it.
const std::string& port_of_expect(const language::Object& expect);

/// The Material of a Terrain or of a Patch of one; null where it has none.
const language::Object* material_of_ground(const language::Object& ground);

/// Writes the step that was chosen into the World of `root` where it says `deltat = auto` or
/// nothing, so that what is printed of it runs the same.
void write_chosen_step(const Experiment& experiment, language::Object& root);

}  // namespace hookpoint::simulation
