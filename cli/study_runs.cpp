#include "cli/study_runs.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "application/study_reports.h"
#include "cli/cluster_runs.h"
#include "cli/exit_status.h"
#include "cli/run_bar.h"
#include "cli/scene_picture.h"
#include "output/file.h"
#include "output/result_folder.h"
#include "output/text/terminal.h"
#include "studies/compare/wall_report.h"
#include "studies/report/terminal_table.h"
#include "studies/run/results_csv.h"
#include "studies/run/scene_file.h"
#include "studies/run/verdict.h"

namespace hookpoint::cli {
namespace {

constexpr std::size_t wall_table_width = 120;

bool coloured() { return output::wants_colours(STDOUT_FILENO); }

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 120;
  return std::max<std::size_t>(size.ws_col, 60);
}

/// That what is finished is kept in `folder`, and how to go on; "" when nothing is.
std::string how_to_go_on(const StudyCommand& command, const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / output::Manifest::file_name, ignored)) return "";
  const auto& named = command.arguments.out;
  const std::string out = named ? " --out " + application::shell_word(named->string()) : "";
  return "; what is finished is kept in " + folder.string() + ": `" + command.command + out +
         " --resume` goes on from there";
}

int interrupted(const StudyCommand& command, const studies::StudyPlan& plan,
                const std::filesystem::path& folder) {
  if (command.view != nullptr) command.view->interrupt(plan);
  application::print_error("interrupted" + how_to_go_on(command, folder));
  return command.guard.status();
}

/// What `work` makes, which writes into `folder`; when the disk refuses, its error says how to go
/// on.
template <class Work>
auto writing_into(const StudyCommand& command, const std::filesystem::path& folder,
                  const Work& work) {
  try {
    return work();
  } catch (const output::PlaceError& error) {
    throw output::PlaceError(error.what() + how_to_go_on(command, folder));
  } catch (const output::FileError& error) {
    throw output::FileError(error.what() + how_to_go_on(command, folder));
  } catch (const studies::StoreError& error) {
    throw studies::StoreError(error.what() + how_to_go_on(command, folder));
  } catch (const studies::SlurmError& error) {
    throw studies::SlurmError(error.what() + how_to_go_on(command, folder));
  }
}

/// With the bar, and the page where there is one.
studies::RunOptions watched(const StudyCommand& command, const studies::StudyPlan& plan,
                            RunBar& bar, const std::filesystem::path& folder) {
  studies::RunOptions options = bar.watch(application::run_options(command.arguments, folder));
  return command.view == nullptr ? options : command.view->watch(plan, std::move(options));
}

/// The table on stdout, unless a page shows it, and where the report is.
void print_result(const StudyCommand& command, const std::string& table, const char* what,
                  const std::filesystem::path& report) {
  if (command.view == nullptr)
    std::cout << table << '\n' << what << ": " << report.string() << '\n';
  else
    std::cerr << what << ": " << report.string() << '\n';
}

void tell(const std::string& notice) { std::cerr << "hookpoint: note: " << notice << '\n'; }

void print_script_of(const StudyCommand& command, const studies::StudyPlan& plan,
                     const std::filesystem::path& folder) {
  const std::size_t runs = studies::remote_runs(plan, command.engines);
  if (runs == 0) return tell(plan.name + " has no run for a cluster");
  print_slurm_script(command.arguments, plan.name, folder, runs);
}

constexpr const char* picture_of_scene = "pictures/scene.png";

/// A picture for the report of a study that is watched: of the scene, as the first row has it. Not
/// among the folder's hashed files, since another version of a browser draws other pixels. Nobody
/// waits for the browser: the page has the report before, and who goes gets no picture.
void draw_picture(const StudyCommand& command, const studies::StudyPlan& plan,
                  const studies::StudyRun& run, const studies::ReportOutcome& report) {
  const studies::RowPlan& row = plan.rows.front();
  const studies::SceneFile scene = studies::scene_file_of(plan, row, run.folder / "pictures");
  const std::string problem = draw_scene_picture(
      {scene.file, scene.settings, command.arguments.allow_plugins, run.folder / picture_of_scene},
      command.guard.stop());
  if (problem.empty())
    application::link_pictures(run, command.command, report, {picture_of_scene});
  else if (!command.guard.stop())
    tell("the report has no picture of the scene: " + problem);
}

/// A study that ran.
struct StudyOutcome {
  int status = fine;
  std::optional<studies::StudyRun> run;  ///< none when it was interrupted
  std::vector<studies::ReportFigure> figures;
};

