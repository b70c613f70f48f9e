#include "output/files/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "text/number.h"
#include "text/terminal.h"

namespace hookpoint::output {
namespace {

using Clock = std::chrono::steady_clock;

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

/// "creep  [#######-------------]  35 %  ".
std::string bar(const std::string& label, double part) {
  constexpr double width = 30.;
  constexpr double slack = 1e-9;  // 29/100 of 100 is 29, text::rounded as it may be
  const auto filled = static_cast<std::size_t>(width * part + slack);
  const std::string percent = std::to_string(static_cast<int>(100. * part + slack));
  return label + "  [" + std::string(filled, '#') +
         std::string(static_cast<std::size_t>(width) - filled, '-') + "] " +
         std::string(3 - std::min<std::size_t>(3, percent.size()), ' ') + percent + " %  ";
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<int>(std::min(std::ceil(seconds), 3.6e8));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + two_digits(whole % 3600 / 60) + " min";
}

std::string progress_line(const std::string& label, std::size_t done, std::size_t total,
                          double elapsed, std::size_t resumed) {
  std::string line = bar(label, static_cast<double>(done) / static_cast<double>(total)) +
                     std::to_string(done) + "/" + std::to_string(total);
  if (done == total) return line + "  in " + duration_text(elapsed);
  if (done == resumed) return line;
  const double left =
      elapsed * static_cast<double>(total - done) / static_cast<double>(done - resumed);
  return line + "  " + duration_text(left) + " left";
}

std::string time_progress_line(const std::string& label, double time, double first, double last,
                               double elapsed) {
  const double part = last > first ? std::clamp((time - first) / (last - first), 0., 1.) : 1.;
  const std::string line =
      bar(label, part) + text::rounded(time, 4) + "/" + text::rounded(last, 4) + " s";
  if (part >= 1.) return line + "  in " + duration_text(elapsed);
  if (part <= 0.) return line;
  return line + "  " + duration_text(elapsed * (1. - part) / part) + " left";
}

struct Progress::Shared {
  std::string label;
  std::size_t total;
  std::size_t resumed;
  std::size_t done;
  std::FILE* stream;
  bool terminal;
  std::size_t tenths;
  Clock::time_point start = Clock::now();
  Clock::time_point drawn = {};
  std::mutex mutex = {};

  void print(const char* before, const char* after) const {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    const std::string line = progress_line(label, done, total, elapsed, resumed);
    std::fprintf(stream, "%s%s%s", before, line.c_str(), after);
    std::fflush(stream);
  }

  void show() {
    if (!terminal) {
      if (10 * done / total == tenths) return;
      tenths = 10 * done / total;
      print("", "\n");
      return;
    }
    const auto now = Clock::now();
    if (done < total && now - drawn < std::chrono::milliseconds(100)) return;
    drawn = now;
    print("\r", "\033[K");
  }
};

Progress::Progress(std::string label, std::size_t total, std::size_t resumed, std::FILE* stream)
    : shared_(new Shared{.label = std::move(label),
                         .total = std::max<std::size_t>(total, 1),
                         .resumed = resumed,
                         .done = resumed,
                         .stream = stream,
                         .terminal = text::is_able_terminal(fileno(stream)),
                         .tenths = 10 * resumed / std::max<std::size_t>(total, 1)}) {}

Progress::~Progress() {
  if (shared_->terminal) std::fputs("\n", shared_->stream);
}

void Progress::advance(std::size_t pieces) {
  const std::lock_guard lock(shared_->mutex);
  shared_->done = std::min(shared_->done + pieces, shared_->total);
  shared_->show();
}

void Progress::message(const std::string& text) {
  const std::lock_guard lock(shared_->mutex);
  std::fprintf(shared_->stream, shared_->terminal ? "\r\033[K%s\n" : "%s\n", text.c_str());
  if (shared_->terminal) shared_->print("\r", "\033[K");
}

}  // namespace hookpoint::output
