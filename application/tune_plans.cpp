#include "application/tune_plans.h"

#include <utility>

#include "application/study_plans.h"
#include "output/file.h"
#include "studies/report/page_parts.h"
#include "studies/tune/figures.h"
#include "studies/tune/outputs.h"
#include "studies/tune/report.h"

namespace hookpoint::application {

bool holds_tune(const language::Object& root) {
  return !root.children_of("Tune").empty() || !root.children_of("Calibrate").empty();
}

std::optional<std::vector<studies::TunePlan>> plan_tune_file(Application& application,
                                                             const language::Object& root,
                                                             const StudyArguments& arguments) {
  if (!application.load_scene_plugins(root, arguments.file)) return std::nullopt;
  std::vector<studies::TunePlan> all;
  for (const language::Object* tune : root.children_of("Tune")) {
    language::Diagnostics diagnostics;
    auto plans =
        studies::make_tune_plans(root, *tune, arguments.file.string(), application.library(),
                                 application.engines(), arguments.quick, diagnostics);
    application.tell(diagnostics);
    if (!plans || diagnostics.has_errors()) return std::nullopt;
    for (studies::TunePlan& plan : *plans) all.push_back(std::move(plan));
  }
  return all;
}

std::string tune_command(const StudyArguments& arguments) {
  std::string command = "hookpoint tune " + shell_word(arguments.file.string());
  for (const std::string& setting : arguments.settings.trails)
    command += " --set " + shell_word(setting);
  if (arguments.quick) command += " --quick";
  if (arguments.allow_plugins) command += " --allow-plugins";
  return command + slurm_words(arguments);
}

std::vector<std::string> write_tuning(const studies::TuneRun& run, const studies::TunePlan& plan,
                                      const std::string& command) {
  studies::write_tune_files(plan, run, command);
  const auto figures = studies::draw_tune_figures(plan, run.result, run.folder);
  std::vector<std::string> files{"evaluations.csv", "recommended.json", "experiment.hook",
                                 "provenance.json"};
  if (!run.result.indices.empty()) files.emplace_back("sobol.csv");
  if (run.result.recommended)
    files.insert(files.end(), {"pareto.csv", studies::material_file(plan), "scene.hook"});
  const studies::ReportContext context{
      command, {}, studies::provenance_lines(run.provenance), files};
  output::write_file(run.folder / "report.html",
                     studies::tune_html(plan, run.result, context, figures));
  run.files->finish();
  return studies::undrawn(figures);
}

}  // namespace hookpoint::application
