// The script of a Slurm job that makes runs, and what a user may say about it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace hookpoint::studies {

struct SlurmSettings {
  std::string partition, account, time;  ///< "" for the cluster's own
  std::size_t chunk = 0;                 ///< runs of a task; 0: as `runs_of_a_task` has it
  std::size_t array_limit = 0;           ///< tasks at a time; 0: as many as the cluster gives
  int jobs = 1;                          ///< threads, and processors, of a task
};

/// The options of the command line that say them, each after a space: " --slurm --partition short".
std::string option_words(const SlurmSettings& settings);

/// What is wrong with them, as a sentence; nothing when Slurm may be used.
std::optional<std::string> problem_of(const SlurmSettings& settings);

/// How many runs a task makes of `runs`: so few that several machines have something to do, and so
/// many that there are at most the 1000 tasks which Slurm takes unless configured otherwise.
std::size_t runs_of_a_task(std::size_t runs, const SlurmSettings& settings);

/// "00042": of a task's files.
std::string task_number(std::size_t task);
/// Its list of runs, its journal, and what it printed, in the job's folder.
std::filesystem::path list_of(const std::filesystem::path& folder, std::size_t task);
std::filesystem::path journal_of(const std::filesystem::path& folder, std::size_t task);
std::filesystem::path log_of(const std::filesystem::path& folder, std::size_t task);

/// Where and with what the tasks run.
struct SlurmPlace {
  std::string name;                 ///< of the job, in Slurm's lists
  std::filesystem::path program;    ///< this one
  std::filesystem::path directory;  ///< in which it was started
  std::string search_path;          ///< HOOKPOINT_PATH
};

/// The name of the job that makes runs of `study` from `folder`: no two folders share one.
std::string job_name(const std::string& study, const std::filesystem::path& folder);

/// For bash: a task for each of `tasks` lists in `folder`. Whatever stands in a path or a name is
/// no command.
std::string slurm_script(const SlurmSettings& settings, const SlurmPlace& place,
                         const std::filesystem::path& folder, std::size_t tasks);

}  // namespace hookpoint::studies
