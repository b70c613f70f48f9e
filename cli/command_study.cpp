#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "cli/study_run.h"
#include "cli/walls.h"
#include "reference/engines.h"
#include "studies/plan.h"
#include "studies/report.h"
#include "studies/run.h"
#include "studies/terminal_table.h"
#include "studies/verdict.h"
#include "studies/wall.h"

namespace hookpoint::cli {
namespace {

using studies::StudyPlan;
using studies::StudyRun;

/// Every constant of the peers that the study runs, at the settings that it runs them.
std::vector<studies::PeerSetting> peer_settings(const studies::StudyResult& result) {
  std::vector<std::pair<std::string, std::string>> used;
  for (const studies::SubjectInfo& subject : result.subjects) {
    const std::pair<std::string, std::string> peer{subject.engine, subject.settings};
    if (subject.engine != "dts" && std::find(used.begin(), used.end(), peer) == used.end())
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

std::string rerun_command(const StudyArguments& arguments) {
  std::string command = "hookpoint study " + arguments.file.string();
  if (arguments.quick) command += " --quick";
  for (const std::string& subject : arguments.only) command += " --only " + subject;
  if (arguments.allow_plugins) command += " --allow-plugins";
  return command;
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
  files.insert(files.end(), {"experiment.hook", "scene.hook", "provenance.json"});
  return files;
}

/// Runs one study with its progress bar; the table, files and report follow unless it was
/// interrupted.
int run_one(Application& application, const StudyPlan& plan, const StudyArguments& arguments,
            std::size_t studies_in_file) {
  studies::InterruptGuard guard;
  RunBar bar(plan.name);
  const StudyRun run = studies::run_study(plan, application.engines(),
                                          run_options(arguments, plan.name, studies_in_file, bar),
                                          studies::InterruptGuard::stop());
  bar.end();
  for (const std::string& notice : run.notices) std::cerr << "hookpoint: note: " << notice << '\n';
  if (run.interrupted) return interrupted(run.folder, rerun_command(arguments), arguments);
  const studies::ReportContext context{rerun_command(arguments), peer_settings(run.result),
                                       studies::provenance_lines(run.provenance),
                                       result_files(run)};
  const studies::ReportOutcome report = studies::write_report(run.result, context, run.folder);
  std::cout << studies::terminal_table(run.result, {isatty(STDOUT_FILENO) != 0, terminal_width()});
  std::cout << "\nreport: " << (run.folder / "report.html").string() << '\n';
  for (const std::string& message : report.messages) print_error(message);
  if (!studies::all_truths_hold(run.result)) return truth_failed;
  return report.messages.empty() ? fine : missing;
}

std::vector<std::string> scene_files(const language::Object& root) {
  std::vector<std::string> files;
  for (const language::Object* study : root.children_of("Study"))
    files.push_back(study->word("scene"));
  for (const language::Object* wall : root.children_of("Wall")) {
    for (const language::Object* scene : wall->children_of("Scene"))
      files.push_back(studies::scene_file(*scene));
  }
  return files;
}

/// A scene may name plugins that the study does not. False after errors, which are printed.
bool load_scene_plugins(Application& application, const language::Object& root,
                        const std::filesystem::path& file) {
  for (const std::string& scene : scene_files(root)) {
    const std::filesystem::path found = application.library().find(scene, file);
    if (!found.empty() && !application.load_plugins(found)) return false;
  }
  return true;
}

}  // namespace

int study(const StudyArguments& arguments) {
  Application application(arguments.allow_plugins);
  const auto root = application.evaluate(arguments.file, {});
  if (!root) return wrong_input;
  const auto studies = root->children_of("Study");
  if (studies.empty() && root->children_of("Wall").empty()) {
    print_error(arguments.file.string() +
                " holds no Study and no Wall; `hookpoint run` runs a world");
    return wrong_input;
  }
  if (!load_scene_plugins(application, *root, arguments.file)) return wrong_input;
  std::vector<StudyPlan> plans;
  for (const language::Object* object : studies) {
    language::Diagnostics diagnostics;
    auto plan =
        studies::make_plan(*root, *object, arguments.file.string(), application.library(),
                           application.engines(), {arguments.quick, arguments.only}, diagnostics);
    print_diagnostics(diagnostics);
    if (!plan) return wrong_input;
    plans.push_back(std::move(*plan));
  }
  int status = fine;
  for (const StudyPlan& plan : plans)
    status = std::max(status, run_one(application, plan, arguments, plans.size()));
  return std::max(status, run_walls(application, *root, arguments, rerun_command(arguments)));
}

}  // namespace hookpoint::cli
