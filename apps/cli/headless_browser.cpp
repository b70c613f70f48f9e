#include "apps/cli/headless_browser.h"

#include <cstdlib>
#include <system_error>
#include <vector>

#include "output/files/file.h"

namespace hookpoint::cli {
namespace {

/// A page that only leads to `url`. The folder that it lies in is its owner's alone.
std::filesystem::path write_opener(const std::filesystem::path& folder, const std::string& url) {
  std::string escaped;
  for (const char letter : url) letter == '&' ? escaped += "&amp;" : escaped += letter;
  const std::filesystem::path file = folder / "open.html";
  output::write_file(
      file, "<!doctype html><meta http-equiv=\"refresh\" content=\"0;url=" + escaped + "\">\n");
  return file;
}

/// WebGL is computed without a graphics card, so that every machine draws it and a picture is the
/// same each time. The sandbox needs rights that containers lack; nothing is shown but the
/// program's own page.
std::vector<std::string> arguments_for(const std::filesystem::path& folder,
                                       const std::filesystem::path& opener, int width, int height) {
  return {"--headless",
          "--no-sandbox",
          "--disable-gpu",
          "--disable-quic",
          "--no-first-run",
          "--no-default-browser-check",
          "--disable-background-networking",
          "--disable-component-update",
          "--disable-sync",
          "--disable-dev-shm-usage",
          "--disable-extensions",
          "--mute-audio",
          "--no-proxy-server",
          "--password-store=basic",
          "--use-gl=angle",
          "--use-angle=swiftshader",
          "--enable-unsafe-swiftshader",
          "--force-device-scale-factor=1",
          "--force-color-profile=srgb",
          "--hide-scrollbars",
          "--disable-background-timer-throttling",
          "--disable-renderer-backgrounding",
          "--window-size=" + std::to_string(width) + "," + std::to_string(height),
          "--user-data-dir=" + (folder / "profile").string(),
          "file://" + opener.string()};
}

constexpr std::size_t most_said = 2000;

}  // namespace

std::filesystem::path find_headless_browser() {
  if (const char* chosen = std::getenv("HOOKPOINT_BROWSER"); chosen != nullptr && *chosen != '\0') {
    const std::filesystem::path program = std::filesystem::absolute(chosen);
    if (!output::program_on_path(program).empty()) return program;
    throw BrowserMissing(std::string("HOOKPOINT_BROWSER names `") + chosen +
                         "`, which is no program that can be run");
  }
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"})
    if (std::filesystem::path program = output::program_on_path(name); !program.empty())
      return program;
  throw BrowserMissing(
      "this needs a Chromium to draw with, and PATH has none: install the package chromium "
      "(Debian: "
      "apt-get install chromium), or name one in HOOKPOINT_BROWSER");
}

HeadlessBrowser::HeadlessBrowser(const std::string& url, int width, int height)
    : folder_("browser") {
  const std::filesystem::path program = find_headless_browser();
  const std::filesystem::path& folder = folder_.path();
  try {
    program_ = std::make_unique<output::ChildProgram>(
        program, arguments_for(folder, write_opener(folder, url), width, height));
  } catch (const std::system_error& error) {
    throw BrowserMissing(error.what());
  }
}

HeadlessBrowser::~HeadlessBrowser() = default;

std::optional<std::string> HeadlessBrowser::ended() {
  const bool running = program_->running();
  // A pipe that is full would hold it up.
  while (program_->take_line()) {
  }
  const std::string& said = program_->errors();
  if (running) return std::nullopt;
  return said.size() <= most_said ? said : said.substr(said.size() - most_said);
}

}  // namespace hookpoint::cli
