#include <algorithm>

#include "cli/exit_status.h"
#include "cli/study_runs.h"

namespace hookpoint::cli {

int study(const application::StudyArguments& asked) {
  application::Application application(asked.allow_plugins);
  application::StudyArguments arguments = asked;
  arguments.file = application.locate(asked.file);
  const auto file = application::plan_study_file(application, arguments);
  if (!file) return wrong_input;
  if (file->size() == 0) {
    application::print_error(application::nothing_to_study(arguments.file));
    return wrong_input;
  }
  const InterruptGuard guard;
  const StudyCommand command{application.engines(), arguments, *file,
                             application::rerun_command(arguments), guard};
  int status = fine;
  const auto run_all = [&](const auto& plans, auto run_one) {
    // Once one was interrupted the others are not begun.
    for (const auto& plan : plans)
      if (status <= missing) status = std::max(status, run_one(command, plan));
  };
  run_all(file->studies, run_one_study);
  run_all(file->walls, run_one_wall);
  run_all(file->matrices, run_one_matrix);
  return status;
}

}  // namespace hookpoint::cli
