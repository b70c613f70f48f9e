#include <filesystem>
#include <set>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "apps/shared/application.h"
#include "studies/cluster/shard.h"

namespace hookpoint::cli {

int runs(const RunsArguments& arguments) {
  try {
    const studies::RunList list = studies::read_run_list(arguments.list);
    application::Application application({list.code.allow_plugins, list.code.allow_engines});
    std::set<std::filesystem::path> scenes(list.code.engine_files.begin(),
                                           list.code.engine_files.end());
    for (const studies::RunRequest& run : list.runs) scenes.insert(run.scene.file);
    for (const std::filesystem::path& scene : scenes)
      if (!application.load_plugins(scene)) return wrong_input;
    studies::Journal journal(arguments.journal);
    const InterruptGuard guard;
    const bool all = studies::run_shard(list, journal, application.library(), application.engines(),
                                        arguments.jobs, guard.stop());
    return all ? fine : guard.status();
  } catch (const studies::RunListError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
