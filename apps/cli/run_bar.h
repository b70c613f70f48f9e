// The progress bar of a Study or a Wall on the command line.
#pragma once

#include <optional>
#include <string>

#include "output/files/progress.h"
#include "studies/run/run.h"

namespace hookpoint::cli {

/// It appears with the first row that is done.
class RunBar {
 public:
  explicit RunBar(std::string name) : name_(std::move(name)) {}
  /// The same options, with the progress shown here; this outlives the run.
  studies::RunOptions watch(studies::RunOptions options);
  void end() { bar_.reset(); }
  /// A line of its own, above the bar.
  void message(const std::string& text);

 private:
  void show(const studies::Progress& progress);

  std::string name_;
  std::optional<output::Progress> bar_;
  std::size_t shown_ = 0;
};

}  // namespace hookpoint::cli
