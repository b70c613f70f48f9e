#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "apps/cli/cluster_runs.h"
#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "apps/cli/keeping_runs.h"
#include "apps/cli/open_browser.h"
#include "apps/cli/run_bar.h"
#include "apps/cli/scene_picture.h"
#include "apps/cli/study_view.h"
#include "output/files/file.h"
#include "text/shell_word.h"
#include "text/terminal.h"

namespace hookpoint::cli {
namespace {

using application::TaskArguments;
using studies::Task;
using studies::TaskStatus;

void print_note(const std::string& message) { std::cerr << "hookpoint: note: " << message << '\n'; }

studies::TableStyle style_of_stdout() {
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return {text::wants_colours(STDOUT_FILENO),
          known ? std::max<std::size_t>(size.ws_col, 60) : studies::TableStyle{}.width};
}

/// Runs the tasks of one command, with a progress bar each, notices on stderr, and the page where
/// there is one.
class TerminalRunner : public studies::TaskRunner {
 public:
  TerminalRunner(const TaskArguments& arguments, std::string command, const InterruptGuard& guard)
      : arguments_(arguments), command_(std::move(command)), guard_(guard) {}

  /// Every task; once one was interrupted the others are not begun. `store`: that all share, or
  /// null. `view`: the page, or null. The exit status.
  int run_all(const studies::Tasks& tasks, const std::shared_ptr<studies::RunStore>& store,
              StudyView* view) {
    view_ = view;
    int status = fine;
    for (const auto& task : tasks)
      if (status <= missing) status = std::max(status, run_one(*task, store));
    return status;
  }

  studies::RunOptions options() const override {
    studies::RunOptions options;
    options.jobs = arguments_.threads();
    options.resume = arguments_.resume;
    return options;
  }

  void run(const Task& task, studies::RunOptions options, const Work& work) override {
    begun_ = &task;
    RunBar bar(task.name());
    bar_ = &bar;
    options = bar.watch(std::move(options));
    if (StudyView* page = page_of(task)) options = page->watch(task, std::move(options));
    std::unique_ptr<studies::RemoteRuns> remote;
    if (const std::string why = task.runs_here(); why.empty())
      remote = remote_runs(arguments_, task.name(), task.folder(), print_note);
    else if (arguments_.slurm)
      note(why);
    options.remote = remote.get();
    work(options, guard_.stop());
    bar_ = nullptr;
  }

  void note(const std::string& message) override { print_note(message); }
  void warn(const std::string& message) override { print_note(message); }
  void message(const std::string& message) override { bar_->message(message); }
  void problem(const std::string& message) override { application::print_error(message); }
  bool wants_reports() const override { return true; }

  void left(Task& task) override {
    StudyView* page = page_of(task);
    if (page == nullptr) return;
    page->finish(task);
    add_picture(task);
  }

 private:
  /// The page, where it shows the task.
  StudyView* page_of(const Task& task) const {
    return task.rows_plan() == nullptr ? nullptr : view_;
  }

  int run_one(Task& task, const std::shared_ptr<studies::RunStore>& store) {
    if (const std::string why = task.missing(); !why.empty()) {
      application::print_error(why);
      return missing;
    }
    const TaskStatus status = run_into_folder(task, store);
    print_result(task);
    if (status == TaskStatus::interrupted) {
      if (StudyView* page = page_of(*begun_)) page->interrupt(*begun_);
      application::print_error("interrupted" + how_to_continue(*begun_));
      return guard_.status();
    }
    for (const std::string& fault : task.faults())
      application::print_error(task.name() + ": " + fault);
    return status == TaskStatus::fails        ? truth_failed
           : status == TaskStatus::incomplete ? missing
                                              : fine;
  }

  /// When the disk refuses, the error says how to continue.
  TaskStatus run_into_folder(Task& task, const std::shared_ptr<studies::RunStore>& store) {
    try {
      return task.run(*this, store);
    } catch (const output::PlaceError& error) {
      throw output::PlaceError(error.what() + how_to_continue(task));
    } catch (const output::FileError& error) {
      throw output::FileError(error.what() + how_to_continue(task));
    } catch (const studies::StoreError& error) {
      throw studies::StoreError(error.what() + how_to_continue(task));
    } catch (const studies::SlurmError& error) {
      throw studies::SlurmError(error.what() + how_to_continue(task));
    }
  }

