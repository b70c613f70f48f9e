// A browser without a display, which draws the pages of this program: pictures and films.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "cli/child_program.h"

namespace hookpoint::cli {

/// No browser is there, or it cannot be started; says what to install.
struct BrowserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The Chromium of this machine: $HOOKPOINT_BROWSER, or the first of its names that PATH has.
std::optional<std::filesystem::path> find_browser();

class HeadlessBrowser {
 public:
  /// Opens `url` in a window of so many pixels. It knows nothing of its user, and leaves nothing
  /// behind. It ends with the calling thread. Throws BrowserError.
  HeadlessBrowser(const std::string& url, int width, int height);
  ~HeadlessBrowser();
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// Whether it is still at work: one that has crashed is not.
  bool running() { return program_->running(); }
  /// What it has to say.
  const std::string& errors() { return program_->errors(); }

 private:
  std::filesystem::path profile_;  ///< a folder of its own
  std::unique_ptr<ChildProgram> program_;
};

}  // namespace hookpoint::cli
