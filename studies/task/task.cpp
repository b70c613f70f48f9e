#include "studies/task/task.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hookpoint::studies {

TaskStatus Task::run(TaskRunner& runner, const std::shared_ptr<RunStore>& store) {
  RunOptions options = runner.options();
  options.folder = folder_;
  options.store = store;
  runner.run(*this, std::move(options),
             [&](const RunOptions& watched, const std::atomic<bool>& stop) {
               execute(watched, runner, stop);
             });
  for (const std::string& notice : notices()) runner.note(notice);
  if (!has_result()) return TaskStatus::interrupted;
  std::vector<std::string> undrawn;
  if (runner.wants_reports()) {
    undrawn = leave();
    if (forms_.any()) {
      std::vector<std::string> others = write_publication(*files_, publication(), forms_);
      std::ranges::move(others, std::back_inserter(undrawn));
    }
  }
  for (const std::string& message : undrawn) runner.problem(message);
  runner.left(*this);
  files_.reset();
  if (!is_whole()) return TaskStatus::interrupted;
  return !holds()          ? TaskStatus::fails
         : undrawn.empty() ? TaskStatus::holds
                           : TaskStatus::incomplete;
}

}  // namespace hookpoint::studies
