#include "apps/cli/cluster_runs.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <utility>

#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "studies/run/results_csv.h"

namespace hookpoint::cli {
namespace {

studies::SlurmRuns::Options slurm_options(const application::TaskArguments& arguments,
                                          const std::string& name,
                                          const std::filesystem::path& folder,
                                          std::function<void(const std::string&)> tell) {
  const char* search_path = std::getenv("HOOKPOINT_PATH");
  studies::SlurmRuns::Options options{
      arguments.slurm_settings,
      {name, std::filesystem::read_symlink("/proc/self/exe"), std::filesystem::current_path(),
       search_path == nullptr ? "" : search_path},
      std::filesystem::absolute(folder / studies::cluster_folder).lexically_normal(),
      {arguments.consent.plugins, arguments.consent.engines, arguments.engine_files},
      arguments.resume,
      std::move(tell)};
  options.settings.jobs = std::max(1, arguments.jobs);
  return options;
}

int fail(const std::exception& error, int status) {
  application::print_error(error.what());
  return status;
}

}  // namespace

std::optional<int> slurm_refusal(const application::TaskArguments& arguments) {
  if (!arguments.slurm) return std::nullopt;
  if (const auto problem = studies::problem_of(arguments.slurm_settings)) {
    application::print_error(*problem);
    return wrong_input;
  }
  if (!arguments.dry_run) studies::need_slurm();
  return std::nullopt;
}

std::unique_ptr<studies::RemoteRuns> remote_runs(const application::TaskArguments& arguments,
                                                 const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 std::function<void(const std::string&)> tell) {
  if (!arguments.slurm) return nullptr;
  return std::make_unique<studies::SlurmRuns>(
      slurm_options(arguments, name, folder, std::move(tell)));
}

void print_slurm_script(const application::TaskArguments& arguments, const std::string& name,
                        const std::filesystem::path& folder, std::size_t runs) {
  studies::SlurmRuns::Options options = slurm_options(arguments, name, folder, {});
  const std::filesystem::path of_job = options.folder / studies::task_number(0);
  options.place.name = studies::job_name(name, of_job);
  const std::size_t chunk = studies::runs_of_a_task(runs, options.settings);
  std::cout << studies::slurm_script(options.settings, options.place, of_job,
                                     (runs + chunk - 1) / chunk);
}

int making_runs_away(const std::function<int()>& work) {
  try {
    return work();
  } catch (const studies::SlurmError& error) {
    return fail(error, truth_failed);
  } catch (const studies::SlurmRefusal& error) {
    return fail(error, wrong_input);
  } catch (const studies::ChangedInput& error) {
    return fail(error, wrong_input);
  }
}

}  // namespace hookpoint::cli
