#include "cli/run_bar.h"

#include <algorithm>
#include <thread>

#include "cli/application.h"
#include "cli/exit_status.h"

namespace hookpoint::cli {

void RunBar::show(const studies::Progress& progress) {
  if (!bar_) bar_.emplace(name_, progress.total, progress.resumed);
  shown_ = std::max(shown_, progress.resumed);
  if (progress.done > shown_) bar_->advance(progress.done - shown_);
  shown_ = std::max(shown_, progress.done);
}

studies::RunOptions run_options(const StudyArguments& arguments,
                                const std::filesystem::path& folder, RunBar& bar) {
  studies::RunOptions options;
  options.jobs = arguments.jobs > 0
                     ? arguments.jobs
                     : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.resume = arguments.resume;
  options.folder = folder;
  options.progress = [&bar](const studies::Progress& progress) { bar.show(progress); };
  return options;
}

int interrupted(const std::filesystem::path& folder, const std::string& command,
                const StudyArguments& arguments) {
  const std::string out = arguments.out ? " --out " + arguments.out->string() : "";
  print_error("interrupted; what is finished is kept in " + folder.string() + ": `" + command +
              out + " --resume` goes on from there");
  return truth_failed;
}

}  // namespace hookpoint::cli
