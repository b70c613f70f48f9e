#include "apps/cli/study_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <utility>

#include "apps/cli/study_boards.h"
#include "apps/view/page_bundle.h"
#include "studies/run/scene_file.h"

namespace hookpoint::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds between_looks{50};
constexpr milliseconds between_progress{200};
constexpr milliseconds between_figures{500};
/// Between two drawings of the figures, in times that one takes.
constexpr int figures_pause = 10;
/// Each is a run of its own: the oldest makes room.
constexpr std::size_t most_windows = 8;

/// Tasks and parts of tasks that have a table of runs.
std::vector<const studies::Task*> tables_of(const studies::Tasks& tasks) {
  std::vector<const studies::Task*> tables;
  for (const auto& task : tasks)
    for (const studies::Task* part : task->parts())
      if (part->rows_plan() != nullptr) tables.push_back(part);
  return tables;
}

std::vector<view::BoardStudy> boards_of(const studies::Tasks& tasks) {
  std::vector<view::BoardStudy> boards;
  for (const studies::Task* task : tables_of(tasks)) boards.push_back(board_of(task->empty_rows()));
  return boards;
}

std::string without_line_ends(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

}  // namespace

StudyView::StudyView(const ViewArguments& view, const application::TaskArguments& arguments,
                     const studies::Tasks& tasks)
    : arguments_(arguments),
      address_(view.bind),
      server_({view.bind, view.port, view.token.value_or(view::fresh_token())},
              page_bundle::index_html),
      board_(arguments.file.filename().string(), HOOKPOINT_VERSION, boards_of(tasks)) {
  for (const studies::Task* task : tables_of(tasks)) {
    places_[task] = shown_.size();
    shown_.push_back({task, task->empty_rows()});
  }
}

StudyView::~StudyView() = default;

studies::RunOptions StudyView::watch(const studies::Task& task, studies::RunOptions options) {
  const std::size_t study = index_of(task);
  options.row_done = [this, study](std::size_t row, const studies::RunResult& result) {
    show_row(study, row, result);
  };
  options.progress = [this, study,
                      told = std::move(options.progress)](const studies::Progress& progress) {
    if (told) told(progress);
    show_progress(study, progress);
  };
  const std::lock_guard lock(mutex_);
  broadcast(board_.set_state(study, view::BoardState::running));
  return options;
}

void StudyView::show_row(std::size_t study, std::size_t row, const studies::RunResult& result) {
  view::BoardRow shown = board_row(result);
  const std::lock_guard lock(mutex_);
  shown_[study].table.rows[row] = result;
  shown_[study].figures_are_old = true;
  broadcast(board_.set_row(study, row, std::move(shown)));
}

void StudyView::show_progress(std::size_t study, const studies::Progress& progress) {
  const std::lock_guard lock(mutex_);
  // Its message waits: the newest counts.
  board_.set_progress(study, {progress.done, progress.total, progress.seconds_left});
  shown_[study].progress_is_old = true;
}

void StudyView::show_figures(std::size_t study) {
  const studies::StudyResult& table = shown_[study].table;
  for (std::size_t plot = 0; plot < table.plots.size(); ++plot)
    broadcast(board_.set_figure(study, plot, board_figure(table, plot)));
  shown_[study].figures_are_old = false;
}

void StudyView::finish(const studies::Task& task) {
  const std::size_t study = index_of(task);
  const std::lock_guard lock(mutex_);
  if (const studies::StudyResult* result = task.rows()) {
    shown_[study].table = *result;
    for (std::size_t row = 0; row < result->rows.size(); ++row)
      broadcast(board_.set_row(study, row, board_row(result->rows[row])));
    show_figures(study);
  }
  broadcast(board_.set_progress(study, board_.studies()[study].progress));
  broadcast(board_.set_state(study, view::BoardState::done, task.page_file().string()));
}

void StudyView::interrupt(const studies::Task& task) {
  const std::lock_guard lock(mutex_);
  broadcast(board_.set_state(index_of(task), view::BoardState::interrupted));
}

/// Under the mutex, so that who joins gets either the message or a description that has it.
void StudyView::broadcast(const std::string& message) {
  if (!message.empty()) server_.broadcast(message);
}

