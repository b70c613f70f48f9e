#include "cli/walls.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "cli/exit_status.h"
#include "cli/run_bar.h"
#include "output/file.h"
#include "studies/wall.h"
#include "studies/wall_report.h"

namespace hookpoint::cli {
namespace {

constexpr std::size_t table_width = 120;

int run_one(Application& application, const studies::WallPlan& plan,
            const StudyArguments& arguments, const std::string& command, bool alone) {
  const studies::InterruptGuard guard;
  RunBar bar(plan.study.name);
  std::filesystem::path out;
  if (arguments.out) out = alone ? *arguments.out : *arguments.out / plan.study.name;
  const studies::RunOptions options = run_options(arguments, out, bar);
  const std::filesystem::path folder = studies::wall_folder(plan, options);
  const auto result =
      studies::run_wall(plan, application.engines(), options, studies::InterruptGuard::stop());
  bar.end();
  if (!result) return interrupted(folder, command, arguments);
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
