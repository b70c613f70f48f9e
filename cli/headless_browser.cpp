#include "cli/headless_browser.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include "output/file.h"

namespace hookpoint::cli {
namespace {

using namespace std::chrono_literals;

bool can_be_run(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

std::filesystem::path fresh_profile() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / "hookpoint-browser-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
    throw output::FileError("cannot create a folder in " +
                            std::filesystem::temp_directory_path().string());
  return pattern;
}

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

/// In the child. A group of its own: the interrupt key is for this program, which then ends it.
[[noreturn]] void become(const std::filesystem::path& program, std::vector<char*>& words,
                         int written, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(written, STDOUT_FILENO);
  ::dup2(written, STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) ::signal(signal, SIG_DFL);
  ::execv(program.c_str(), words.data());
  ::_exit(127);
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t most = 2000;
  return text.size() <= most ? text : text.substr(text.size() - most);
}

}  // namespace

std::filesystem::path find_headless_browser() {
  if (const char* chosen = std::getenv("HOOKPOINT_BROWSER"); chosen != nullptr && *chosen != '\0') {
    if (can_be_run(chosen)) return std::filesystem::absolute(chosen);
    throw BrowserMissing(std::string("HOOKPOINT_BROWSER names `") + chosen +
                         "`, which is no program that can be run");
  }
  const char* path = std::getenv("PATH");
  const std::string places = path == nullptr ? "/usr/local/bin:/usr/bin:/bin" : path;
  for (const char* name :
       {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"}) {
    std::istringstream folders(places);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::filesystem::path candidate = std::filesystem::path(folder) / name;
      if (candidate.is_absolute() && can_be_run(candidate)) return candidate;
    }
  }
  throw BrowserMissing(
      "this needs a Chromium to draw with, and PATH has none: install the package chromium "
      "(Debian: "
      "apt-get install chromium), or name one in HOOKPOINT_BROWSER");
}

HeadlessBrowser::HeadlessBrowser(const std::string& url, int width, int height) {
  const std::filesystem::path program = find_headless_browser();
  folder_ = fresh_profile();
  const int written = ::open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  std::vector<std::string> words =
      arguments_for(folder_, write_opener(folder_, url), width, height);
  words.insert(words.begin(), program.string());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(program, pointers, written, parent);
  const int problem = errno;
  ::close(written);
  if (process_ > 0) return;
  process_ = 0;
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
  throw BrowserMissing("cannot start " + program.string() + ": " +
                       std::system_category().message(problem));
}

HeadlessBrowser::~HeadlessBrowser() {
  if (process_ != 0) {
    ::kill(-process_, SIGTERM);
    wait_for_end();
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

/// A browser that does not listen is killed.
void HeadlessBrowser::wait_for_end() {
  const auto until = std::chrono::steady_clock::now() + 3s;
  while (::waitpid(process_, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > until) ::kill(-process_, SIGKILL);
    std::this_thread::sleep_for(10ms);
  }
  ::kill(-process_, SIGKILL);  // what is left of its group
  process_ = 0;
}

std::optional<std::string> HeadlessBrowser::ended() {
  if (process_ != 0 && ::waitpid(process_, nullptr, WNOHANG) != process_) return std::nullopt;
  process_ = 0;
  return last_lines(output::read_file(folder_ / "log").value_or(""));
}

}  // namespace hookpoint::cli