  /// That finished runs are stored, and how to continue; "" when none are.
  std::string how_to_continue(const Task& task) const {
    std::error_code ignored;
    if (!std::filesystem::exists(task.folder() / output::Manifest::file_name, ignored)) return "";
    const auto& out = arguments_.out;
    return "; what is finished is kept in " + task.folder().string() + ": `" + command_ +
           (out ? " --out " + text::shell_word(out->string()) : "") +
           " --resume` continues from there";
  }

  /// The text on stdout, unless a page shows it, and where the report is.
  void print_result(const Task& task) const {
    const std::string text = task.terminal_text(style_of_stdout());
    if (text.empty()) return;
    if (view_ == nullptr) std::cout << text;
    (view_ == nullptr ? std::cout : std::cerr)
        << task.page() << ": " << task.page_file().string() << '\n';
  }

  /// Nobody waits for the browser: the page has the report before, and who goes gets no picture.
  void add_picture(Task& task) const {
    const auto scene = task.pictured_scene(task.folder() / "pictures");
    if (!scene) return;
    const std::string problem = draw_scene_picture(
        {scene->file, scene->settings, arguments_.consent, task.folder() / Task::picture},
        guard_.stop());
    if (problem.empty())
      task.add_picture();
    else if (!guard_.stop())
      print_note("the report has no picture of the scene: " + problem);
  }

  const TaskArguments& arguments_;
  const std::string command_;
  const InterruptGuard& guard_;
  StudyView* view_ = nullptr;
  RunBar* bar_ = nullptr;
  const Task* begun_ = nullptr;  ///< last
};

/// The same with a page, which is served until the user closes it.
int run_viewed(TerminalRunner& runner, const TaskArguments& arguments, const ViewArguments& asked,
               const studies::Tasks& tasks, const std::shared_ptr<studies::RunStore>& store,
               const InterruptGuard& guard) {
  std::unique_ptr<StudyView> view;
  try {
    view = std::make_unique<StudyView>(asked, arguments, tasks);
  } catch (const view::ServerError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
  std::cout << view->url() << std::endl;
  if (asked.open) open_browser(view->url());
  return view->serve([&] { return runner.run_all(tasks, store, view.get()); }, guard);
}

/// --dry-run: the scripts that the tasks would be submitted with, on stdout.
int print_slurm_scripts(const TaskArguments& arguments, const studies::Tasks& tasks) {
  for (const auto& task : tasks)
    for (const Task* part : task->parts()) {
      const std::string here = part->runs_here();
      const std::size_t runs = part->remote_runs();
      if (!here.empty())
        print_note(here);
      else if (runs == 0)
        print_note(part->name() + " has no run for a cluster");
      else
        print_slurm_script(arguments, part->name(), part->folder(), runs);
    }
  return fine;
}

}  // namespace

int run_tasks(const application::TaskCommand& command, const TaskArguments& asked,
              const std::optional<ViewArguments>& view) {
  application::Application application(asked.consent);
  TaskArguments arguments = asked;
  arguments.file = application.locate(asked.file);
  return run_tasks(application, command, std::move(arguments), view);
}

int run_tasks(application::Application& application, const application::TaskCommand& command,
              TaskArguments arguments, const std::optional<ViewArguments>& view) {
  if (const auto refusal = slurm_refusal(arguments)) return *refusal;
  application::TaskApplication host(application, command, arguments);
  const auto tasks = host.plan();
  if (!tasks) return wrong_input;
  if (tasks->empty()) {
    application::print_error(application::nothing_to_run(arguments.file, command, command.instead));
    return wrong_input;
  }
  arguments.engine_files = application.engine_files();
  if (arguments.dry_run) return print_slurm_scripts(arguments, *tasks);
  const InterruptGuard guard;
  return making_runs_away([&] {
    return keeping_runs([&] {
      TerminalRunner runner(arguments, application::rerun_command(command.name, arguments), guard);
      const auto store = host.shared_store(*tasks);
      return view ? run_viewed(runner, arguments, *view, *tasks, store, guard)
                  : runner.run_all(*tasks, store, nullptr);
    });
  });
}

}  // namespace hookpoint::cli
