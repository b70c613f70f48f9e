#include "apps/cli/run_bar.h"

#include <algorithm>

namespace hookpoint::cli {

studies::RunOptions RunBar::watch(studies::RunOptions options) {
  options.progress = [this](const studies::Progress& progress) { show(progress); };
  return options;
}

void RunBar::message(const std::string& text) {
  if (bar_) bar_->message(text);
}

void RunBar::show(const studies::Progress& progress) {
  if (!bar_) bar_.emplace(name_, progress.total, progress.resumed);
  shown_ = std::max(shown_, progress.resumed);
  if (progress.done > shown_) bar_->advance(progress.done - shown_);
  shown_ = std::max(shown_, progress.done);
}

}  // namespace hookpoint::cli
