#include "python/python_study.h"

#include <memory>
#include <utility>

#include "application/study_plans.h"
#include "application/study_reports.h"
#include "python/errors.h"
#include "python/loaded_file.h"
#include "python/run_beside.h"
#include "python/tables.h"
#include "python/temporary_folder.h"
#include "studies/idleness.h"
#include "studies/pivot.h"
#include "studies/run/results_csv.h"
#include "studies/run/verdict.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

py::list list_of(const std::vector<std::string>& words) {
  py::list list;
  for (const std::string& word : words) list.append(word);
  return list;
}

py::dict result_of(const studies::StudyRun& run) {
  py::dict made;
  made["table"] = columns_of(studies::results_table(run.result, false));
  made["timing"] = columns_of(studies::results_table(run.result, true));
  py::dict grids;
  for (const studies::TableSpec& table : run.result.tables)
    grids[py::str(table.name)] = grid_of(studies::pivot_of(run.result, table));
  made["tables"] = grids;
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
  const std::vector<studies::IdleBlock> idle = studies::idle_blocks(run.result);
  py::list nothing;
  for (const studies::IdleBlock& block : idle) {
    py::dict entry;
    entry["kind"] = block.kind;
    entry["name"] = block.name;
    entry["why"] = block.idleness.why;
    entry["fault"] = block.idleness.idle == studies::Idle::fault;
    nothing.append(entry);
  }
  made["idle"] = nothing;
  made["holds"] = studies::all_truths_hold(run.result);
  made["notices"] = list_of(run.notices);
  return made;
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
