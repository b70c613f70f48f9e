// Runs of a study or a tuning that a cluster makes, as the command line requests them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/shared/task_arguments.h"
#include "studies/cluster/slurm.h"

namespace hookpoint::cli {

/// The exit status when Slurm cannot be used as `arguments` say, with the reason on stderr. Throws
/// studies::NoSlurm.
std::optional<int> slurm_refusal(const application::TaskArguments& arguments);

/// Who makes the runs of `name`, whose results go to `folder`, on a cluster; null where they are
/// made here. `tell` outlives it.
std::unique_ptr<studies::RemoteRuns> remote_runs(const application::TaskArguments& arguments,
                                                 const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 std::function<void(const std::string&)> tell);

/// --dry-run: the script that would be submitted for so many runs.
void print_slurm_script(const application::TaskArguments& arguments, const std::string& name,
                        const std::filesystem::path& folder, std::size_t runs);

/// What `work` returns; when the cluster does not make its runs, the reason and the status of it.
int making_runs_away(const std::function<int()>& work);

}  // namespace hookpoint::cli
