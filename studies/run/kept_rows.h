// The rows of a plan as the store has them, read one at a time: all at once do not fit into memory.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "studies/plan/plan.h"
#include "studies/result.h"
#include "studies/run/run_store.h"

namespace hookpoint::studies {

/// The run_identity of each row.
std::vector<std::string> run_identities(const StudyPlan& plan, const EngineTable& engines);

class KeptRows {
 public:
  /// `plan` outlives it. The store stays open as long as a trace may be read.
  KeptRows(const StudyPlan& plan, const EngineTable& engines, std::shared_ptr<RunStore> store);

  const std::vector<std::string>& identities() const { return identities_; }
  /// Of the row's timing: of this study alone.
  std::string timing_identity(std::size_t row) const;

  /// Throws StoreError when the row is not there or damaged, as do all here. With what was timed.
  RunRecord numbers(std::size_t row) const;
  RecordedTrace trace(std::size_t row, std::size_t plot) const;
  std::vector<Vector3d> path(std::size_t row) const;

 private:
  const StudyPlan& plan_;
  std::shared_ptr<RunStore> store_;
  std::vector<std::string> identities_;
};

}  // namespace hookpoint::studies
