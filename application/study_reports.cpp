#include "application/study_reports.h"

#include <algorithm>
#include <map>
#include <utility>

#include "output/file.h"
#include "reference/engines.h"
#include "studies/compare/wall_report.h"
#include "studies/run/provenance.h"
#include "studies/run/results_csv.h"

namespace hookpoint::application {
namespace {

/// Every constant of the peers that the study runs, at the settings that it runs them.
std::vector<studies::PeerSetting> peer_settings(const studies::StudyResult& result) {
  std::vector<std::pair<std::string, std::string>> used;
  for (const studies::SubjectInfo& subject : result.compositions) {
    const std::pair<std::string, std::string> peer{subject.engine, subject.settings};
    if (subject.available && subject.engine != "dts" &&
        std::find(used.begin(), used.end(), peer) == used.end())
      used.push_back(peer);
  }
  std::vector<studies::PeerSetting> settings;
  for (const auto& [engine, name] : used) {
    const reference::Peer& peer = reference::peer_named(engine);
    // One that the peer has not is shown as recommended: its rows were refused.
    const auto shown =
        reference::settings_named(name, peer).value_or(reference::Settings::recommended);
    for (const reference::SettingRow& row : peer.settings_table())
      settings.push_back({engine, name, row.quantity, row.at(shown), row.source});
  }
  return settings;
}

/// The files beside the report that it links to.
std::vector<std::string> result_files(const studies::StudyRun& run) {
  std::vector<std::string> files{"results.csv"};
  if (std::filesystem::exists(run.folder / "timing.csv")) files.emplace_back("timing.csv");
  if (!run.result.peer_distances.empty()) files.emplace_back("peer_distance.csv");
  for (const studies::TableSpec& table : run.result.tables) files.push_back(table.name + ".csv");
  files.insert(files.end(), {"experiment.hook", "scene.hook", "provenance.json"});
  return files;
}

studies::ReportContext report_context(const studies::StudyRun& run, const std::string& command) {
  return {command, peer_settings(run.result), studies::provenance_lines(run.provenance),
          result_files(run)};
}

/// Those of all its studies, each once.
std::vector<output::InputFile> inputs_of(const MatrixPlan& plan) {
  std::map<std::string, std::string> inputs;
  for (const MatrixPart& part : plan.parts)
    for (const output::InputFile& input : part.plan.inputs) inputs.emplace(input.path, input.hash);
  std::vector<output::InputFile> list;
  for (const auto& [path, hash] : inputs) list.push_back({path, hash});
  return list;
}

}  // namespace

studies::ReportOutcome write_study_report(const studies::StudyRun& run,
                                          const std::string& command) {
  studies::ReportOutcome outcome =
      studies::write_report(run.result, report_context(run, command), run.folder);
  run.files->finish();
  return outcome;
}

void link_pictures(const studies::StudyRun& run, const std::string& command,
                   const studies::ReportOutcome& report, const std::vector<std::string>& pictures) {
  studies::ReportContext context = report_context(run, command);
  context.files.insert(context.files.end(), pictures.begin(), pictures.end());
  output::write_file(run.folder / "report.html",
                     studies::report_html(run.result, context, report.figures));
  run.files->finish();
}

void write_wall(const studies::WallRun& run, const studies::WallPlan& plan,
                const studies::EngineTable& engines, const std::string& command) {
  const studies::Provenance provenance = studies::make_provenance(plan.study, engines);
  studies::write_wall_files(run, plan, provenance);
  const studies::ReportContext context{command, {}, studies::provenance_lines(provenance), {}};
  output::write_file(run.folder / "report.html", studies::wall_html(run.result, context));
  run.files->finish();
}

MatrixRun begin_matrix(const MatrixPlan& plan, const StudyArguments& arguments,
                       const std::filesystem::path& folder,
                       std::shared_ptr<studies::RunStore> store) {
  output::Manifest manifest;
  manifest.experiment = plan.hash;
  MatrixRun run{{plan.name, plan.title, plan.question, arguments.file.string(), {}},
                folder,
                std::make_unique<output::ResultFolder>(
                    folder, std::move(manifest),
                    std::vector<std::string>{studies::store_folder, "experiment.hook",
                                             "provenance.json", "matrix.csv", "matrix.html"}),
                std::move(store)};
  if (!run.store)
    run.store =
        std::make_shared<studies::RunStore>(folder / studies::store_folder, arguments.resume);
  return run;
}

void write_matrix(const MatrixRun& run, const MatrixPlan& plan, const std::string& text,
                  const studies::EngineTable& engines, const std::string& command) {
  const std::filesystem::path& folder = run.folder;
  const studies::MatrixResult& result = run.result;
  studies::Provenance provenance = studies::make_provenance(plan.parts.front().plan, engines);
  provenance.study = result.name;
  provenance.file = result.file;
  provenance.hash = plan.hash;
  provenance.inputs = inputs_of(plan);
  output::write_file(folder / "experiment.hook", text);
  output::write_file(folder / "provenance.json", studies::provenance_json(provenance));
  output::write_csv(folder / "matrix.csv", studies::matrix_table(result));
  output::write_file(
      folder / "matrix.html",
      studies::matrix_html(result, {command, {}, studies::provenance_lines(provenance), {}}));
  run.files->finish();
}

}  // namespace hookpoint::application
