// `study --view`: a page whose table and figures fill while the studies run, and from which a row's
// run is opened in a window of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/interrupt.h"
#include "apps/view/wire/server.h"
#include "apps/view/wire/study_board.h"
#include "output/files/child_program.h"

namespace hookpoint::cli {

class StudyView {
 public:
  /// Listens. `tasks` outlive it. Throws view::ServerError.
  StudyView(const ViewArguments& view, const application::TaskArguments& arguments,
            const studies::Tasks& tasks);
  ~StudyView();

  std::string url() const { return server_.url(); }

  /// The options with which a task, or a part of one, is run so that its table fills.
  studies::RunOptions watch(const studies::Task& task, studies::RunOptions options);
  /// It ran to its end, and its report is written.
  void finish(const studies::Task& task);
  void interrupt(const studies::Task& task);

  /// Has `work`, which calls those above, done beside it and answers pages until it is done and the
  /// user has closed: by a signal, or the page's `quit`, which interrupts work that is not done.
  /// What `work` gives, or throws.
  int serve(const std::function<int()>& work, const InterruptGuard& guard);

 private:
  using Clock = std::chrono::steady_clock;

  /// A study of the board.
  struct Shown {
    const studies::Task* task;
    studies::StudyResult table;  ///< so far
    bool figures_are_old = false;
    bool progress_is_old = false;
  };
  /// The run of a row in a window of its own.
  struct Window {
    view::OpenRow of;
    std::unique_ptr<output::ChildProgram> program;
    std::string url;  ///< "" until it is ready
    std::vector<std::pair<view::Server::ClientId, std::int64_t>>
        waiting;  ///< whom its answer goes to
  };

  std::size_t index_of(const studies::Task& task) const { return places_.at(&task); }
  void show_row(std::size_t study, std::size_t row, const studies::RunResult& result);
  void show_progress(std::size_t study, const studies::Progress& progress);
  void show_figures(std::size_t study);
  void broadcast(const std::string& message);
  void tell_changes();
  void answer(const view::Server::Event& event, const InterruptGuard& guard);
  void open(const view::OpenRow& row, view::Server::ClientId client, std::int64_t id);
  void tell_windows();

  const application::TaskArguments& arguments_;
  const std::string address_;
  std::map<const studies::Task*, std::size_t> places_;
  view::Server server_;
  std::vector<Window> windows_;
  bool quit_ = false;

  /// What the threads that run rows, and the one that answers, share.
  std::mutex mutex_;
  std::vector<Shown> shown_;
  view::StudyBoard board_;
  Clock::time_point next_figures_, next_progress_;
};

}  // namespace hookpoint::cli
