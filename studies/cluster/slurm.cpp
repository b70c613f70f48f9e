#include "studies/cluster/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "output/files/child.h"
#include "output/files/file.h"
#include "studies/cluster/run_list.h"

namespace hookpoint::studies {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr const char* no_slurm =
    "no Slurm on this machine: --slurm submits with sbatch (Debian's package slurm-client)";
constexpr const char* job_file = "job";
constexpr const char* script_file = "job.sh";
constexpr int most_submissions = 2;
/// A shared file system shows what a task wrote some seconds after the queue has forgotten the
/// task.
constexpr int patience = 4;
constexpr milliseconds shortest_wait{200}, longest_wait{5000};

/// Time for an answer of Slurm's programs [s]; they themselves wait for a busy controller.
constexpr double most_patience = 120., most_patience_for_version = 10.;

output::ChildResult ask_slurm(const std::string& program, const std::vector<std::string>& words,
                              const fs::path& folder, const std::atomic<bool>* stop,
                              double most_seconds = most_patience) {
  auto result =
      output::run_program(program, words, folder, {.most_seconds = most_seconds, .stop = stop});
  if (!result) throw NoSlurm(no_slurm);
  return std::move(*result);
}

std::string no_answer(const char* program, double seconds) {
  return fmt::format("{} has not answered within {} s: see whether Slurm's `sinfo` answers",
                     program, seconds);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// What Slurm calls the job that it took: the last line, up to a ';' before the cluster's name.
std::optional<std::string> job_number(const std::string& answer) {
  const std::vector<std::string> lines = lines_of(answer);
  if (lines.empty()) return std::nullopt;
  const std::string number = lines.back().substr(0, lines.back().find(';'));
  return whole_number(number) ? std::optional(number) : std::nullopt;
}

/// The last thing that a task said.
std::string last_words(const fs::path& log) {
  const std::vector<std::string> lines = lines_of(output::read_file(log).value_or(""));
  return lines.empty() ? "it left no word in " + log.string()
                       : lines.back() + " (" + log.string() + ")";
}

}  // namespace

void need_slurm() {
  const auto answer =
      ask_slurm("sbatch", {"--version"}, fs::current_path(), nullptr, most_patience_for_version);
  if (answer.stopped) throw NoSlurm(no_answer("sbatch --version", most_patience_for_version));
}

SlurmRuns::SlurmRuns(Options options) : options_(std::move(options)) {}
SlurmRuns::~SlurmRuns() = default;

bool SlurmRuns::run(std::size_t count, const Request& request, const Done& done,
                    const std::atomic<bool>& stop) {
  stop_ = &stop;
  for (std::size_t i = 0; i < count; ++i) wanted_[request(i).identity].push_back(i);
  if (options_.resume)
    take_up_earlier(done);
  else
    give_up_earlier();
  make_job(request);
  for (milliseconds wait = shortest_wait; !wanted_.empty();) {
    if (stop) {
      std::string numbers;
      for (const Job& job : jobs_) numbers += " " + job.numbers.back();
      if (!numbers.empty())
        options_.tell("what is in Slurm's queue continues there: --resume waits for it, `scancel" +
                      numbers + "` ends it");
      return false;
    }
    const std::size_t before = wanted_.size();
    for (Job& job : jobs_) read_journals(job, done);
    if (wanted_.empty()) break;
    for (Job& job : jobs_) look_after(job);
    wait = wanted_.size() < before ? shortest_wait : std::min(longest_wait, wait * 5 / 4);
    // Not longer than a user waits for an answer to the interrupt key.
    const auto end = std::chrono::steady_clock::now() + wait;
    while (!stop && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::min(wait, shortest_wait));
  }
  for (const fs::path& folder : earlier_folders()) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  jobs_.clear();
  return true;
}

std::vector<fs::path> SlurmRuns::earlier_folders() const {
  std::vector<fs::path> folders;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(options_.folder, none))
    if (fs::exists(entry.path() / script_file)) folders.push_back(entry.path());
  std::ranges::sort(folders);
  return folders;
}

void SlurmRuns::give_up_earlier() {
  for (const fs::path& folder : earlier_folders()) {
    const std::vector<std::string> numbers =
        lines_of(output::read_file(folder / job_file).value_or(""));
    if (!numbers.empty()) ask_slurm("scancel", numbers, folder, stop_);
    std::error_code error;
    fs::remove_all(folder, error);
    if (error) throw output::FileError("cannot remove " + folder.string() + ": " + error.message());
  }
}

void SlurmRuns::take_up_earlier(const Done& done) {
  for (const fs::path& folder : earlier_folders()) {
    Job job{folder, lines_of(output::read_file(folder / job_file).value_or("")), {}};
    for (std::size_t task = 0; fs::exists(list_of(folder, task)); ++task)
      job.tasks.push_back({JournalReader(journal_of(folder, task)), {}, 0, 0});
    read_journals(job, done);
    if (job.numbers.empty()) {
      // The front end ended between the submission and its number.
      const auto named = ask_slurm(
          "squeue",
          {"--noheader", "--name=" + job_name(options_.place.name, folder), "--format=%A"}, folder,
          stop_);
      if (named.status == 0) job.numbers = lines_of(named.output);
    }
    const auto queued = job.numbers.empty() ? std::nullopt : queued_tasks(job);
    if (!queued || queued->empty()) continue;
    for (const std::size_t task : *queued) {
      if (task >= job.tasks.size()) continue;
      job.tasks[task].submitted = 1;
      for (const RunRequest& run : read_run_list(list_of(folder, task)).runs)
        if (wanted_.contains(run.identity)) job.tasks[task].missing.insert(run.identity);
    }
    if (std::ranges::all_of(job.tasks, [](const Task& task) { return task.missing.empty(); })) {
      // What it would make is no longer asked for.
      ask_slurm("scancel", job.numbers, folder, stop_);
      continue;
    }
    options_.tell(
        fmt::format("job {} is still in Slurm's queue: waiting for it", job.numbers.back()));
    jobs_.push_back(std::move(job));
  }
}

