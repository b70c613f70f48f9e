#include "studies/cluster/slurm_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "output/files/hash.h"
#include "text/shell_word.h"

namespace hookpoint::studies {
namespace {

using text::quoted_shell_word;

constexpr std::string_view letters_and_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

bool consists_of(const std::string& text, std::string_view marks) {
  return std::ranges::all_of(text, [&](char c) {
    return letters_and_digits.find(c) != std::string_view::npos ||
           marks.find(c) != std::string_view::npos;
  });
}

/// Whether Slurm takes `text` as a time limit: whole numbers joined by colons, at most three, and
/// days before a dash.
bool is_time_limit(std::string_view text) {
  const auto is_number = [](std::string_view digits) {
    constexpr std::size_t most_digits = 8;
    return !digits.empty() && digits.size() <= most_digits &&
           digits.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (const std::size_t dash = text.find('-'); dash != std::string_view::npos) {
    if (!is_number(text.substr(0, dash))) return false;
    text.remove_prefix(dash + 1);
  }
  for (int parts = 1; parts <= 3; ++parts) {
    const std::size_t colon = text.find(':');
    if (!is_number(text.substr(0, colon))) return false;
    if (colon == std::string_view::npos) return true;
    text.remove_prefix(colon + 1);
  }
  return false;
}

std::string file_name(const char* kind, std::size_t task, const char* type) {
  return kind + ("_" + task_number(task)) + type;
}

}  // namespace

std::string option_words(const SlurmSettings& settings) {
  std::string words = " --slurm";
  const auto add = [&words](const char* option, const std::string& value) {
    if (!value.empty()) words += std::string(" ") + option + " " + text::shell_word(value);
  };
  const auto count = [](std::size_t number) {
    return number > 0 ? std::to_string(number) : std::string();
  };
  add("--partition", settings.partition);
  add("--account", settings.account);
  add("--time", settings.time);
  add("--chunk", count(settings.chunk));
  add("--array-limit", count(settings.array_limit));
  return words;
}

std::optional<std::string> problem_of(const SlurmSettings& settings) {
  const std::pair<const char*, const std::string*> names[] = {{"--partition", &settings.partition},
                                                              {"--account", &settings.account}};
  for (const auto& [option, name] : names)
    if (!consists_of(*name, "_-.,@+"))
      return fmt::format("{} takes a name of Slurm's, not `{}`", option, *name);
  if (!settings.time.empty() && !is_time_limit(settings.time))
    return fmt::format(
        "--time takes minutes, minutes:seconds, hours:minutes:seconds, days-hours, "
        "days-hours:minutes or days-hours:minutes:seconds as Slurm does, not `{}`",
        settings.time);
  return std::nullopt;
}

std::size_t runs_of_a_task(std::size_t runs, const SlurmSettings& settings) {
  if (settings.chunk > 0) return settings.chunk;
  constexpr std::size_t most_tasks = 1000, usual = 100, machines = 8;
  const auto share = [&](std::size_t tasks) { return (runs + tasks - 1) / tasks; };
  return std::max({share(most_tasks), std::min(usual, share(machines)), std::size_t{1}});
}

std::string task_number(std::size_t task) { return fmt::format("{:05}", task); }

std::filesystem::path list_of(const std::filesystem::path& folder, std::size_t task) {
  return folder / file_name("list", task, ".json");
}
std::filesystem::path journal_of(const std::filesystem::path& folder, std::size_t task) {
  return folder / file_name("runs", task, ".journal");
}
std::filesystem::path log_of(const std::filesystem::path& folder, std::size_t task) {
  return folder / file_name("log", task, ".txt");
}

std::string job_name(const std::string& study, const std::filesystem::path& folder) {
  std::string name = "hookpoint-";
  for (const char c : study) name += consists_of(std::string(1, c), "_-.") ? c : '_';
  constexpr std::size_t digits = 12;
  return name + "-" + output::Hash().add(folder.string()).text().substr(0, digits);
}

std::string slurm_script(const SlurmSettings& settings, const SlurmPlace& place,
                         const std::filesystem::path& folder, std::size_t tasks) {
  std::string script = "#!/bin/bash\n";
  const auto option = [&script](const std::string& text) { script += "#SBATCH --" + text + "\n"; };
  option("job-name=" + place.name);
  option(fmt::format("array=0-{}{}", tasks - 1,
                     settings.array_limit > 0 ? fmt::format("%{}", settings.array_limit) : ""));
  option(fmt::format("cpus-per-task={}", settings.jobs));
  if (!settings.partition.empty()) option("partition=" + settings.partition);
  if (!settings.account.empty()) option("account=" + settings.account);
  if (!settings.time.empty()) option("time=" + settings.time);
  // Each task writes its own log, below: in the names that Slurm takes, % and \ mean something.
  option("output=/dev/null");
  script += "folder=" + quoted_shell_word(folder.string()) + "\n";
  script += "printf -v number '%05d' \"$SLURM_ARRAY_TASK_ID\"\n";
  script += "exec >>\"$folder/log_$number.txt\" 2>&1\n";
  if (!place.search_path.empty())
    script += "export HOOKPOINT_PATH=" + quoted_shell_word(place.search_path) + "\n";
  script += "cd " + quoted_shell_word(place.directory.string()) + " || exit 3\n";
  script +=
      "exec " + quoted_shell_word(place.program.string()) +
      " runs \"$folder/list_$number.json\" --journal \"$folder/runs_$number.journal\" --jobs " +
      std::to_string(settings.jobs) + "\n";
  return script;
}

}  // namespace hookpoint::studies
