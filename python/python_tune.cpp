#include "python/python_tune.h"

#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "application/calibration_plans.h"
#include "application/study_plans.h"
#include "application/tune_plans.h"
#include "python/errors.h"
#include "python/loaded_file.h"
#include "python/run_beside.h"
#include "python/tables.h"
#include "python/temporary_folder.h"
#include "studies/calibrate/outputs.h"
#include "studies/tune/outputs.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// The blocks of one file, run one by one. Reports are drawn only for a folder that is kept.
class TuneRunner {
 public:
  TuneRunner(const application::StudyArguments& arguments, const studies::EngineTable& engines,
             bool several)
      : arguments_(arguments),
        engines_(engines),
        several_(several),
        command_(application::tune_command(arguments)) {}

  py::dict tune(const studies::TunePlan& plan) {
    const studies::SubjectInfo& subject = plan.runs.subjects.front().info;
    if (!subject.available) throw_error("engine " + subject.engine + " is not on this machine");
    Told told;
    const studies::TuneOptions options{options_into(plan.label, told), {}};
    const studies::TuneRun run = run_beside([&](const std::atomic<bool>& stop) {
      return studies::run_tuning(plan, engines_, options, stop);
    });
    if (kept()) warn_of(application::write_tuning(run, plan, command_));
    const studies::TuneResult& result = run.result;
    py::dict made;
    made["table"] = columns_of(studies::evaluations_table(plan, result));
    made["pareto"] = columns_of(studies::pareto_table(plan, result));
    made["sobol"] = columns_of(studies::indices_table(plan, result));
    made["recommended"] =
        py::module_::import("json").attr("loads")(studies::recommended_json(plan, result));
    made["material"] =
        result.recommended ? studies::material_text(plan, result, command_) : std::string();
    made["holds"] = result.holds(plan);
    made["notices"] = told;
    return made;
  }

  py::dict calibrate(const studies::CalibrationPlan& plan) {
    Told told;
    const studies::CalibrationOptions options{options_into(plan.runs.name, told), {}};
    const studies::CalibrationRun run = run_beside([&](const std::atomic<bool>& stop) {
      return studies::run_calibration(plan, engines_, options, stop);
    });
    if (kept()) warn_of(application::write_calibration(run, plan, command_));
    const studies::CalibrationResult& result = run.result;
    py::dict made;
    made["table"] = columns_of(studies::calibration_table(plan, result));
    made["correlations"] = columns_of(studies::correlations_table(plan, result));
    made["fits"] = columns_of(studies::fits_table(plan, result));
    made["folds"] = columns_of(studies::folds_table(plan, result));
    made["curves"] = columns_of(studies::curves_table(plan, result));
    py::dict materials;
    for (std::size_t i = 0; i < result.subjects.size(); ++i)
      materials[py::str(plan.subjects[i].info.name)] =
          studies::material_text(plan, plan.subjects[i], result.subjects[i], command_);
    made["materials"] = materials;
    for (std::string& misfit : studies::misfits(plan, result)) told.push_back(std::move(misfit));
    made["notices"] = told;
    return made;
  }

 private:
  using Told = std::vector<std::string>;

  bool kept() const { return arguments_.out.has_value(); }

  /// What the run has to tell goes to `told`, since it runs in a thread that is not Python's.
  studies::RunOptions options_into(const std::string& label, Told& told) const {
    std::filesystem::path to = unkept_.path() / label;
    if (kept()) to = several_ ? *arguments_.out / label : *arguments_.out;
    studies::RunOptions options = application::run_options(arguments_, to);
    options.tell = [&told](const std::string& message) { told.push_back(message); };
    return options;
  }

  static void warn_of(const std::vector<std::string>& undrawn) {
    for (const std::string& message : undrawn) warn(message);
  }

  const application::StudyArguments& arguments_;
  const studies::EngineTable& engines_;
  bool several_;
  std::string command_;
  TemporaryFolder unkept_;
};

}  // namespace

py::dict run_tunings(const application::StudyArguments& asked) {
  QuietApplication application(asked.allow_plugins);
  application::StudyArguments arguments = asked;
  arguments.file = application->find(asked.file);
  const auto root = application->evaluate_set(arguments.file, arguments.settings);
  if (!root) application.fail();
  if (!application::holds_tune(*root))
    throw_error(arguments.file.string() +
                " holds no Tune and no Calibrate; `hookpoint.study` runs studies");
  const auto plans = application::plan_tune_file(*application, *root, arguments);
  if (!plans) application.fail();
  const auto calibrations = application::plan_calibrate_file(*application, *root, arguments);
  if (!calibrations) application.fail();
  application.pass_on_warnings();
  TuneRunner runner(arguments, application->engines(), plans->size() + calibrations->size() > 1);
  py::dict results;
  for (const studies::TunePlan& plan : *plans) results[py::str(plan.label)] = runner.tune(plan);
  for (const studies::CalibrationPlan& plan : *calibrations)
    results[py::str(plan.runs.name)] = runner.calibrate(plan);
  return results;
}

}  // namespace hookpoint::python
