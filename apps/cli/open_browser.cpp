#include "apps/cli/open_browser.h"

#include <cstdlib>
#include <thread>

#include "output/files/child.h"

namespace hookpoint::cli {

void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  // It may last as long as the browser does.
  std::thread([url] { output::run_program("xdg-open", {url}, "/"); }).detach();
}

}  // namespace hookpoint::cli
