// The rows of a plan as cached runs: what each is measured for, how it is made, and what the store
// has of it, read one at a time: all at once do not fit into memory.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/plan/plan.h"
#include "studies/results/result.h"
#include "studies/run/runs.h"

namespace hookpoint::studies {

/// What the row of the plan is measured for; timing is not.
Measurement measurement_of(const StudyPlan& plan, const RowPlan& row);

/// The row's run for another process; nothing where no engine runs it.
std::optional<RunRequest> request_of(const StudyPlan& plan, const EngineTable& engines,
                                     const RowPlan& row, const std::string& identity);

/// The run_identity of each row.
std::vector<std::string> run_identities(const StudyPlan& plan, const EngineTable& engines);

class StudyRows {
 public:
  /// `plan` and `engines` outlive it. The store stays open as long as a trace may be read.
  StudyRows(const StudyPlan& plan, const EngineTable& engines, std::shared_ptr<RunStore> store);

  const std::vector<std::string>& identities() const { return identities_; }
  /// All rows. The rows and `stop` outlive it.
  RunBatch batch(const std::atomic<bool>& stop) const;
  /// Of the row's timing: of this study alone.
  std::string timing_identity(std::size_t row) const;

  /// Throws StoreError when the row is not there or damaged, as do all here. With what was timed.
  RunRecord numbers(std::size_t row) const;
  RecordedTrace trace(std::size_t row, std::size_t plot) const;
  std::vector<Vector3d> path(std::size_t row) const;

 private:
  const StudyPlan& plan_;
  const EngineTable& engines_;
  std::shared_ptr<RunStore> store_;
  std::vector<std::string> identities_;
};

}  // namespace hookpoint::studies
