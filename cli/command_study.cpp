#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/cluster_runs.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "cli/keeping_runs.h"
#include "cli/open_browser.h"
#include "cli/study_runs.h"

namespace hookpoint::cli {
namespace {

/// Every block of the file; once one was interrupted the others are not begun.
int run_all(const StudyCommand& command) {
  int status = fine;
  const auto run_each = [&](const auto& plans, auto run_one) {
    for (const auto& plan : plans)
      if (status <= missing) status = std::max(status, run_one(command, plan));
  };
  run_each(command.file.studies, run_one_study);
  run_each(command.file.walls, run_one_wall);
  run_each(command.file.matrices, run_one_matrix);
  return status;
}

int run_all_viewed(StudyCommand command, const ViewArguments& arguments) {
  std::unique_ptr<StudyView> view;
  try {
    view = std::make_unique<StudyView>(arguments, command.arguments, command.file);
  } catch (const view::ServerError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
  command.view = view.get();
  std::cout << view->url() << std::endl;
  if (arguments.open) open_browser(view->url());
  return view->serve([&] { return run_all(command); }, command.guard);
}

}  // namespace

int study(const application::StudyArguments& asked, const std::optional<ViewArguments>& view) {
  application::Application application(asked.allow_plugins);
  application::StudyArguments arguments = asked;
  arguments.file = application.locate(asked.file);
  if (const auto refusal = slurm_refusal(arguments)) return *refusal;
  const auto file = application::plan_study_file(application, arguments);
  if (!file) return wrong_input;
  if (file->size() == 0) {
    application::print_error(application::nothing_to_study(arguments.file));
    return wrong_input;
  }
  const InterruptGuard guard;
  StudyCommand command{application.engines(), arguments, *file,
                       application::rerun_command(arguments), guard};
  if (arguments.dry_run) return print_slurm_scripts(command);
  return making_runs_away([&] {
    return keeping_runs([&] {
      command.store = application::shared_store(arguments, *file);
      return view ? run_all_viewed(command, *view) : run_all(command);
    });
  });
}

}  // namespace hookpoint::cli
