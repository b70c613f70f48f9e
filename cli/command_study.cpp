#include <algorithm>

#include "cli/exit_status.h"
#include "cli/study_runs.h"

namespace hookpoint::cli {

int study(const StudyArguments& arguments) {
  Application application(arguments.allow_plugins);
  const auto file = plan_study_file(application, arguments);
  if (!file) return wrong_input;
  if (file->size() == 0) {
    print_error(nothing_to_study(arguments.file));
    return wrong_input;
  }
  const StudyCommand command{application.engines(), arguments, *file, rerun_command(arguments)};
  int status = fine;
  for (const studies::StudyPlan& plan : file->studies)
    status = std::max(status, run_one_study(command, plan));
  for (const studies::WallPlan& plan : file->walls)
    status = std::max(status, run_one_wall(command, plan));
  for (const MatrixPlan& plan : file->matrices)
    status = std::max(status, run_one_matrix(command, plan));
  return status;
}

}  // namespace hookpoint::cli
