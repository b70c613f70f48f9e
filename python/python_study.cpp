#include "python/python_study.h"

#include <pybind11/numpy.h>
#include <stdlib.h>

#include <charconv>
#include <cmath>
#include <future>
#include <thread>

#include "python/errors.h"
#include "python/python_world.h"
#include "studies/plan.h"
#include "studies/results_csv.h"
#include "studies/run.h"

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

/// A column of the table: numbers where all cells are, else words. A column that is empty
/// throughout is of numbers unless it is a verdict's.
py::object column_of(const output::CsvTable& table, std::size_t column) {
  const auto rows = static_cast<py::ssize_t>(table.rows.size());
  py::array_t<double> numbers(rows);
  py::list words;
  bool all_numbers = !table.header[column].ends_with("_ok") && table.header[column] != "status";
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

py::dict result_of(const studies::StudyResult& result) {
  py::dict made;
  made["table"] = columns_of(studies::results_table(result, false));
  made["timing"] = columns_of(studies::results_table(result, true));
  py::list truths;
  for (const studies::TruthResult& truth : result.truths) {
    py::dict entry;
    entry["name"] = truth.name;
    entry["words"] = truth.words;
    entry["passed"] = truth.passed;
    entry["failed"] = truth.failed;
    truths.append(entry);
  }
  made["truths"] = truths;
  return made;
}

/// Runs the plan in threads of its own, while this one looks for signals.
studies::StudyRun run_plan(const studies::StudyPlan& plan, const studies::EngineTable& engines,
                           const studies::RunOptions& options) {
  std::atomic<bool> stop{false};
  std::optional<py::error_already_set> interrupt;
  const py::gil_scoped_release others_run;
  auto running = std::async(std::launch::async,
                            [&] { return studies::run_study(plan, engines, options, stop); });
  while (running.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    const py::gil_scoped_acquire ours;
    if (interrupt || PyErr_CheckSignals() == 0) continue;
    interrupt.emplace();
    stop = true;
  }
  studies::StudyRun run = running.get();
  if (interrupt) throw std::move(*interrupt);
  return run;
}

}  // namespace

py::dict run_studies(const StudyRequest& request) {
  QuietApplication application(request.allow_plugins);
  const auto root = application->evaluate(request.file, {});
  if (!root) application.fail();
  const auto found = root->children_of("Study");
  if (found.empty()) throw_error(request.file.string() + " holds no Study");
  if (!application->load_scene_plugins(*root, request.file)) application.fail();
  std::vector<studies::StudyPlan> plans;
  for (const language::Object* study : found) {
    language::Diagnostics diagnostics;
    auto plan =
        studies::make_plan(*root, *study, request.file.string(), application->library(),
                           application->engines(), {request.quick, request.only}, diagnostics);
    if (!plan) throw_diagnostics(diagnostics);
    plans.push_back(std::move(*plan));
  }
  const TemporaryFolder unkept;
  py::dict results;
  for (const studies::StudyPlan& plan : plans) {
    studies::RunOptions options;
    options.jobs = request.jobs > 0
                       ? request.jobs
                       : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.resume = request.resume;
    const std::filesystem::path folder = request.out.value_or(unkept.path());
    options.folder = plans.size() > 1 || !request.out ? folder / plan.name : folder;
    const studies::StudyRun run = run_plan(plan, application->engines(), options);
    results[py::str(plan.name)] = result_of(run.result);
  }
  return results;
}

}  // namespace hookpoint::python
