// Runs experiments drawn at random (generated_experiment.h), each in a process of its own:
//   fuzz_generated [--kind experiments|studies] [--first SEED] [--count N]
//   fuzz_generated [--kind experiments|studies] --print SEED
//   fuzz_generated [--kind experiments|studies] [--first SEED] [--count N] --write FOLDER
//   fuzz_generated --replay FOLDER
// What was drawn depends on the schema: one more field, and every seed draws something else. `--write`
// keeps what is drawn today, each experiment in a folder of its own, and `--replay` runs what was kept.
// A finding is one that ends by a signal, needs more than its processor time, ends with a status
// that the manual does not know, says what only a programmer understands, or ends well with a
// number that is none, an empty file, or one that was not completed.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "output/files/file.h"
#include "reference/engines.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/generated_experiment.h"
#include "tests/fuzz/generated_study.h"
#include "tests/support/text.h"

namespace hookpoint::fuzz {
namespace {

// Ten times what the slowest in corpus/slow_experiments needs: 40 s as released, 400 s under the
// sanitizers.
constexpr rlim_t processor_seconds = 4000;
constexpr unsigned wall_seconds = 5000;  ///< for one that waits instead of computing

/// Whether a text has `nan` or `inf` as a word, as printed numbers are.
bool has_non_finite(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto letter = [&](std::size_t i) {
    return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
  };
  for (const std::string word : {"nan", "inf"}) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      if (!letter(at - 1) && !letter(at + word.size())) return true;
    }
  }
  return false;
}

/// What the commands do with the drawn file. Does not return.
[[noreturn]] void run_alone(const std::filesystem::path& folder, const GeneratedExperiment& drawn) {
  const rlimit limit{processor_seconds, processor_seconds};
  setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  alarm(wall_seconds);
  std::freopen((folder / "stdout").c_str(), "w", stdout);
  std::freopen((folder / "stderr").c_str(), "w", stderr);
  int status = cli::missing;
  try {
    const std::filesystem::path file = folder / "drawn.hook", out = folder / "out";
    if (drawn.command == GeneratedCommand::run) {
      cli::RunArguments arguments;
      arguments.file = file;
      arguments.out = out;
      arguments.record = drawn.trails;
      status = cli::run(arguments);
      const int of_dynamics = drawn.dynamics ? cli::dynamics(file, {}, true, {}) : cli::fine;
      if (status == cli::fine) status = of_dynamics;
    } else {
      application::TaskArguments arguments;
      arguments.file = file;
      arguments.out = out;
      arguments.jobs = 1;
      status = cli::run_tasks(drawn.command == GeneratedCommand::study ? application::study_command
                                                                       : application::tune_command,
                              arguments);
    }
  } catch (const output::FileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unforeseen: %s\n", error.what());
  }
  std::fflush(nullptr);
  _exit(status);
}

/// "" or what is wrong with what was written.
std::string finding_in(const std::filesystem::path& out, int code) {
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out, none)) {
    if (!entry.is_regular_file()) continue;
    const std::filesystem::path& file = entry.path();
    const std::string type = file.extension().string(), name = file.filename().string();
    const bool store = name.starts_with("runs.sqlite");
    if (entry.file_size() == 0 && !store) return "an empty file " + name;
    if (code == cli::fine && type == ".partial") return "a file that was not completed: " + name;
    // The ranges of a record's channels may be without an end (docs/data.md).
    const bool ranges = name.ends_with(".channels.csv");
    const bool numbers = !ranges && (type == ".csv" || type == ".json" || type == ".svg");
    if (code == cli::fine && numbers && has_non_finite(testing::read_file(file)))
      return "it ends well with a number that is none in " + name;
  }
  return "";
}

/// "" or what is wrong with how an experiment ended.
std::string finding(int status, const std::filesystem::path& folder) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    const bool late = signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL;
    return late ? "it does not end" : "signal " + std::to_string(signal);
  }
  const std::string told = testing::read_file(folder / "stderr");
  for (const char* alien : {"unforeseen:", "bad_alloc", "std::", "basic_string",
                            "vector::", "Sanitizer", "runtime error:"}) {
    if (told.find(alien) != std::string::npos) return std::string("it says ") + alien;
  }
  const int code = WEXITSTATUS(status);
  if (code > cli::missing) return "status " + std::to_string(code);
  if (code == cli::wrong_input && std::filesystem::exists(folder / "out"))
    return "wrong input, and yet something is written";
  if (code == cli::fine && has_non_finite(testing::read_file(folder / "stdout")))
    return "it ends well with a number that is none";
  if (code != cli::fine && told.empty()) return "it fails without a word";
  if (told.find("error: \n") != std::string::npos) return "an error without a word";
  return code == cli::fine || code == cli::truth_failed ? finding_in(folder / "out", code) : "";
}

struct Tally {
  std::map<int, std::size_t> ended;  ///< by exit status
  std::size_t findings = 0;
};

using Generate = GeneratedExperiment (*)(const language::Schema&, std::uint64_t);