void SlurmRuns::make_job(const Request& request) {
  std::set<std::string_view> coming;
  for (const Job& job : jobs_)
    for (const Task& task : job.tasks) coming.insert(task.missing.begin(), task.missing.end());
  std::vector<std::size_t> left;
  for (const auto& [identity, indices] : wanted_)
    if (!coming.contains(identity)) left.push_back(indices.front());
  if (left.empty()) return;
  std::ranges::sort(left);
  std::size_t number = 0;
  Job job;
  do {
    job.folder = options_.folder / task_number(number++);
  } while (fs::exists(job.folder));
  const std::size_t chunk = runs_of_a_task(left.size(), options_.settings);
  for (std::size_t begin = 0; begin < left.size(); begin += chunk) {
    const std::size_t task = job.tasks.size(), end = std::min(left.size(), begin + chunk);
    RunList list{options_.code, {}};
    std::set<std::string> missing;
    for (std::size_t i = begin; i < end; ++i) {
      list.runs.push_back(request(left[i]));
      missing.insert(list.runs.back().identity);
    }
    output::write_file(list_of(job.folder, task), run_list_text(list));
    // A shared file system may remember for a while that a file is not there.
    output::write_file(journal_of(job.folder, task), "");
    job.tasks.push_back({JournalReader(journal_of(job.folder, task)), std::move(missing), 1, 0});
  }
  SlurmPlace place = options_.place;
  place.name = job_name(place.name, job.folder);
  output::write_file(job.folder / script_file,
                     slurm_script(options_.settings, place, job.folder, job.tasks.size()));
  if (!submit(job, "")) return;
  options_.tell(fmt::format("job {}: {} runs in {} tasks", job.numbers.back(), left.size(),
                            job.tasks.size()));
  jobs_.push_back(std::move(job));
}

bool SlurmRuns::submit(Job& job, const std::string& array) {
  std::vector<std::string> words{"--parsable"};
  if (!array.empty()) words.push_back("--array=" + array);
  words.emplace_back(script_file);
  const output::ChildResult answer = ask_slurm("sbatch", words, job.folder, stop_);
  if (answer.stopped && *stop_) return false;
  if (answer.stopped)
    throw NoSlurm(no_answer("sbatch", most_patience) +
                  "; if it has taken the job after all, --resume finds it");
  const auto number = job_number(answer.output);
  if (answer.status != 0 || !number) {
    std::string why = answer.output;
    std::ranges::replace(why, '\n', ' ');
    if (why.find("Unable to contact") != std::string::npos)
      throw NoSlurm("Slurm's controller does not answer: " + why);
    throw SlurmRefusal("Slurm does not take the job (" + (job.folder / script_file).string() +
                       "): " + why);
  }
  job.numbers.push_back(*number);
  std::string text;
  for (const std::string& known : job.numbers) text += known + "\n";
  output::write_file(job.folder / job_file, text);
  return true;
}

void SlurmRuns::hand_on(const std::pair<std::string, RunRecord>& entry, const Done& done) {
  const auto place = wanted_.find(entry.first);
  if (place == wanted_.end()) return;
  const std::vector<std::size_t> indices = std::move(place->second);
  wanted_.erase(place);
  for (const std::size_t index : indices) done(index, entry.second);
}

void SlurmRuns::read_journals(Job& job, const Done& done) {
  for (Task& task : job.tasks) {
    while (auto entry = task.journal.next()) {
      task.missing.erase(entry->first);
      hand_on(*entry, done);
    }
  }
}

std::optional<std::set<std::size_t>> SlurmRuns::queued_tasks(const Job& job) {
  std::string numbers;
  for (const std::string& number : job.numbers) numbers += (numbers.empty() ? "" : ",") + number;
  // %K: the task's place in its array; --array: those that wait one by one too.
  const output::ChildResult answer = ask_slurm(
      "squeue", {"--noheader", "--array", "--jobs=" + numbers, "--format=%K"}, job.folder, stop_);
  std::set<std::size_t> queued;
  if (answer.status != 0) {
    // A job that ended some minutes ago.
    if (answer.output.find("Invalid job id") != std::string::npos) return queued;
    if (!std::exchange(controller_silent_, true))
      options_.tell("Slurm's controller does not answer; waiting for it");
    return std::nullopt;
  }
  controller_silent_ = false;
  for (const std::string& line : lines_of(answer.output))
    if (const auto task = whole_number(line)) queued.insert(*task);
  return queued;
}

void SlurmRuns::look_after(Job& job) {
  if (std::ranges::all_of(job.tasks, [](const Task& task) { return task.missing.empty(); })) return;
  const auto queued = queued_tasks(job);
  if (!queued) return;
  std::string again;
  for (std::size_t i = 0; i < job.tasks.size(); ++i) {
    Task& task = job.tasks[i];
    task.unseen = queued->contains(i) || task.missing.empty() ? 0 : task.unseen + 1;
    if (task.unseen < patience) continue;
    if (task.submitted >= most_submissions)
      throw SlurmError(fmt::format("task {} of Slurm's job {} failed twice: {}", i,
                                   job.numbers.back(), last_words(log_of(job.folder, i))));
    ++task.submitted;
    task.unseen = 0;
    again += (again.empty() ? "" : ",") + std::to_string(i);
  }
  if (again.empty()) return;
  if (!submit(job, again)) return;
  options_.tell("tasks " + again + " ended without all their runs: submitted once more as job " +
                job.numbers.back());
}

}  // namespace hookpoint::studies
