// A Study as a task, which a Matrix has several of.
#pragma once

#include "studies/task/task.h"

namespace hookpoint::studies {

class StudyTask : public Task {
 public:
  /// `settable`: what the study's file may set beside its scenes.
  StudyTask(const TaskSource& source, StudyPlan plan, std::vector<std::string> settable = {});

  static std::vector<std::string> scenes(const language::Object& block);
  static bool plan(const TaskSource& source, const language::Object& block, Tasks& tasks);
  /// The plan of a Study block; nothing after errors, which are reported.
  static std::optional<StudyPlan> plan_block(const TaskSource& source,
                                             const language::Object& block);

  std::vector<std::string> settable() const override { return settable_; }
  std::size_t remote_runs() const override;
  const StudyPlan* rows_plan() const override { return &plan_; }
  StudyResult empty_rows() const override;
  const StudyResult* rows() const override { return &run_.result; }
  std::optional<SceneFile> pictured_scene(const std::filesystem::path& folder) const override;
  void add_picture() override;
  std::string terminal_text(const TableStyle& style) const override;
  ResultValues values() const override;

  const std::vector<ReportFigure>& figures() const { return report_.figures; }

 protected:
  void execute(RunOptions options, TaskRunner& runner, const std::atomic<bool>& stop) override;
  bool has_result() const override { return !run_.interrupted; }
  std::vector<std::string> notices() const override { return run_.notices; }
  std::vector<std::string> leave() override;
  Publication publication() const override;
  bool holds() const override;

 private:
  ReportContext context() const;

  StudyPlan plan_;
  std::vector<std::string> settable_;
  StudyRun run_;
  ReportOutcome report_;
};

}  // namespace hookpoint::studies