void write_into(const std::filesystem::path& folder, const GeneratedExperiment& drawn) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "drawn.hook") << drawn.text;
  for (const GeneratedFile& file : drawn.files)
    std::ofstream(folder / file.name, std::ios::binary) << file.content;
}

constexpr const char* command_file = "command";
constexpr std::array command_names{"run", "study", "tune"};

/// What runs it stands in a file of its own: the command's name, `dynamics`, `record PORT`.
void keep(const std::filesystem::path& folder, const GeneratedExperiment& drawn) {
  write_into(folder, drawn);
  std::ofstream command(folder / command_file);
  command << command_names.at(static_cast<std::size_t>(drawn.command)) << '\n';
  if (drawn.dynamics) command << "dynamics\n";
  for (const std::string& trail : drawn.trails) command << "record " << trail << '\n';
}

GeneratedExperiment kept(const std::filesystem::path& folder) {
  GeneratedExperiment result;
  std::ifstream command(folder / command_file);
  for (std::string line; std::getline(command, line);) {
    const auto name = std::ranges::find(command_names, line);
    if (name != command_names.end())
      result.command = static_cast<GeneratedCommand>(name - command_names.begin());
    else if (line == "dynamics")
      result.dynamics = true;
    else
      result.trails.push_back(line.substr(line.find(' ') + 1));
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "drawn.hook")
      result.text = testing::read_file(entry.path());
    else if (name != command_file)
      result.files.push_back({name, testing::read_file(entry.path())});
  }
  return result;
}

/// `name`: of the experiment, for a finding.
void run_one(const GeneratedExperiment& drawn, const std::string& name, const Folder& home,
             Tally& tally) {
  const std::filesystem::path folder = home.path() / name;
  write_into(folder, drawn);
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) run_alone(folder, drawn);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) ++tally.ended[WEXITSTATUS(status)];
  const std::string wrong = finding(status, folder);
  if (!wrong.empty()) {
    ++tally.findings;
    std::printf("FAILED: %s: %s\n", name.c_str(), wrong.c_str());
    std::printf("%.1500s\n", testing::read_file(folder / "stderr").c_str());
    std::fflush(stdout);
  }
  std::filesystem::remove_all(folder);
}

/// As `hookpoint print` would have it, with the files beside it.
void print(const GeneratedExperiment& drawn) {
  std::printf("%s", drawn.text.c_str());
  for (const GeneratedFile& file : drawn.files) {
    std::printf("\n// file %s\n", file.name.c_str());
    std::fwrite(file.content.data(), 1, file.content.size(), stdout);
  }
}

std::uint64_t whole_number(const char* text) { return std::strtoull(text, nullptr, 10); }

}  // namespace
}  // namespace hookpoint::fuzz

int main(int count, char** words) {
  using namespace hookpoint;
  std::uint64_t first = 1, wanted = 100;
  language::Schema schema;
  simulation::add_experiment_classes(schema, reference::peer_choices());
  studies::add_study_classes(schema);
  fuzz::Generate generate = fuzz::generate_experiment;
  std::filesystem::path write, replay;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string option = words[i];
    if (option == "--kind") {
      if (words[i + 1] == std::string("studies")) generate = fuzz::generate_study;
    } else if (option == "--print") {
      fuzz::print(generate(schema, fuzz::whole_number(words[i + 1])));
      return 0;
    } else if (option == "--write") {
      write = words[i + 1];
    } else if (option == "--replay") {
      replay = words[i + 1];
    } else {
      (option == "--first" ? first : wanted) = fuzz::whole_number(words[i + 1]);
    }
  }
  const auto name_of = [&](std::uint64_t seed) {
    return (generate == fuzz::generate_study ? "study_" : "experiment_") + std::to_string(seed);
  };
  if (!write.empty()) {
    for (std::uint64_t seed = first; seed < first + wanted; ++seed)
      fuzz::keep(write / name_of(seed), generate(schema, seed));
    return 0;
  }
  const fuzz::Folder home;
  fuzz::Tally tally;
  if (!replay.empty()) {
    std::vector<std::filesystem::path> folders;
    for (const auto& entry : std::filesystem::directory_iterator(replay))
      folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (const auto& folder : folders)
      fuzz::run_one(fuzz::kept(folder), folder.filename().string(), home, tally);
    wanted = folders.size();
  } else {
    for (std::uint64_t seed = first; seed < first + wanted; ++seed)
      fuzz::run_one(generate(schema, seed), name_of(seed), home, tally);
  }
  std::printf(
      "%llu experiments: %zu ran, %zu stopped with a message, %zu refused, %zu lacked an engine, "
      "%zu findings\n",
      static_cast<unsigned long long>(wanted), tally.ended[0], tally.ended[1], tally.ended[2],
      tally.ended[3], tally.findings);
  // Files of which most are refused test the checker alone.
  const bool enough = wanted > 0 && 4 * (tally.ended[0] + tally.ended[1]) >= wanted;
  if (!enough) std::printf("FAILED: too few ran\n");
  return tally.findings == 0 && enough ? 0 : 1;
}
