#include "studies/task/study_task.h"

#include <utility>

#include "output/files/file.h"
#include "studies/blocks/study.h"
#include "studies/report/latex_tables.h"
#include "studies/results/idleness.h"
#include "studies/results/pivot.h"
#include "studies/run/results_csv.h"
#include "studies/run/verdict.h"
#include "studies/task/task_kinds.h"

namespace hookpoint::studies {

StudyTask::StudyTask(const TaskSource& source, StudyPlan plan, std::vector<std::string> settable)
    : Task(source, plan.name, plan.hash), plan_(std::move(plan)), settable_(std::move(settable)) {
  settable_.insert(settable_.end(), plan_.settable.begin(), plan_.settable.end());
}

std::size_t StudyTask::remote_runs() const { return studies::remote_runs(plan_, host_.engines()); }

StudyResult StudyTask::empty_rows() const { return empty_table(plan_); }

std::optional<SceneFile> StudyTask::pictured_scene(const std::filesystem::path& folder) const {
  return scene_file_of(plan_, plan_.rows.front(), folder);
}

void StudyTask::execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) {
  options.tell = [&runner](const std::string& message) { runner.warn(message); };
  run_ = run_study(plan_, host_.engines(), options, stop);
  files_ = std::move(run_.files);
}

ReportContext StudyTask::context() const {
  return {command_, host_.peer_settings(run_.result), provenance_lines(run_.provenance),
          files_->written()};
}

std::vector<std::string> StudyTask::leave() {
  std::error_code ignored;
  std::filesystem::remove(folder() / picture, ignored);  // an earlier study's
  report_ = write_report(run_.result, context(), folder());
  files_->finish();
  return report_.messages;
}

Publication StudyTask::publication() const {
  return {title_or_name(plan_.title), latex_tables(run_.result), report_.figures,
          origin_words(run_.provenance, run_.result.compositions)};
}

void StudyTask::add_picture() {
  ReportContext with_picture = context();
  // Not among the folder's hashed files: another version of a browser draws other pixels.
  with_picture.files.emplace_back(picture);
  output::write_file(page_file(), report_html(run_.result, with_picture, report_.figures));
  files_->finish();
}

bool StudyTask::holds() const { return all_truths_hold(run_.result); }

std::string StudyTask::terminal_text(const TableStyle& style) const {
  return has_result() ? terminal_table(run_.result, style) + "\n" : "";
}

ResultValues StudyTask::values() const {
  ResultValues tables;
  for (const TableSpec& table : run_.result.tables)
    tables.push_back({table.name, {pivot_of(run_.result, table)}});
  std::vector<ResultValues> truths;
  for (const TruthResult& truth : run_.result.truths)
    truths.push_back({{"name", {truth.name}},
                      {"words", {truth.words}},
                      {"passed", {truth.passed}},
                      {"failed", {truth.failed}}});
  return {{"table", {results_table(run_.result, false)}},
          {"timing", {results_table(run_.result, true)}},
          {"tables", {std::move(tables)}},
          {"truths", {std::move(truths)}},
          {"idle", {idle_blocks(run_.result)}},
          {"holds", {holds()}},
          {"notices", {run_.notices}}};
}

std::optional<StudyPlan> StudyTask::plan_block(const TaskSource& source,
                                               const language::Object& block) {
  language::Diagnostics diagnostics;
  auto plan = make_plan(source.root, block, source.file.string(), source.host.library(),
                        source.host.engines(), source.options, diagnostics);
  source.host.tell(diagnostics);
  return plan;
}

std::vector<std::string> StudyTask::scenes(const language::Object& block) {
  return {*study_block(block).scene};
}

bool StudyTask::plan(const TaskSource& source, const language::Object& block, Tasks& tasks) {
  auto plan = plan_block(source, block);
  if (plan) tasks.push_back(std::make_unique<StudyTask>(source, std::move(*plan)));
  return plan.has_value();
}

TaskKind study_kind() { return {"Study", "study", StudyTask::scenes, StudyTask::plan}; }

}  // namespace hookpoint::studies
