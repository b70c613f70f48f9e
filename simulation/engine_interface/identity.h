// What makes a run the same run: hashes over all that decides its numbers (output/files/hash.h).
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "output/files/result_folder.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The libraries whose classes the experiment uses, each once, by path.
std::vector<std::string> plugins_of(const Experiment& experiment);

/// Of an experiment: its text as printed and the bytes of every file that its run reads (heights,
/// images, data, plugins), wherever these lie. Throws output::FileError.
std::string experiment_hash(const std::string& text, const Experiment& experiment);

/// Hash of a run: of its experiment's hash, this program's bytes, and the engine's name, version,
/// precision, whether it is found and, of a program, its files.
std::string run_hash(const std::string& experiment, const EngineDescription& engine);

/// The files that its run reads, by absolute path.
std::set<std::string> files_read(const Experiment& experiment);

/// Those files with their hashes. Throws output::FileError.
std::vector<output::InputFile> hashed(const std::set<std::string>& paths);

/// "dts 0.1.0, double"; of a program "rapier 0.21.0, single, program 1f0c...".
std::string engine_text(const EngineDescription& engine);

}  // namespace hookpoint::simulation
