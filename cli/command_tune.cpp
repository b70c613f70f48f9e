#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "application/application.h"
#include "application/calibration_plans.h"
#include "application/study_plans.h"
#include "application/tune_plans.h"
#include "cli/cluster_runs.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/keeping_runs.h"
#include "cli/run_bar.h"
#include "language/names.h"
#include "studies/calibrate/report.h"
#include "studies/tune/report.h"

namespace hookpoint::cli {
namespace {

/// "generation 3 of 25, 18 runs/s, 7 in the Pareto set; best foot_slip 0.02, ..."
std::string generation_text(const studies::GenerationReport& report) {
  std::string text = fmt::format("generation {} of {}, {:.3g} runs/s", report.generation,
                                 report.generations, report.runs_per_second);
  if (report.best.empty()) return text + "; no candidate meets the requirements so far";
  return text + fmt::format(", {} in the Pareto set; best {}", report.pareto,
                            language::join(report.best, ", "));
}

/// Its folder: DIR, or DIR/LABEL where the file asks for several.
std::filesystem::path folder_for(const application::StudyArguments& arguments,
                                 const studies::TunePlan& plan, bool several) {
  if (!arguments.out) return plan.folder();
  return several ? *arguments.out / plan.label : *arguments.out;
}

void tell(const std::string& notice) { std::cerr << "hookpoint: note: " << notice << '\n'; }

/// --dry-run: the script of a generation's job, of each Tune.
int print_tune_scripts(const application::StudyArguments& arguments,
                       const std::vector<studies::TunePlan>& plans, bool several) {
  for (const studies::TunePlan& plan : plans)
    print_slurm_script(arguments, plan.label, folder_for(arguments, plan, several),
                       plan.runs_of_a_generation());
  return fine;
}

/// Says how to go on; the exit status.
int interrupted_in(const application::StudyArguments& arguments,
                   const std::filesystem::path& folder, const std::string& command,
                   const InterruptGuard& guard) {
  const std::string out =
      arguments.out ? " --out " + application::shell_word(arguments.out->string()) : "";
  application::print_error("interrupted; what is finished is kept in " + folder.string() + ": `" +
                           command + out + " --resume` goes on from there");
  return guard.status();
}

int tune_one(const application::Application& application,
             const application::StudyArguments& arguments, const studies::TunePlan& plan,
             bool several, const InterruptGuard& guard) {
  const studies::SubjectInfo& subject = plan.runs.subjects.front().info;
  if (!subject.available) {
    application::print_error("engine " + subject.engine + " is not on this machine");
    return missing;
  }
  const std::filesystem::path folder = folder_for(arguments, plan, several);
  const std::string command = application::tune_command(arguments);
  std::optional<studies::TuneRun> run;
  {
    RunBar bar(plan.label);
    studies::TuneOptions options{bar.watch(application::run_options(arguments, folder)), {}};
    options.run.tell = tell;
    const auto remote = remote_runs(arguments, plan.label, folder, tell);
    options.run.remote = remote.get();
    options.generation = [&bar](const studies::GenerationReport& report) {
      bar.message(generation_text(report));
    };
    run = studies::run_tuning(plan, application.engines(), options, guard.stop());
  }
  const std::vector<std::string> undrawn = application::write_tuning(*run, plan, command);
  for (const std::string& message : undrawn) application::print_error(message);
  std::cout << studies::tune_terminal_text(plan, run->result)
            << "report: " << (folder / "report.html").string() << '\n';
  if (run->result.interrupted) return interrupted_in(arguments, folder, command, guard);
  if (!run->result.holds(plan)) return truth_failed;
  return undrawn.empty() ? fine : missing;
}

int calibrate_one(const application::Application& application,
                  const application::StudyArguments& arguments,
                  const studies::CalibrationPlan& plan, bool several, const InterruptGuard& guard) {
  std::filesystem::path folder = plan.folder();
  if (arguments.out) folder = several ? *arguments.out / plan.runs.name : *arguments.out;
  const std::string command = application::tune_command(arguments);
  std::optional<studies::CalibrationRun> run;
  {
    RunBar bar(plan.runs.name);
    studies::CalibrationOptions options{
        bar.watch(application::run_options(arguments, folder)),
        [&bar](const std::string& message) { bar.message(message); }};
    options.run.tell = tell;
    run = studies::run_calibration(plan, application.engines(), options, guard.stop());
  }
  const std::vector<std::string> undrawn = application::write_calibration(*run, plan, command);
  for (const std::string& message : undrawn) application::print_error(message);
  std::cout << studies::calibration_terminal_text(plan, run->result)
            << "report: " << (folder / "report.html").string() << '\n';
  if (run->result.interrupted) return interrupted_in(arguments, folder, command, guard);
  const bool fitted = std::ranges::any_of(
      run->result.subjects,
      [](const studies::SubjectCalibration& one) { return one.error.has_value(); });
  if (!fitted) return truth_failed;
  return undrawn.empty() ? fine : missing;
}

}  // namespace

int tune(const application::StudyArguments& asked) {
  application::Application application(asked.allow_plugins);
  application::StudyArguments arguments = asked;
  arguments.file = application.locate(asked.file);
  if (const auto refusal = slurm_refusal(arguments)) return *refusal;
  const auto root = application.evaluate_set(arguments.file, arguments.settings);
  if (!root) return wrong_input;
  if (!application::holds_tune(*root)) {
    application::print_error(arguments.file.string() +
                             " holds no Tune and no Calibrate; `hookpoint study` runs studies");
    return wrong_input;
  }
  const auto plans = application::plan_tune_file(application, *root, arguments);
  const auto calibrations = application::plan_calibrate_file(application, *root, arguments);
  if (!plans || !calibrations) return wrong_input;
  const bool several = plans->size() + calibrations->size() > 1;
  if (arguments.slurm && !calibrations->empty())
    tell("the fits of a Calibrate are made here, not by the cluster");
  if (arguments.dry_run) return print_tune_scripts(arguments, *plans, several);
  const InterruptGuard guard;
  return making_runs_away([&] {
    return keeping_runs([&] {
      int status = fine;
      for (const studies::TunePlan& plan : *plans) {
        status = std::max(status, tune_one(application, arguments, plan, several, guard));
        if (guard.stop()) return status;
      }
      for (const studies::CalibrationPlan& plan : *calibrations) {
        status = std::max(status, calibrate_one(application, arguments, plan, several, guard));
        if (guard.stop()) break;
      }
      return status;
    });
  });
}

}  // namespace hookpoint::cli
