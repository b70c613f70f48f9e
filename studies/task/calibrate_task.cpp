// A Calibrate as a task.
#include <utility>

#include "studies/blocks/calibrate.h"
#include "studies/calibrate/calibration.h"
#include "studies/calibrate/idleness.h"
#include "studies/calibrate/outputs.h"
#include "studies/calibrate/report.h"
#include "studies/report/latex_tables.h"
#include "studies/report/page_parts.h"
#include "studies/task/task_kinds.h"

namespace hookpoint::studies {
namespace {

class CalibrateTask : public Task {
 public:
  CalibrateTask(const TaskSource& source, CalibrationPlan plan)
      : Task(source, plan.runs.name, plan.runs.hash), plan_(std::move(plan)) {}

  static std::vector<std::string> scenes(const language::Object& block) {
    return scene_files(load_calibrate(block, false));
  }

  static bool plan(const TaskSource& source, const language::Object& block, Tasks& tasks) {
    language::Diagnostics diagnostics;
    auto plan =
        make_calibration_plan(source.root, block, source.file.string(), source.host.library(),
                              source.host.engines(), source.options.quick, diagnostics);
    source.host.tell(diagnostics);
    if (!plan || diagnostics.has_errors()) return false;
    tasks.push_back(std::make_unique<CalibrateTask>(source, std::move(*plan)));
    return true;
  }

  std::string runs_here() const override {
    return "the fits of a Calibrate are made here, not by the cluster";
  }

  std::string terminal_text(const TableStyle&) const override {
    return calibration_terminal_text(plan_, run_.result);
  }
  std::vector<std::string> faults() const override {
    return is_whole() ? fault_lines(idle()) : std::vector<std::string>{};
  }

  ResultValues values() const override {
    const CalibrationResult& result = run_.result;
    ResultValues materials;
    for (std::size_t i = 0; i < result.subjects.size(); ++i)
      materials.push_back(
          {plan_.subjects[i].info.name,
           {material_text(plan_, plan_.subjects[i], result.subjects[i], command_)}});
    std::vector<std::string> notices = notices_;
    for (std::string& misfit : misfits(plan_, result)) notices.push_back(std::move(misfit));
    return {{"table", {calibration_table(plan_, result)}},
            {"correlations", {correlations_table(plan_, result)}},
            {"fits", {fits_table(plan_, result)}},
            {"folds", {folds_table(plan_, result)}},
            {"curves", {curves_table(plan_, result)}},
            {"materials", {std::move(materials)}},
            {"idle", {idle()}},
            {"holds", {holds()}},
            {"notices", {std::move(notices)}}};
  }

 protected:
  void execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) override {
    options.tell = [&](const std::string& notice) {
      notices_.push_back(notice);
      runner.note(notice);
    };
    run_ = run_calibration(
        plan_, host_.engines(),
        {std::move(options), [&runner](const std::string& message) { runner.message(message); }},
        stop);
    files_ = std::move(run_.files);
  }

  bool has_result() const override { return true; }
  bool is_whole() const override { return !run_.result.interrupted; }
  bool holds() const override { return !has_fault(idle()); }
  std::vector<std::string> leave() override {
    figures_ = write_calibration(*files_, plan_, run_, command_);
    return undrawn(figures_);
  }
  Publication publication() const override {
    constexpr std::size_t columns = 7;  // up to `identified`
    std::vector<SubjectInfo> subjects;
    for (const CalibrationSubject& subject : plan_.subjects) subjects.push_back(subject.info);
    const std::string title = title_or_name(plan_.runs.title);
    return {title,
            {latex_table_of("calibration",
                            title + ": fitted constants, with the ends of their 95 % intervals.",
                            calibration_table(plan_, run_.result), columns, 3)},
            figures_,
            origin_words(run_.provenance, subjects)};
  }

 private:
  std::vector<IdleBlock> idle() const { return idle_blocks(plan_, run_.result); }

  CalibrationPlan plan_;
  CalibrationRun run_;
  std::vector<std::string> notices_;
  std::vector<ReportFigure> figures_;
};

}  // namespace

TaskKind calibrate_kind() {
  return {"Calibrate", "tune", CalibrateTask::scenes, CalibrateTask::plan};
}

}  // namespace hookpoint::studies
