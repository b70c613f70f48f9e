#include "cli/walls.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <thread>

#include "cli/exit_status.h"
#include "output/file.h"
#include "output/progress.h"
#include "studies/wall.h"
#include "studies/wall_report.h"

namespace hookpoint::cli {
namespace {

constexpr std::size_t table_width = 120;

studies::RunOptions wall_options(const StudyArguments& arguments,
                                 std::optional<output::Progress>& bar, const std::string& name) {
  studies::RunOptions options;
  options.jobs = arguments.jobs > 0
                     ? arguments.jobs
                     : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.progress = [&bar, name](const studies::Progress& progress) {
    if (!bar) bar.emplace(name, progress.total, 0);
    bar->advance(1);
  };
  return options;
}

int run_one(Application& application, const studies::WallPlan& plan,
            const StudyArguments& arguments, const std::string& command, bool alone) {
  const studies::InterruptGuard guard;
  std::optional<output::Progress> bar;
  const auto result =
      studies::run_wall(plan, application.engines(), wall_options(arguments, bar, plan.study.name),
                        studies::InterruptGuard::stop());
  bar.reset();
  if (!result) {
    print_error("interrupted; a Wall keeps nothing of a run that did not end");
    return truth_failed;
  }
  std::filesystem::path folder =
      std::filesystem::path("runs") / fmt::format("{}-{}", plan.study.name, plan.study.hash);
  if (arguments.out) folder = alone ? *arguments.out : *arguments.out / plan.study.name;
  const studies::Provenance provenance =
      studies::make_provenance(plan.study, application.engines());
  studies::write_wall_files(folder, plan, *result, provenance);
  const studies::ReportContext context{command, {}, studies::provenance_lines(provenance), {}};
  output::write_file(folder / "report.html", studies::wall_html(*result, context));
  std::cout << studies::wall_terminal_table(*result, {isatty(STDOUT_FILENO) != 0, table_width});
  std::cout << "\nreport: " << (folder / "report.html").string() << '\n';
  return result->failed() == 0 ? fine : truth_failed;
}

}  // namespace

int run_walls(Application& application, const language::Object& root,
              const StudyArguments& arguments, const std::string& command) {
  const auto walls = root.children_of("Wall");
  std::vector<studies::WallPlan> plans;
  for (const language::Object* wall : walls) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_wall_plan(root, *wall, arguments.file.string(), application.library(),
                                        {arguments.quick, arguments.only}, diagnostics);
    print_diagnostics(diagnostics);
    if (!plan) return wrong_input;
    plans.push_back(std::move(*plan));
  }
  int status = fine;
  for (const studies::WallPlan& plan : plans)
    status = std::max(status, run_one(application, plan, arguments, command, plans.size() == 1));
  return status;
}

}  // namespace hookpoint::cli
