#include "cli/study_runs.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "cli/exit_status.h"
#include "cli/run_bar.h"
#include "cli/study_reports.h"
#include "studies/terminal_table.h"
#include "studies/verdict.h"
#include "studies/wall_report.h"

namespace hookpoint::cli {
namespace {

constexpr std::size_t wall_table_width = 120;

bool on_terminal() { return isatty(STDOUT_FILENO) != 0; }

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 120;
  return std::max<std::size_t>(size.ws_col, 60);
}

/// Says that what is finished is kept in `folder`, and how to go on. The exit status.
int interrupted(const StudyCommand& command, const std::filesystem::path& folder) {
  const auto& named = command.arguments.out;
  const std::string out = named ? " --out " + named->string() : "";
  print_error("interrupted; what is finished is kept in " + folder.string() + ": `" +
              command.command + out + " --resume` goes on from there");
  return truth_failed;
}

/// A study that ran.
struct StudyOutcome {
  int status = fine;
  std::optional<studies::StudyRun> run;  ///< none when it was interrupted
  std::vector<studies::ReportFigure> figures;
};

StudyOutcome run_into(const StudyCommand& command, const studies::StudyPlan& plan,
                      const std::filesystem::path& folder) {
  const studies::InterruptGuard guard;
  RunBar bar(plan.name);
  studies::StudyRun run =
      studies::run_study(plan, command.engines, bar.watch(run_options(command.arguments, folder)),
                         studies::InterruptGuard::stop());
  bar.end();
  for (const std::string& notice : run.notices) std::cerr << "hookpoint: note: " << notice << '\n';
  if (run.interrupted) return {interrupted(command, run.folder), std::nullopt, {}};
  studies::ReportOutcome report = write_study_report(run, command.command);
  for (const std::string& message : report.messages) print_error(message);
  const int status = !studies::all_truths_hold(run.result) ? truth_failed
                     : report.messages.empty()             ? fine
                                                           : missing;
  return {status, std::move(run), std::move(report.figures)};
}

}  // namespace

int run_one_study(const StudyCommand& command, const studies::StudyPlan& plan) {
  const StudyOutcome outcome = run_into(command, plan, command.folder(plan.name));
  if (!outcome.run) return outcome.status;
  std::cout << studies::terminal_table(outcome.run->result, {on_terminal(), terminal_width()});
  std::cout << "\nreport: " << (outcome.run->folder / "report.html").string() << '\n';
  return outcome.status;
}

int run_one_wall(const StudyCommand& command, const studies::WallPlan& plan) {
  const studies::InterruptGuard guard;
  RunBar bar(plan.study.name);
  const studies::RunOptions options =
      bar.watch(run_options(command.arguments, command.folder(plan.study.name)));
  const std::filesystem::path folder = studies::wall_folder(plan, options);
  const auto result =
      studies::run_wall(plan, command.engines, options, studies::InterruptGuard::stop());
  bar.end();
  if (!result) return interrupted(command, folder);
  write_wall(folder, plan, *result, command.engines, command.command);
  std::cout << studies::wall_terminal_table(*result, {on_terminal(), wall_table_width});
  std::cout << "\nreport: " << (folder / "report.html").string() << '\n';
  return result->failed() == 0 ? fine : truth_failed;
}

int run_one_matrix(const StudyCommand& command, const MatrixPlan& plan) {
  std::filesystem::path folder = command.folder(plan.name);
  if (folder.empty())
    folder = std::filesystem::path("runs") / fmt::format("{}-{}", plan.name, plan.hash);
  studies::MatrixResult result = begin_matrix(plan, command.arguments.file);
  int status = fine;
  for (const MatrixPart& part : plan.parts) {
    StudyOutcome outcome = run_into(command, part.plan, folder / part.plan.name);
    status = std::max(status, outcome.status);
    if (!outcome.run) return status;
    result.studies.push_back(
        {std::move(outcome.run->result), part.text, std::move(outcome.figures)});
  }
  write_matrix(folder, plan, result, command.file.text, command.engines, command.command);
  std::cout << studies::matrix_terminal_table(result, on_terminal());
  std::cout << "\nmatrix: " << (folder / "matrix.html").string() << '\n';
  return status;
}

}  // namespace hookpoint::cli
