#include "apps/cli/scene_picture.h"

#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "apps/cli/headless_browser.h"
#include "output/files/child_program.h"
#include "output/files/temporary_folder.h"

namespace hookpoint::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr seconds drawing_time{60};
constexpr milliseconds between_pictures{20};
constexpr int width = 960, height = 600;
constexpr const char* name = "scene.png";

/// The address of the viewer's page; none where it ended, or it is late.
std::optional<std::string> wait_for_address(output::ChildProgram& viewer, Clock::time_point until,
                                            const std::atomic<bool>& stop) {
  while (Clock::now() < until && !stop) {
    const bool running = viewer.running();
    if (auto line = viewer.take_line()) return line;
    if (!running) return std::nullopt;
    std::this_thread::sleep_for(between_pictures);
  }
  return std::nullopt;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Draws it into `folder`.
std::string draw_into(const fs::path& folder, const PictureRequest& request,
                      const std::atomic<bool>& stop) {
  find_headless_browser();  // nothing is begun where there is none
  const auto until = Clock::now() + drawing_time;
  std::vector<std::string> words{"view", request.scene.string(), "--no-open", "--out",
                                 (folder / "run").string()};
  for (const std::string& setting : request.settings) {
    words.emplace_back("--set");
    words.push_back(setting);
  }
  for (const char* option : request.consent.options()) words.emplace_back(option);
  output::ChildProgram viewer("/proc/self/exe", words);
  const auto address = wait_for_address(viewer, until, stop);
  if (!address) return "its window does not open: " + first_line(viewer.errors());
  HeadlessBrowser browser(*address + "&film&picture=" + name, width, height);
  const fs::path drawn = folder / "run" / name;
  while (!fs::exists(drawn)) {
    if (stop) return "interrupted";
    if (auto said = browser.ended()) return "the browser ended: " + first_line(*said);
    if (!viewer.running()) return "its window has closed: " + first_line(viewer.errors());
    if (Clock::now() > until)
      return "the browser has drawn nothing in " + std::to_string(drawing_time.count()) + " s";
    std::this_thread::sleep_for(between_pictures);
  }
  fs::create_directories(request.file.parent_path());
  fs::copy_file(drawn, request.file, fs::copy_options::overwrite_existing);
  return "";
}

}  // namespace

std::string draw_scene_picture(const PictureRequest& request, const std::atomic<bool>& stop) {
  try {
    return draw_into(output::TemporaryFolder("picture").path(), request, stop);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace hookpoint::cli
