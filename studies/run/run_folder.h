// The folder that a run, a study or a Wall left, read back.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "output/result_folder.h"
#include "output/text/csv.h"

namespace hookpoint::studies {

/// Not a folder that can be compared; the message says what to give instead.
struct RunFolderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Settings in the order of their file: trail and value.
using SettingList = std::vector<std::pair<std::string, std::string>>;

struct RunFolder {
  std::filesystem::path path;
  SettingList experiment;     ///< of experiment.hook and, after it, a study's scene.hook
  SettingList provenance;     ///< of provenance.json, by path; of a run what files.json says
  output::Manifest manifest;  ///< its files.json
  std::optional<output::CsvTable> results, timing;       ///< of a study, a Wall or a matrix
  std::map<std::string, output::CsvTable> trajectories;  ///< by file name, "trace.csv"
  std::map<std::string, std::filesystem::path> records;  ///< in formats that are not text
  std::vector<std::string> notes;  ///< "trace.csv is of a run that did not end"
};

/// Throws RunFolderError: no such folder, not a run's, a file in it that cannot be read or is not
/// of that run, as its files.json has it.
RunFolder read_run_folder(const std::filesystem::path& folder);

/// The objects and fields of a text that language::print wrote, by trail: {"world.deltat",
/// "0.001 s"}. An object without a name goes by its type; one of several siblings by that name is
/// numbered, `Patch[1]`, or goes by `name (Type)` where their types differ. An object's own entry
/// is its type; a wire's, under its two ends, what it says of rate, delay and noise.
SettingList settings_of_text(const std::string& text);

}  // namespace hookpoint::studies
