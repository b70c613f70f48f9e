// A Wall: scenes that bring their own truths (Expect), each run under every subject that its truths
// cover. Plan, run, result: plain values between them.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/document.h"
#include "output/text/csv.h"
#include "studies/plan/plan.h"
#include "studies/run/run.h"

namespace hookpoint::studies {

struct WallScene {
  std::string name;   ///< "braking_block"
  std::string title;  ///< what it shows
  std::string file;   ///< as the Wall writes it
};

/// What a Wall knows of a run beside its row.
struct WallRunPlan {
  std::vector<simulation::ExpectationSpec> expectations;  ///< that cover it
  std::string law, integrator;                            ///< "" where it has none
};

struct WallPlan {
  StudyPlan study;  ///< name, subjects, hash; a row a run, its one value the index of the scene
  std::vector<WallRunPlan> runs;  ///< one a row
  std::vector<WallScene> scenes;
};

/// The result of one truth under one subject.
struct WallCell {
  std::optional<double> measured, error;
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
  bool relative = true;         ///< how errors are told
  std::vector<WallCell> cells;  ///< one a subject
};

struct WallResult {
  std::string name, title, question, file;
  std::vector<WallScene> scenes;
  std::vector<SubjectInfo> subjects;
  std::vector<WallLine> lines;        ///< scenes in order, their truths in order
  std::vector<std::string> warnings;  ///< the plan's
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

/// The file that a Scene of a Wall means, as an Include would name it.
std::string scene_file(const language::Object& scene);
/// The plan of `wall`, an object of `root`. Nothing when `diagnostics` got an error: a scene that
/// is not there, has no Expect, or that no subject covers. A run whose step is above its law's
/// stability bound gets a warning. Every run's scene is loaded here.
std::optional<WallPlan> make_wall_plan(const language::Object& root, const language::Object& wall,
                                       const std::string& file, language::Library& library,
                                       const PlanOptions& options,
                                       language::Diagnostics& diagnostics);

/// A run of the Wall as a study's row, before it has run: its scene's index is what varies.
RunResult empty_wall_row(const RowPlan& row);

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
void write_wall_files(const WallRun& run, const WallPlan& plan, const Provenance& provenance);

}  // namespace hookpoint::studies
