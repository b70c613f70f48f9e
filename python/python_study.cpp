#include "python/python_study.h"

#include <pybind11/numpy.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <future>
#include <memory>
#include <utility>

#include "application/study_plans.h"
#include "application/study_reports.h"
#include "python/errors.h"
#include "python/python_world.h"
#include "studies/run/results_csv.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// A folder that is gone with everything in it when this is.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hookpoint-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw_error("there is no room for temporary files");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The number that a cell holds: NaN when it is empty, nothing when it is a word.
std::optional<double> number_of(const std::string& cell) {
  if (cell.empty()) return std::nan("");
  double value = 0.;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value)
                                                                  : std::nullopt;
}

/// Columns of words, should one be empty throughout or hold names that read as numbers.
bool holds_words(const std::string& title) {
  constexpr std::array words{"subject", "engine",  "law",    "integrator", "settings",
                             "study",   "regime",  "metric", "scene",      "truth",
                             "unit",    "allowed", "ok",     "status"};
  return title.ends_with("_ok") || std::ranges::find(words, title) != words.end();
}

/// A column of the table: numbers where all cells are, else words.
py::object column_of(const output::CsvTable& table, std::size_t column) {
  const auto rows = static_cast<py::ssize_t>(table.rows.size());
  py::array_t<double> numbers(rows);
  py::list words;
  bool all_numbers = !holds_words(table.header[column]);
  for (py::ssize_t row = 0; row < rows; ++row) {
    const std::string& cell = table.rows[static_cast<std::size_t>(row)][column];
    const std::optional<double> number = number_of(cell);
    if (number) numbers.mutable_at(row) = *number;
    all_numbers = all_numbers && number.has_value();
    words.append(cell);
  }
  if (all_numbers) return numbers;
  return py::array(words);
}

py::dict columns_of(const output::CsvTable& table) {
  py::dict columns;
  for (std::size_t i = 0; i < table.header.size(); ++i)
    columns[py::str(table.header[i])] = column_of(table, i);
  return columns;
}

py::list list_of(const std::vector<std::string>& words) {
  py::list list;
  for (const std::string& word : words) list.append(word);
  return list;
}

py::dict result_of(const studies::StudyRun& run) {
  py::dict made;
  made["table"] = columns_of(studies::results_table(run.result, false));
  made["timing"] = columns_of(studies::results_table(run.result, true));
  py::list truths;
  for (const studies::TruthResult& truth : run.result.truths) {
    py::dict entry;
    entry["name"] = truth.name;
    entry["words"] = truth.words;
    entry["passed"] = truth.passed;
    entry["failed"] = truth.failed;
    truths.append(entry);
  }
  made["truths"] = truths;
  made["notices"] = list_of(run.notices);
  return made;
}

/// Does `work` in a thread of its own (it starts others), while this one looks for signals: one
/// sets the `stop` that `work` gets.
template <class Work>
auto run_beside(const Work& work) {
  std::atomic<bool> stop{false};
  std::optional<py::error_already_set> interrupt;
  const py::gil_scoped_release others_run;
  auto running = std::async(std::launch::async, [&] { return work(stop); });
  while (running.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    const py::gil_scoped_acquire ours;
    if (interrupt || PyErr_CheckSignals() == 0) continue;
    interrupt.emplace();
    stop = true;
  }
  auto result = running.get();
  if (interrupt) throw std::move(*interrupt);
  return result;
}

/// The blocks of one file, run one by one. Reports are drawn only for a folder that is kept.
class StudyRunner {
 public:
  StudyRunner(const application::StudyArguments& arguments, const application::StudyFile& file,
              const studies::EngineTable& engines)
      : arguments_(arguments),
        file_(file),
        engines_(engines),
        command_(application::rerun_command(arguments)),
        store_(application::shared_store(arguments, file)) {}

  py::dict study(const studies::StudyPlan& plan) {
    return result_of(run(plan, folder(plan.name), store_).run);
  }

