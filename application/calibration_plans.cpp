#include "application/calibration_plans.h"

#include <utility>

#include "output/file.h"
#include "studies/calibrate/figures.h"
#include "studies/calibrate/outputs.h"
#include "studies/calibrate/report.h"
#include "studies/report/page_parts.h"

namespace hookpoint::application {

std::optional<std::vector<studies::CalibrationPlan>> plan_calibrate_file(
    Application& application, const language::Object& root, const StudyArguments& arguments) {
  if (!application.load_scene_plugins(root, arguments.file)) return std::nullopt;
  std::vector<studies::CalibrationPlan> all;
  for (const language::Object* calibrate : root.children_of("Calibrate")) {
    language::Diagnostics diagnostics;
    auto plan = studies::make_calibration_plan(root, *calibrate, arguments.file.string(),
                                               application.library(), application.engines(),
                                               arguments.quick, diagnostics);
    application.tell(diagnostics);
    if (!plan || diagnostics.has_errors()) return std::nullopt;
    all.push_back(std::move(*plan));
  }
  return all;
}

std::vector<std::string> write_calibration(const studies::CalibrationRun& run,
                                           const studies::CalibrationPlan& plan,
                                           const std::string& command) {
  const std::vector<std::string> files = studies::write_calibration_files(plan, run, command);
  const auto figures = studies::draw_calibration_figures(plan, run.result, run.folder);
  const studies::ReportContext context{
      command, {}, studies::provenance_lines(run.provenance), files};
  output::write_file(run.folder / "report.html",
                     studies::calibration_html(plan, run.result, context, figures));
  run.files->finish();
  return studies::undrawn(figures);
}

}  // namespace hookpoint::application
