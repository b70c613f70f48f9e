// A Tune under one of its subjects as a task.
#include <fmt/format.h>

#include <utility>

#include "language/names.h"
#include "studies/blocks/tune.h"
#include "studies/report/latex_tables.h"
#include "studies/report/page_parts.h"
#include "studies/run/provenance.h"
#include "studies/task/task_kinds.h"
#include "studies/tune/idleness.h"
#include "studies/tune/outputs.h"
#include "studies/tune/report.h"
#include "studies/tune/tune.h"

namespace hookpoint::studies {
namespace {

class TuneTask : public Task {
 public:
  TuneTask(const TaskSource& source, TunePlan plan)
      : Task(source, plan.label, plan.runs.hash), plan_(std::move(plan)) {}

  static std::vector<std::string> scenes(const language::Object& block) {
    return scene_files(load_tune(block, false));
  }

  static bool plan(const TaskSource& source, const language::Object& block, Tasks& tasks) {
    language::Diagnostics diagnostics;
    auto plans = make_tune_plans(source.root, block, source.file.string(), source.host.library(),
                                 source.host.engines(), source.options.quick, diagnostics);
    source.host.tell(diagnostics);
    if (!plans || diagnostics.has_errors()) return false;
    for (TunePlan& plan : *plans)
      tasks.push_back(std::make_unique<TuneTask>(source, std::move(plan)));
    return true;
  }

  std::string missing() const override {
    const SubjectInfo& subject = plan_.runs.subjects.front().info;
    return subject.available ? "" : "engine " + subject.engine + " is not on this machine";
  }
  std::size_t remote_runs() const override { return plan_.runs_of_a_generation(); }

  std::string terminal_text(const TableStyle&) const override {
    return tune_terminal_text(plan_, run_.result);
  }
  std::vector<std::string> faults() const override {
    return is_whole() ? fault_lines(idle()) : std::vector<std::string>{};
  }

  ResultValues values() const override {
    const TuneResult& result = run_.result;
    return {{"table", {evaluations_table(plan_, result)}},
            {"pareto", {pareto_table(plan_, result)}},
            {"sobol", {indices_table(plan_, result)}},
            {"recommended", {JsonText{recommended_json(plan_, result)}}},
            {"material", {result.recommended ? material_text(plan_, result, command_) : ""}},
            {"idle", {idle()}},
            {"holds", {holds()}},
            {"notices", {notices_}}};
  }

 protected:
  void execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) override {
    options.tell = [&](const std::string& notice) {
      notices_.push_back(notice);
      runner.note(notice);
    };
    run_ = run_tuning(plan_, host_.engines(),
                      {std::move(options),
                       [&runner](const GenerationReport& report) {
                         runner.message(words_of_generation(report));
                       }},
                      stop);
    files_ = std::move(run_.files);
  }

  bool has_result() const override { return true; }
  bool is_whole() const override { return !run_.result.interrupted; }
  bool holds() const override { return run_.result.holds(plan_) && !has_fault(idle()); }
  std::vector<std::string> leave() override {
    figures_ = write_tuning(*files_, plan_, run_, command_);
    return undrawn(figures_);
  }
  Publication publication() const override {
    const TuneResult& result = run_.result;
    const std::string title = title_or_name(plan_.title);
    Publication publication{
        title, {}, figures_, origin_words(run_.provenance, {plan_.runs.subjects.front().info})};
    const auto add = [&](const std::string& table, const std::string& caption,
                         const output::CsvTable& rows, std::size_t words) {
      publication.tables.push_back(
          latex_table_of(table, title + ": " + caption, rows, rows.header.size(), words));
    };
    if (result.recommended)
      add("pareto", "the Pareto set with its constants and objectives.",
          pareto_table(plan_, result), 0);
    if (!result.indices.empty())
      add("sobol", "Sobol's indices with their 95 % intervals.", indices_table(plan_, result), 2);
    return publication;
  }

 private:
  /// "generation 3 of 25, 18 runs/s, 7 in the Pareto set; best foot_slip 0.02, ..."
  static std::string words_of_generation(const GenerationReport& report) {
    std::string text = fmt::format("generation {} of {}, {:.3g} runs/s", report.generation,
                                   report.generations, report.runs_per_second);
    if (report.best.empty()) return text + "; no candidate meets the requirements so far";
    return text + fmt::format(", {} in the Pareto set; best {}", report.pareto,
                              language::join(report.best, ", "));
  }

  std::vector<IdleBlock> idle() const { return idle_blocks(plan_, run_.result); }

  TunePlan plan_;
  TuneRun run_;
  std::vector<std::string> notices_;
  std::vector<ReportFigure> figures_;
};

}  // namespace

TaskKind tune_kind() { return {"Tune", "tune", TuneTask::scenes, TuneTask::plan}; }

}  // namespace hookpoint::studies
