// A Wall: scenes that bring their own truths (Expect), each run under every subject that its truths
// cover. Plan, run, result: plain values between them.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "output/files/csv.h"
#include "studies/plan/plan.h"
#include "studies/results/idleness.h"
#include "studies/run/run.h"

namespace hookpoint::studies {

struct WallScene {
  std::string name;                       ///< "braking_block"
  std::string title;                      ///< what it shows
  std::string file;                       ///< as the Wall writes it
  std::optional<double> accepted = {};    ///< error that others accept, SI
  std::string accepted_by = {};           ///< who they are
  std::vector<std::string> expects = {};  ///< names of all that it expects, of whatever law
};

/// A Wall as a study whose one sweep is its scenes.
struct WallPlan {
  StudyPlan study;
  std::vector<std::vector<simulation::ExpectationSpec>> expectations;  ///< that cover it, one a row
  std::vector<WallScene> scenes;
  std::vector<std::string> unselected;  ///< Subjects that --only leaves out
  bool score_card = false;              ///< it compares, and its truths need not hold
};

/// The result of one truth under one subject.
struct WallCell {
  std::optional<double> measured, error;
  std::optional<double> decades;  ///< of the error (ExpectationResult::decades)
  double expected = 0.;
  bool ok = false;
  std::string status;  ///< "ok", or what stopped the run; "" where the truth says nothing of it
  std::string law, integrator;  ///< of the run
};

/// One truth of one scene under all subjects.
struct WallLine {
  std::size_t scene = 0;
  std::string name, formula, source, unit;
  std::string allowed;          ///< "0.1 %", "1e-06 m"
  bool relative = true;         ///< how errors are written
  double scale = 0.;            ///< of decades of error
  std::vector<WallCell> cells;  ///< one a subject
};

struct WallResult {
  std::string name, title, question, file;
  std::vector<WallScene> scenes;
  std::vector<SubjectInfo> subjects;
  std::vector<WallLine> lines;        ///< scenes in order, their truths in order
  std::vector<std::string> warnings;  ///< the plan's
  std::vector<IdleBlock> idle;        ///< Expects that cover no run
  bool score_card = false;            ///< it compares, and its truths need not hold
  /// No scene's Expects all judge nothing, and where it does not compare every verdict holds: what
  /// exit status 0 means.
  bool holds() const { return (score_card || failed() == 0) && !has_fault(idle); }
  int passed() const;
  int failed() const;
  int left_out() const;  ///< truths that no run judges, for want of an engine
};

/// A Wall that ran, before its files are written.
struct WallRun {
  WallResult result;
  std::filesystem::path folder;                 ///< where the files go
  std::unique_ptr<output::ResultFolder> files;  ///< locks it
  std::vector<std::string> notices;             ///< of its runs (collect_notices)
};

/// The plan of `wall`, an object of `root`. Nothing when `diagnostics` got an error: a scene that
/// is not there, has no Expect, or that no subject covers. A run whose step is above its law's
/// stability bound gets a warning. Every run's scene is loaded here.
std::optional<WallPlan> make_wall_plan(const language::Object& root, const language::Object& wall,
                                       const std::string& file, language::Library& library,
                                       const EngineTable& engines, const PlanOptions& options,
                                       language::Diagnostics& diagnostics);

/// The table of the Wall's runs with no row run: how many truths hold in each.
StudyResult empty_wall_table(const WallPlan& plan);

/// Runs all, by `options.jobs` threads, with the same result for any number of them; nothing when
/// `stop` was set. Finished runs are kept as those of a study are; with `options.resume` they are
/// not run again. A run that diverges or cannot run is a cell with that status. A row that
/// `options.row_done` hears of has one metric: how many of its truths hold, beside how many there
/// are. Throws output::FolderError, output::FileError, StoreError.
std::optional<WallRun> run_wall(const WallPlan& plan, const EngineTable& engines,
                                const RunOptions& options, const std::atomic<bool>& stop);

/// A row a truth and subject: scene, truth, subject, engine, law, integrator, measured, expected,
/// unit, error, allowed, ok, status.
output::CsvTable wall_results_table(const WallResult& result);

/// results.csv (the table), experiment.hook and provenance.json in the Wall's folder.
/// Throws output::FileError.
void write_wall_files(output::ResultFolder& folder, const WallResult& result, const WallPlan& plan,
                      const Provenance& provenance);

}  // namespace hookpoint::studies
