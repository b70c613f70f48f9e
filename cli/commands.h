// The commands, one file each: plain arguments in, exit status out. main.cpp fills the arguments
// from the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hookpoint::cli {

struct RunArguments {
  std::filesystem::path file;
  std::vector<std::string> settings;    ///< trail=value
  std::optional<std::string> duration;  ///< "10 s"
  std::optional<std::filesystem::path> out;
  std::vector<std::string> record;  ///< trails
};
int run(const RunArguments& arguments);

struct StudyArguments {
  std::filesystem::path file;
  std::optional<std::filesystem::path> out;
  int jobs = 0;  ///< 0: one a core
  bool quick = false;
  bool resume = false;
  std::vector<std::string> only;  ///< subjects
};
int study(const StudyArguments& arguments);

/// check: every file's diagnostics.
int check(const std::vector<std::filesystem::path>& files);
/// fmt: rewrites each file in canonical layout; with `check_only` says which would change.
int format(const std::vector<std::filesystem::path>& files, bool check_only);
/// print: the experiment after includes, loops and expressions.
int print(const std::filesystem::path& file, const std::vector<std::string>& settings);
/// describe: one class, or the list of all; `markdown` writes the manual's reference page.
int describe(const std::optional<std::string>& type, bool markdown);

/// dynamics: what the forces do at the file's initial state.
int dynamics(const std::filesystem::path& file, const std::vector<std::string>& settings,
             bool json);

/// engines: every engine, law and integrator.
int engines(bool json);

/// What FILE.hook without a command means: true when it holds a Study, false for a world; none when
/// it has errors, which are printed.
std::optional<bool> holds_study(const std::filesystem::path& file);

}  // namespace hookpoint::cli
