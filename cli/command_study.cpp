#include <algorithm>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "cli/matrices.h"
#include "cli/study_runs.h"
#include "cli/walls.h"

namespace hookpoint::cli {

int study(const StudyArguments& arguments) {
  Application application(arguments.allow_plugins);
  const auto root = application.evaluate(arguments.file, {});
  if (!root) return wrong_input;
  const auto matrices = root->children_of("Matrix");
  if (root->children_of("Study").empty() && root->children_of("Wall").empty() && matrices.empty()) {
    print_error(arguments.file.string() +
                " holds no Study, no Wall and no Matrix; `hookpoint run` runs a world");
    return wrong_input;
  }
  if (!application.load_scene_plugins(*root, arguments.file)) return wrong_input;
  const auto plans =
      plan_studies(application, *root, arguments.file, {arguments.quick, arguments.only});
  if (!plans) return wrong_input;
  const std::string command = rerun_command(arguments, arguments.file);
  int status = fine;
  for (const studies::StudyPlan& plan : *plans) {
    std::filesystem::path folder;
    if (arguments.out) folder = plans->size() > 1 ? *arguments.out / plan.name : *arguments.out;
    status =
        std::max(status, run_one_study(application, plan, arguments, folder, command, true).status);
  }
  status = std::max(status, run_walls(application, *root, arguments, command));
  return std::max(status, run_matrices(application, *root, arguments, command));
}

}  // namespace hookpoint::cli
