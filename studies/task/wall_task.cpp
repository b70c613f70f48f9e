// A Wall as a task.
#include <utility>

#include "studies/blocks/wall.h"
#include "studies/compare/score_card.h"
#include "studies/compare/wall.h"
#include "studies/compare/wall_report.h"
#include "studies/task/task_kinds.h"

namespace hookpoint::studies {
namespace {

class WallTask : public Task {
 public:
  WallTask(const TaskSource& source, WallPlan plan)
      : Task(source, plan.study.name, plan.study.hash), plan_(std::move(plan)) {}

  static std::vector<std::string> scenes(const language::Object& block) {
    std::vector<std::string> files;
    for (const language::Object* scene : block.children_of("Scene"))
      files.push_back(scene_file(*scene));
    return files;
  }

  static bool plan(const TaskSource& source, const language::Object& block, Tasks& tasks) {
    language::Diagnostics diagnostics;
    auto plan = make_wall_plan(source.root, block, source.file.string(), source.host.library(),
                               source.host.engines(), source.options, diagnostics);
    source.host.tell(diagnostics);
    if (plan) tasks.push_back(std::make_unique<WallTask>(source, std::move(*plan)));
    return plan.has_value();
  }

  std::vector<std::string> settable() const override { return plan_.study.settable; }
  std::string runs_here() const override {
    return "the Wall " + name() + " has few runs, which are made here";
  }
  const StudyPlan* rows_plan() const override { return &plan_.study; }

  StudyResult empty_rows() const override { return empty_wall_table(plan_); }

  std::string terminal_text(const TableStyle& style) const override {
    constexpr std::size_t width = 120;
    return run_ ? wall_terminal_table(run_->result, {style.color, width}) + "\n" : "";
  }

  ResultValues values() const override {
    const WallResult& result = run_->result;
    return {{"table", {wall_results_table(result)}},
            {"passed", {result.passed()}},
            {"failed", {result.failed()}},
            {"notices", {run_->notices}},
            {"warnings", {result.warnings}}};
  }

 protected:
  void execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) override {
    options.tell = [&runner](const std::string& message) { runner.warn(message); };
    run_ = run_wall(plan_, host_.engines(), options, stop);
    if (run_) files_ = std::move(run_->files);
  }

  bool has_result() const override { return run_.has_value(); }
  bool holds() const override { return run_->result.holds(); }
  std::vector<std::string> notices() const override {
    return run_ ? run_->notices : std::vector<std::string>{};
  }

  std::vector<std::string> leave() override {
    const Provenance provenance = make_provenance(plan_.study, host_.engines());
    origin_ = origin_words(provenance, run_->result.subjects);
    write_wall_files(*files_, run_->result, plan_, provenance);
    std::vector<std::string> problems;
    card_ = draw_card(problems);
    files_->write("report.html",
                  wall_html(run_->result, {command_, {}, provenance_lines(provenance), {}}, card_));
    files_->finish();
    return problems;
  }

  Publication publication() const override {
    const WallResult& result = run_->result;
    Publication publication{title_or_name(result.title), {latex_wall_table(result)}, {}, origin_};
    if (card_) {
      publication.tables.push_back(latex_score_table(result));
      publication.figures = {*card_};
    }
    return publication;
  }

 private:
  std::optional<ReportFigure> draw_card(std::vector<std::string>& problems) {
    if (!run_->result.score_card) return std::nullopt;
    files_->write(std::string(score_table_name) + ".csv", score_table(run_->result).text());
    const output::HeatMap map = score_card(run_->result);
    const output::PlotOutcome drawn = output::draw(map, folder());
    if (!drawn.drawn) problems.push_back(drawn.message);
    return ReportFigure{map.name, map.title + ": " + map.subtitle + ".", drawn.svg, drawn.message};
  }

  WallPlan plan_;
  std::optional<WallRun> run_;
  std::optional<ReportFigure> card_;
  std::string origin_;
};

}  // namespace

TaskKind wall_kind() { return {"Wall", "study", WallTask::scenes, WallTask::plan}; }

}  // namespace hookpoint::studies
