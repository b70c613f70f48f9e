#include "output/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

namespace hookpoint::output {
namespace {

using Clock = std::chrono::steady_clock;

std::string two_digits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<int>(std::min(std::ceil(seconds), 3.6e8));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + two_digits(whole % 3600 / 60) + " min";
}

std::string progress_line(const std::string& label, std::size_t done, std::size_t total,
                          double elapsed, std::size_t resumed) {
  constexpr std::size_t width = 30;
  const std::size_t filled = width * done / total;
  const std::string percent = std::to_string(100 * done / total);
  std::string line = label + "  [" + std::string(filled, '#') + std::string(width - filled, '-') +
                     "] " + std::string(3 - std::min<std::size_t>(3, percent.size()), ' ') +
                     percent + " %  " + std::to_string(done) + "/" + std::to_string(total);
  if (done == total) return line + "  in " + duration_text(elapsed);
  if (done == resumed) return line;
  const double left =
      elapsed * static_cast<double>(total - done) / static_cast<double>(done - resumed);
  return line + "  " + duration_text(left) + " left";
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
                         .terminal = isatty(fileno(stream)) == 1,
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
