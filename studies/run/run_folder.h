// The folder that a run, a study or a Wall left, read back.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "output/files/csv.h"
#include "output/files/result_folder.h"
#include "studies/run/setting_list.h"

namespace hookpoint::studies {

/// Not a folder that can be compared; the message says what to give instead.
struct RunFolderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

}  // namespace hookpoint::studies
