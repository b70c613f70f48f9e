#include "studies/run/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "output/files/file.h"
#include "output/files/hash.h"
#include "text/json_reader.h"

namespace hookpoint::studies {
namespace {

namespace fs = std::filesystem;

constexpr const char* what_to_give =
    "compare takes the folder that `hookpoint run --out` or `hookpoint study` left";

std::string content(const fs::path& file) {
  auto text = output::read_file(file);
  if (!text) throw RunFolderError(file.string() + " cannot be read");
  return std::move(*text);
}

bool is_run(const fs::path& folder) { return fs::is_regular_file(folder / "experiment.hook"); }

/// Why `folder` is not a run's; the runs that it holds, if it does.
[[noreturn]] void refuse(const fs::path& folder) {
  const std::string name = folder.string();
  if (!fs::exists(folder))
    throw RunFolderError(fmt::format("there is no folder {}; {}", name, what_to_give));
  if (!fs::is_directory(folder))
    throw RunFolderError(fmt::format("{} is a file; {}", name, what_to_give));
  std::vector<std::string> runs;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (is_run(entry.path())) runs.push_back(entry.path().string());
  std::ranges::sort(runs);
  if (runs.empty())
    throw RunFolderError(fmt::format("{} has no experiment.hook; {}", name, what_to_give));
  std::string all;
  for (const std::string& run : runs) all += (all.empty() ? "" : ", ") + run;
  throw RunFolderError(fmt::format("{} holds several runs; compare one of {}", name, all));
}

output::Manifest manifest_of(const fs::path& folder) {
  try {
    if (auto manifest = output::read_manifest(folder)) return std::move(*manifest);
  } catch (const output::FolderError& error) {
    throw RunFolderError(error.what());
  }
  throw RunFolderError(fmt::format(
      "{} has no {}, which ties its files to its experiment: it is of an older version or not the "
      "whole folder; run it again",
      folder.string(), output::Manifest::file_name));
}

/// Refuses the folder of a tuning: its tables are neither trajectories nor rows of runs.
void check_kind(const RunFolder& run) {
  const auto is_run_key = [](const auto& entry) { return entry.first == "run"; };
  const auto& files = run.manifest.files;
  if (std::ranges::any_of(run.manifest.about, is_run_key) || files.contains("results.csv") ||
      files.contains("matrix.csv"))
    return;
  throw RunFolderError(
      fmt::format("{} is neither a run nor a study; {}", run.path.string(), what_to_give));
}

/// Refuses a file that is not as the run left it which the manifest is of.
void check_belongs(const RunFolder& run, const fs::path& file) {
  fs::path name = file.lexically_relative(run.path);
  if (name.extension() == ".partial") name.replace_extension();
  const auto listed = run.manifest.files.find(name);
  const auto fail = [&file](const char* why) {
    throw RunFolderError(
        fmt::format("{} {}: it says nothing of the run whose experiment.hook lies beside it; move "
                    "it away, or run that again",
                    file.string(), why));
  };
  if (listed == run.manifest.files.end()) fail("is of no run of this folder");
  if (!listed->second.empty() && output::hash_of_file(file) != listed->second)
    fail("is not the file that its run left");
}

/// The text of a file of the run, nothing where there is none.
std::optional<std::string> content(const RunFolder& run, const fs::path& file) {
  if (!fs::is_regular_file(file)) return std::nullopt;
  check_belongs(run, file);
  return content(file);
}

std::optional<output::CsvTable> read_table(const RunFolder& run, const fs::path& file) {
  const auto text = content(run, file);
  if (!text) return std::nullopt;
  auto table = output::parse_csv(*text);
  if (!table) throw RunFolderError(file.string() + " is no table of comma-separated values");
  return table;
}

void read_experiment(RunFolder& run) {
  for (const char* name : {"experiment.hook", "scene.hook"}) {
    auto text = content(run, run.path / name);
    if (!text) continue;
    const auto settings = settings_of_text(std::move(*text));
    if (!settings) throw RunFolderError((run.path / name).string() + " is no experiment");
    run.experiment.insert(run.experiment.end(), settings->begin(), settings->end());
  }
}

/// By name: where a file lies is no setting, and what a .hook file says is compared as settings.
void add_inputs(const std::vector<output::InputFile>& inputs, SettingList& settings) {
  for (const output::InputFile& input : inputs) {
    const fs::path path(input.path);
    if (path.extension() == ".hook") continue;
    settings.emplace_back("inputs." + path.filename().string(), input.hash);
  }
}

/// Of a study its provenance.json, of a run what files.json says.
void read_provenance(RunFolder& run) {
  const fs::path file = run.path / "provenance.json";
  const auto text = content(run, file);
  if (!text) {
    run.provenance.emplace_back("hash", run.manifest.experiment);
    for (const auto& [key, value] : run.manifest.about)
      if (key != "run") run.provenance.emplace_back(key, value);
    return add_inputs(run.manifest.inputs, run.provenance);
  }
  const auto leaves = text::json_leaves(*text);
  if (!leaves) throw RunFolderError(file.string() + " is not JSON");
  std::vector<output::InputFile> inputs;
  for (const auto& [key, value] : *leaves) {
    if (!key.starts_with("inputs["))
      run.provenance.emplace_back(key, value);
    else if (key.ends_with(".path"))
      inputs.push_back({value, {}});
    else if (!inputs.empty())
      inputs.back().hash = value;
  }
  add_inputs(inputs, run.provenance);
}

/// Traces of a study stand in traces/; what else it leaves beside results.csv is made of them. A
/// single run has its trace.csv and its Records beside experiment.hook.
void read_trajectories(RunFolder& run) {
  const fs::path folder = run.results ? run.path / "traces" : run.path;
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    fs::path name = entry.path().filename();
    const bool cut_off = name.extension() == ".partial";
    if (cut_off) name = name.stem();
    const std::string type = name.extension().string();
    if (type == ".csv") {
      if (cut_off) run.notes.push_back(name.string() + " is of a run that did not end");
      run.trajectories.emplace(name.string(), read_table(run, entry.path()).value());
    } else if (!cut_off && (type == ".mat" || type == ".h5" || type == ".wl" || type == ".mcap")) {
      check_belongs(run, entry.path());
      run.records.emplace(name.string(), entry.path());
    }
  }
  std::ranges::sort(run.notes);
}

}  // namespace

RunFolder read_run_folder(const fs::path& folder) {
  if (!is_run(folder)) refuse(folder);
  RunFolder run;
  run.path = folder;
  run.manifest = manifest_of(folder);
  check_kind(run);
  for (const auto& [name, hash] : run.manifest.files)
    if (!hash.empty() && !fs::exists(folder / name))
      run.notes.push_back(name + ", which its run left, is not there");
  read_experiment(run);
  read_provenance(run);
  run.results = read_table(run, folder / "results.csv");
  if (!run.results) run.results = read_table(run, folder / "matrix.csv");
  run.timing = read_table(run, folder / "timing.csv");
  read_trajectories(run);
  return run;
}

}  // namespace hookpoint::studies
