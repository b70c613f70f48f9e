// Runs the program as a user would and keeps what it said.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint::testing {

struct CommandResult {
  int status = -1;
  std::string out, err;
};

/// A fresh empty folder for a test, removed with everything in it at the end.
class Workplace {
 public:
  Workplace() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hookpoint-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Workplace() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  /// Writes `text` to a file of the folder.
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string read(const std::filesystem::path& name) const { return read_file(folder_ / name); }
  /// Everything in the folder but what `file` wrote and the two streams.
  std::size_t entries() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename();
      if (name != ".out" && name != ".err") ++count;
    }
    return count;
  }
  /// `hookpoint ARGUMENTS` with this folder as the working directory.
  CommandResult hookpoint(const std::string& arguments) const {
    return run("'" + testing::build_folder() + "/hookpoint' " + arguments);
  }
  /// Any other command there.
  CommandResult run(const std::string& command) const {
    const int raw =
        std::system(("cd '" + folder_.string() + "' && " + command + " >.out 2>.err").c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), read(".out"), read(".err")};
  }

 private:
  std::filesystem::path folder_;
};

inline std::string config(const std::string& name) {
  return "'" + testing::source_folder() + "/configs/" + name + "'";
}

}  // namespace hookpoint::testing
