// A Chromium without a display, which draws a page of the program's own server: films, pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "output/files/child_program.h"
#include "output/files/temporary_folder.h"

namespace hookpoint::cli {

/// No browser is installed, or it cannot be started; what to do is in the message.
struct BrowserMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// HOOKPOINT_BROWSER if that is set, else the first Chromium of PATH. Throws BrowserMissing.
std::filesystem::path find_headless_browser();

/// It shows one page while it lives. What it writes of its own is gone with it; should this program
/// be killed, it ends too.
class HeadlessBrowser {
 public:
  /// A window of `width` x `height` pixels, one to each pixel of CSS. `url` holds the server's
  /// token, so it is never in what others can see of the command: the page that leads to it is a
  /// file that only its owner may read. Throws BrowserMissing.
  HeadlessBrowser(const std::string& url, int width, int height);
  ~HeadlessBrowser();
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// Once it has ended by itself, which it should not: the last lines that it wrote to standard
  /// error. To be called now and then.
  std::optional<std::string> ended();

 private:
  output::TemporaryFolder folder_;                 ///< its profile
  std::unique_ptr<output::ChildProgram> program_;  ///< ends before its folder is removed
};

}  // namespace hookpoint::cli