  py::dict wall(const studies::WallPlan& plan) {
    const std::filesystem::path to = folder(plan.study.name);
    std::vector<std::string> told;
    studies::RunOptions options = options_into(to, told);
    options.store = store_;
    const auto run = run_beside([&](const std::atomic<bool>& stop) {
      return studies::run_wall(plan, engines_, options, stop);
    });
    for (const std::string& message : told) warn(message);
    if (kept()) application::write_wall(*run, plan, engines_, command_);
    const studies::WallResult& result = run->result;
    py::dict made;
    made["table"] = columns_of(studies::wall_results_table(result));
    made["passed"] = result.passed();
    made["failed"] = result.failed();
    made["notices"] = list_of(run->notices);
    made["warnings"] = list_of(result.warnings);
    return made;
  }

  py::dict matrix(const application::MatrixPlan& plan) {
    const std::filesystem::path to = folder(plan.name);
    application::MatrixRun whole = application::begin_matrix(plan, arguments_, to, store_);
    py::dict parts;
    for (const application::MatrixPart& part : plan.parts) {
      Finished finished = run(part.plan, to / part.plan.name, whole.store);
      parts[py::str(part.plan.name)] = result_of(finished.run);
      whole.result.studies.push_back(
          {std::move(finished.run.result), part.text, std::move(finished.report.figures)});
    }
    if (kept()) application::write_matrix(whole, plan, file_.text, engines_, command_);
    py::dict made;
    made["table"] = columns_of(studies::matrix_table(whole.result));
    made["studies"] = parts;
    return made;
  }

 private:
  struct Finished {
    studies::StudyRun run;
    studies::ReportOutcome report;
  };

  bool kept() const { return arguments_.out.has_value(); }
  std::filesystem::path folder(const std::string& name) const {
    return kept() ? file_.folder(arguments_.out, name, {}) : unkept_.path() / name;
  }

  /// What the run has to tell goes to `told`, since it runs in a thread that is not Python's.
  studies::RunOptions options_into(const std::filesystem::path& to,
                                   std::vector<std::string>& told) const {
    studies::RunOptions options = application::run_options(arguments_, to);
    options.tell = [&told](const std::string& message) { told.push_back(message); };
    return options;
  }

  Finished run(const studies::StudyPlan& plan, const std::filesystem::path& to,
               std::shared_ptr<studies::RunStore> store) {
    std::vector<std::string> told;
    studies::RunOptions options = options_into(to, told);
    options.store = std::move(store);
    Finished finished{run_beside([&](const std::atomic<bool>& stop) {
                        return studies::run_study(plan, engines_, options, stop);
                      }),
                      {}};
    for (const std::string& message : told) warn(message);
    if (!kept()) return finished;
    finished.report = application::write_study_report(finished.run, command_);
    for (const std::string& message : finished.report.messages) warn(message);
    return finished;
  }

  const application::StudyArguments& arguments_;
  const application::StudyFile& file_;
  const studies::EngineTable& engines_;
  std::string command_;
  std::shared_ptr<studies::RunStore> store_;
  TemporaryFolder unkept_;
};

}  // namespace

py::dict run_studies(const application::StudyArguments& arguments) {
  QuietApplication application(arguments.allow_plugins);
  const auto file = application::plan_study_file(*application, arguments);
  if (!file) application.fail();
  if (file->size() == 0) throw_error(application::nothing_to_study(arguments.file));
  application.pass_on_warnings();
  StudyRunner runner(arguments, *file, application->engines());
  py::dict results;
  for (const studies::StudyPlan& plan : file->studies)
    results[py::str(plan.name)] = runner.study(plan);
  for (const studies::WallPlan& plan : file->walls)
    results[py::str(plan.study.name)] = runner.wall(plan);
  for (const application::MatrixPlan& plan : file->matrices)
    results[py::str(plan.name)] = runner.matrix(plan);
  return results;
}

}  // namespace hookpoint::python
