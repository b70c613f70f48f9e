// The progress of a study on standard error: a bar with the time left on a terminal, elsewhere a
// line every tenth.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace hookpoint::output {

/// "creep  [#######-------------]  35 %  420/1200  1 min 20 s left". `elapsed` [s] since the start,
/// in which `done - resumed` pieces were worked off; pure.
std::string progress_line(const std::string& label, std::size_t done, std::size_t total,
                          double elapsed, std::size_t resumed = 0);

/// "world  [#######-------------]  35 %  3.5/10 s  1 min 20 s left": a run's simulated time between
/// `first` and `last` [s], after `elapsed` [s]; pure.
std::string time_progress_line(const std::string& label, double time, double first, double last,
                               double elapsed);

/// "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

/// May be advanced from several threads at once.
class Progress {
 public:
  /// `total` > 0 pieces of work, of which `resumed` need not be done again. Animated when `stream`
  /// is a terminal.
  Progress(std::string label, std::size_t total, std::size_t resumed = 0,
           std::FILE* stream = stderr);
  /// Leaves the cursor on a fresh line.
  ~Progress();
  void advance(std::size_t pieces = 1);
  /// Prints `text` as a line of its own, above the bar.
  void message(const std::string& text);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace hookpoint::output
