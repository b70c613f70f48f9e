#include "apps/cli/run_watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <utility>

#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "output/files/progress.h"
#include "text/terminal.h"

namespace hookpoint::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds bar_after{2000}, bar_every{200}, patience{1000};

}  // namespace

RunWatch::RunWatch(std::string label, RunSpan span, std::function<void()> close)
    : label_(std::move(label)),
      span_(span),
      close_(std::move(close)),
      terminal_(text::is_able_terminal(STDERR_FILENO)),
      time_(span.first),
      thread_([this] { watch(); }) {}

RunWatch::~RunWatch() {
  done_ = true;
  guard_.wake();
  thread_.join();
  if (!drawn_) return;
  draw();
  std::fputs("\n", stderr);
}

void RunWatch::say(const std::string& line) {
  const std::lock_guard lock(line_);
  if (drawn_) std::fputs("\r\033[K", stderr);
  std::fprintf(stderr, "%s\n", line.c_str());
}

void RunWatch::watch() {
  while (!done_ && !stopped()) {
    if (terminal_) {
      guard_.wait_for(bar_every);
      if (Clock::now() - start_ >= bar_after) draw();
    } else {
      guard_.wait();
    }
  }
  // A step in good health ends well within this; the run then ends by itself.
  const auto until = Clock::now() + patience;
  while (!done_ && Clock::now() < until) guard_.wait_for(bar_every);
  while (!done_) {
    auto expected = Phase::stepping;
    if (phase_.compare_exchange_strong(expected, Phase::taken, std::memory_order_acquire))
      end_within_step();
    guard_.wait_for(bar_every);
  }
}

void RunWatch::draw() {
  const std::lock_guard lock(line_);
  const double time = time_.load(std::memory_order_relaxed);
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  std::fprintf(
      stderr, "\r%s\033[K",
      output::time_progress_line(label_, time, span_.first, span_.last, elapsed.count()).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void RunWatch::end_within_step() {
  int end = status();
  try {
    close_();
    if (drawn_) std::fputs("\n", stderr);
    application::print_error(
        fmt::format("interrupted at {:.6g} s, within a step that does not end; what was recorded "
                    "up to then is kept",
                    time_.load(std::memory_order_relaxed)));
  } catch (const std::exception& error) {
    application::print_error(error.what());
    end = missing;
  }
  // The step still runs: nothing that it uses may be taken down.
  std::_Exit(end);
}

void RunWatch::wait_for_end() {
  while (true) pause();
}

}  // namespace hookpoint::cli
