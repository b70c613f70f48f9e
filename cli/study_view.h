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

#include "application/study_plans.h"
#include "cli/child_program.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "view/server.h"
#include "view/study_board.h"

namespace hookpoint::cli {

class StudyView {
 public:
  /// Listens. `file` outlives it. Throws view::ServerError.
  StudyView(const ViewArguments& view, const application::StudyArguments& arguments,
            const application::StudyFile& file);
  ~StudyView();

  std::string url() const { return server_.url(); }

  /// The options with which `plan`, of the file, is run so that its table fills.
  studies::RunOptions watch(const studies::StudyPlan& plan, studies::RunOptions options);
  /// It ran to its end: what all rows together tell, too.
  void finish(const studies::StudyPlan& plan, const studies::StudyResult& result,
              const std::filesystem::path& report);
  /// A Wall, of which a row tells all.
  void finish(const studies::StudyPlan& plan, const std::filesystem::path& report);
  void interrupt(const studies::StudyPlan& plan);

  /// Has `work`, which calls those above, done beside it and answers pages until it is done and the
  /// user has closed: by a signal, or the page's `quit`, which interrupts work that is not done.
  /// What `work` gives, or throws.
  int serve(const std::function<int()>& work, const InterruptGuard& guard);

 private:
  using Clock = std::chrono::steady_clock;

  /// A study of the board.
  struct Shown {
    const studies::StudyPlan* plan;
    std::filesystem::path folder;               ///< of its results
    std::optional<studies::StudyResult> table;  ///< so far; none of a Wall
    bool figures_are_old = false;
    bool progress_is_old = false;
  };
  /// The run of a row in a window of its own.
  struct Window {
    view::OpenRow of;
    std::unique_ptr<ChildProgram> program;
    std::string url;                                                     ///< "" until it is ready
    std::vector<std::pair<view::Server::ClientId, std::int64_t>> asked;  ///< who waits for it
  };

  std::size_t index_of(const studies::StudyPlan& plan) const { return places_.at(&plan); }
  void show_row(std::size_t study, std::size_t row, const studies::RunResult& result);
  void show_progress(std::size_t study, const studies::Progress& progress);
  void show_figures(std::size_t study);
  void broadcast(const std::string& message);
  void tell_changes();
  void answer(const view::Server::Event& event, const InterruptGuard& guard);
  void open(const view::OpenRow& row, view::Server::ClientId client, std::int64_t id);
  void tell_windows();

  const application::StudyArguments& arguments_;
  const std::string address_;
  std::map<const studies::StudyPlan*, std::size_t> places_;
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
