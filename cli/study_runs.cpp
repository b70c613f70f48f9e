#include "cli/study_runs.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "cli/exit_status.h"
#include "cli/run_bar.h"
#include "reference/engines.h"
#include "studies/run.h"
#include "studies/terminal_table.h"
#include "studies/verdict.h"

namespace hookpoint::cli {
namespace {

using studies::StudyPlan;
using studies::StudyRun;

/// Every constant of the peers that the study runs, at the settings that it runs them.
std::vector<studies::PeerSetting> peer_settings(const studies::StudyResult& result) {
  std::vector<std::pair<std::string, std::string>> used;
  for (const studies::SubjectInfo& subject : result.subjects) {
    const std::pair<std::string, std::string> peer{subject.engine, subject.settings};
    if (subject.available && subject.engine != "dts" &&
        std::find(used.begin(), used.end(), peer) == used.end())
      used.push_back(peer);
  }
  std::vector<studies::PeerSetting> settings;
  for (const auto& [engine, name] : used) {
    for (const reference::SettingRow& row : reference::settings_table(engine)) {
      const std::string& value = name == "matched"       ? row.matched
                                 : name == "recommended" ? row.recommended
                                                         : row.default_;
      settings.push_back({engine, name, row.quantity, value, row.source});
    }
  }
  return settings;
}

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 120;
  return std::max<std::size_t>(size.ws_col, 60);
}

/// The files beside the report that it links to.
std::vector<std::string> result_files(const StudyRun& run) {
  std::vector<std::string> files{"results.csv"};
  if (std::filesystem::exists(run.folder / "timing.csv")) files.emplace_back("timing.csv");
  if (!run.result.peer_distances.empty()) files.emplace_back("peer_distance.csv");
  files.insert(files.end(), {"experiment.hook", "scene.hook", "provenance.json"});
  return files;
}

}  // namespace

std::string rerun_command(const StudyArguments& arguments, const std::filesystem::path& file) {
  std::string command = "hookpoint study " + file.string();
  if (arguments.quick) command += " --quick";
  for (const std::string& subject : arguments.only) command += " --only " + subject;
  if (arguments.allow_plugins) command += " --allow-plugins";
  return command;
}

std::optional<std::vector<StudyPlan>> plan_studies(Application& application,
                                                   const language::Object& root,
                                                   const std::filesystem::path& file,
                                                   const studies::PlanOptions& options) {
  std::vector<StudyPlan> plans;
  for (const language::Object* object : root.children_of("Study")) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_plan(root, *object, file.string(), application.library(),
                                   application.engines(), options, diagnostics);
    print_diagnostics(diagnostics);
    if (!plan) return std::nullopt;
    plans.push_back(std::move(*plan));
  }
  return plans;
}

StudyOutcome run_one_study(Application& application, const StudyPlan& plan,
                           const StudyArguments& arguments, const std::filesystem::path& folder,
                           const std::string& command, bool print_table) {
  studies::InterruptGuard guard;
  RunBar bar(plan.name);
  StudyRun run =
      studies::run_study(plan, application.engines(), run_options(arguments, folder, bar),
                         studies::InterruptGuard::stop());
  bar.end();
  for (const std::string& notice : run.notices) std::cerr << "hookpoint: note: " << notice << '\n';
  if (run.interrupted) return {interrupted(run.folder, command, arguments), std::nullopt, {}};
  const studies::ReportContext context{command, peer_settings(run.result),
                                       studies::provenance_lines(run.provenance),
                                       result_files(run)};
  const studies::ReportOutcome report = studies::write_report(run.result, context, run.folder);
  if (print_table) {
    std::cout << studies::terminal_table(run.result,
                                         {isatty(STDOUT_FILENO) != 0, terminal_width()});
    std::cout << "\nreport: " << (run.folder / "report.html").string() << '\n';
  }
  for (const std::string& message : report.messages) print_error(message);
  const int status = !studies::all_truths_hold(run.result) ? truth_failed
                     : report.messages.empty()             ? fine
                                                           : missing;
  return {status, std::move(run.result), report.figures};
}

}  // namespace hookpoint::cli