void StudyView::tell_changes() {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (now >= next_progress_) {
    next_progress_ = now + between_progress;
    for (std::size_t study = 0; study < shown_.size(); ++study)
      if (std::exchange(shown_[study].progress_is_old, false))
        broadcast(board_.set_progress(study, board_.studies()[study].progress));
  }
  // Nobody waits for figures that nobody sees.
  if (now < next_figures_ || server_.clients() == 0) return;
  for (std::size_t study = 0; study < shown_.size(); ++study)
    if (shown_[study].figures_are_old) show_figures(study);
  next_figures_ = Clock::now() +
                  std::max<Clock::duration>(between_figures, figures_pause * (Clock::now() - now));
}

void StudyView::answer(const view::Server::Event& event, const InterruptGuard& guard) {
  using Kind = view::Server::Event::Kind;
  if (event.kind == Kind::joined) {
    const std::lock_guard lock(mutex_);
    server_.send(event.client, board_.description());
  }
  if (event.kind != Kind::said) return;
  const view::BoardRequest request = view::parse_board_request(event.text, board_);
  if (!request.command) {
    server_.send(event.client, view::refused_answer(request.id, request.problem));
  } else if (const auto* row = std::get_if<view::OpenRow>(&*request.command)) {
    open(*row, event.client, *request.id);
  } else {
    server_.send(event.client, view::done_answer(*request.id));
    quit_ = true;
    guard.interrupt();
  }
}

void StudyView::open(const view::OpenRow& row, view::Server::ClientId client, std::int64_t id) {
  std::erase_if(windows_, [](Window& window) { return !window.program->running(); });
  const auto known = std::ranges::find(windows_, row, &Window::of);
  if (known != windows_.end()) {
    known->waiting.emplace_back(client, id);
    return;
  }
  const studies::StudyPlan& plan = *shown_[row.study].task->rows_plan();
  const studies::RowPlan& planned = plan.rows[row.row];
  if (!planned.refusal.empty()) {
    server_.send(client, view::refused_answer(id, "refused: " + planned.refusal));
    return;
  }
  // A folder of its own: two rows of one scene would write over each other's changes.
  const std::filesystem::path folder =
      shown_[row.study].task->folder() / fmt::format("windows/{:05}", row.row);
  const studies::SceneFile scene = studies::scene_file_of(plan, planned, folder);
  std::vector<std::string> words{"view",  scene.file.string(), "--no-open", "--bind", address_,
                                 "--out", folder.string()};
  for (const std::string& setting : scene.settings) {
    words.emplace_back("--set");
    words.push_back(setting);
  }
  for (const char* option : arguments_.consent.options()) words.emplace_back(option);
  if (windows_.size() >= most_windows) windows_.erase(windows_.begin());
  // This very program, wherever it lies.
  windows_.push_back(
      {row, std::make_unique<output::ChildProgram>("/proc/self/exe", words), "", {{client, id}}});
}

void StudyView::tell_windows() {
  for (Window& window : windows_) {
    if (window.url.empty()) window.url = window.program->take_line().value_or("");
    const bool over = window.url.empty() && !window.program->running();
    if (window.url.empty() && !over) continue;
    for (const auto& [client, id] : std::exchange(window.waiting, {}))
      server_.send(client,
                   over ? view::refused_answer(id, without_line_ends(window.program->errors()))
                        : view::opened_answer(id, window.url));
  }
}

int StudyView::serve(const std::function<int()>& work, const InterruptGuard& guard) {
  int status = 0;
  std::exception_ptr failure;
  std::atomic<bool> done{false};
  std::jthread worker([&] {
    try {
      status = work();
    } catch (...) {
      failure = std::current_exception();
    }
    done = true;
    server_.wake();
  });
  while (!done || (!failure && !quit_ && !guard.stop())) {
    for (const view::Server::Event& event : server_.take_events()) answer(event, guard);
    tell_changes();
    tell_windows();
    server_.wait(Clock::now() + between_looks);
  }
  worker.join();
  if (failure) std::rethrow_exception(failure);
  return status;
}

}  // namespace hookpoint::cli
