#include "cli/headless_browser.h"

#include <stdlib.h>
#include <unistd.h>

#include <system_error>
#include <vector>

#include "output/child.h"

namespace hookpoint::cli {
namespace {

namespace fs = std::filesystem;

fs::path fresh_folder() {
  std::string pattern = (fs::temp_directory_path() / "hookpoint-browser-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
    throw BrowserError("a folder for the browser cannot be made in " +
                       fs::temp_directory_path().string());
  return pattern;
}

std::vector<std::string> arguments_of(const std::string& url, const fs::path& profile, int width,
                                      int height) {
  std::vector<std::string> arguments{
      "--headless",
      "--user-data-dir=" + profile.string(),
      "--window-size=" + std::to_string(width) + "," + std::to_string(height),
      "--force-device-scale-factor=1",
      "--hide-scrollbars",
      "--mute-audio",
      // Drawn by the processor: the same picture whatever the graphics card.
      "--disable-gpu",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      // A page that nobody sees is drawn as if somebody did.
      "--disable-background-timer-throttling",
      "--disable-backgrounding-occluded-windows",
      "--disable-renderer-backgrounding",
      // It asks nobody but this program.
      "--disable-quic",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-default-apps",
      "--disable-extensions",
      "--disable-sync",
      "--no-first-run",
      "--no-default-browser-check",
  };
  // Chromium refuses to run as root in its sandbox; the page is this program's own.
  if (geteuid() == 0) arguments.emplace_back("--no-sandbox");
  arguments.push_back(url);
  return arguments;
}

}  // namespace

std::optional<fs::path> find_browser() {
  const char* chosen = std::getenv("HOOKPOINT_BROWSER");
  if (chosen != nullptr && *chosen != '\0') {
    if (fs::path(chosen).is_absolute() && access(chosen, X_OK) == 0) return chosen;
    return output::find_program(chosen);
  }
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (auto found = output::find_program(name)) return found;
  return std::nullopt;
}

HeadlessBrowser::HeadlessBrowser(const std::string& url, int width, int height) {
  const auto browser = find_browser();
  if (!browser) throw BrowserError("chromium is not installed (Debian: apt-get install chromium)");
  profile_ = fresh_folder();
  try {
    program_ = std::make_unique<ChildProgram>(*browser, arguments_of(url, profile_, width, height));
  } catch (const std::system_error& error) {
    std::error_code ignored;
    fs::remove_all(profile_, ignored);
    throw BrowserError(error.what());
  }
}

HeadlessBrowser::~HeadlessBrowser() {
  program_.reset();
  std::error_code ignored;
  fs::remove_all(profile_, ignored);
}

}  // namespace hookpoint::cli
