// From outcomes to the table: predictions beside measurements, Truths judged.
#pragma once

#include <vector>

#include "studies/plan/plan.h"
#include "studies/run/execute.h"

namespace hookpoint::studies {

/// The table of `plan` with no row run: each with its swept values and its subject, and nothing
/// measured.
StudyResult empty_table(const StudyPlan& plan);

/// A row by itself, with the verdicts of the Truths that look at no other.
RunResult assemble_row(const StudyPlan& plan, const EngineTable& engines, std::size_t row,
                       const RowOutcome& outcome);

/// The table of `plan` from one outcome a row. Depends on the outcomes alone, not on the order in
/// which they came.
StudyResult assemble(const StudyPlan& plan, const EngineTable& engines,
                     const std::vector<RowOutcome>& outcomes);

/// Every Truth holds and no run failed: what exit status 0 means. Skipped rows neither pass nor
/// fail.
bool all_truths_hold(const StudyResult& result);

}  // namespace hookpoint::studies