StudyOutcome run_into(const StudyCommand& command, const studies::StudyPlan& plan,
                      const std::filesystem::path& folder,
                      const std::shared_ptr<studies::RunStore>& store) {
  RunBar bar(plan.name);
  studies::RunOptions options = watched(command, plan, bar, folder);
  options.tell = tell;
  options.store = store;
  const auto remote = remote_runs(command.arguments, plan.name, folder, tell);
  options.remote = remote.get();
  studies::StudyRun run = studies::run_study(plan, command.engines, options, command.guard.stop());
  bar.end();
  for (const std::string& notice : run.notices) tell(notice);
  if (run.interrupted) return {interrupted(command, plan, run.folder), std::nullopt, {}};
  std::error_code ignored;
  std::filesystem::remove(run.folder / picture_of_scene, ignored);  // an earlier study's
  studies::ReportOutcome report = application::write_study_report(run, command.command);
  for (const std::string& message : report.messages) application::print_error(message);
  if (command.view != nullptr) {
    command.view->finish(plan, run.result, run.folder / "report.html");
    draw_picture(command, plan, run, report);
  }
  const int status = !studies::all_truths_hold(run.result) ? truth_failed
                     : report.messages.empty()             ? fine
                                                           : missing;
  return {status, std::move(run), std::move(report.figures)};
}

int run_matrix_into(const StudyCommand& command, const application::MatrixPlan& plan,
                    const std::filesystem::path& folder) {
  application::MatrixRun run =
      application::begin_matrix(plan, command.arguments, folder, command.store);
  int status = fine;
  for (const application::MatrixPart& part : plan.parts) {
    StudyOutcome outcome = run_into(command, part.plan, folder / part.plan.name, run.store);
    status = std::max(status, outcome.status);
    if (!outcome.run) return status;
    run.result.studies.push_back(
        {std::move(outcome.run->result), part.text, std::move(outcome.figures)});
  }
  application::write_matrix(run, plan, command.file.text, command.engines, command.command);
  print_result(command, studies::matrix_terminal_table(run.result, coloured()), "matrix",
               folder / "matrix.html");
  return status;
}

}  // namespace

int print_slurm_scripts(const StudyCommand& command) {
  for (const studies::StudyPlan& plan : command.file.studies)
    print_script_of(command, plan, command.folder(plan));
  for (const application::MatrixPlan& matrix : command.file.matrices)
    for (const application::MatrixPart& part : matrix.parts)
      print_script_of(command, part.plan, command.folder(matrix) / part.plan.name);
  return fine;
}

int run_one_study(const StudyCommand& command, const studies::StudyPlan& plan) {
  const std::filesystem::path folder = command.folder(plan);
  const StudyOutcome outcome =
      writing_into(command, folder, [&] { return run_into(command, plan, folder, command.store); });
  if (!outcome.run) return outcome.status;
  print_result(command,
               studies::terminal_table(outcome.run->result, {coloured(), terminal_width()}),
               "report", outcome.run->folder / "report.html");
  return outcome.status;
}

int run_one_wall(const StudyCommand& command, const studies::WallPlan& plan) {
  RunBar bar(plan.study.name);
  const std::filesystem::path folder = command.folder(plan.study);
  studies::RunOptions options = watched(command, plan.study, bar, folder);
  options.tell = tell;
  options.store = command.store;
  if (command.arguments.slurm)
    tell("the Wall " + plan.study.name + " has few runs, which are made here");
  const auto run = writing_into(command, folder, [&] {
    auto ran = studies::run_wall(plan, command.engines, options, command.guard.stop());
    bar.end();
    if (ran) application::write_wall(*ran, plan, command.engines, command.command);
    return ran;
  });
  if (!run) return interrupted(command, plan.study, folder);
  for (const std::string& notice : run->notices) tell(notice);
  if (command.view != nullptr) command.view->finish(plan.study, folder / "report.html");
  print_result(command, studies::wall_terminal_table(run->result, {coloured(), wall_table_width}),
               "report", folder / "report.html");
  return run->result.failed() == 0 ? fine : truth_failed;
}

int run_one_matrix(const StudyCommand& command, const application::MatrixPlan& plan) {
  const std::filesystem::path folder = command.folder(plan);
  return writing_into(command, folder, [&] { return run_matrix_into(command, plan, folder); });
}

}  // namespace hookpoint::cli
