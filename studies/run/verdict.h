// From kept runs to the table: closed forms beside measurements, Truths judged.
#pragma once

#include <vector>

#include "studies/plan/plan.h"
#include "studies/run/rows.h"
#include "studies/run/runs.h"

namespace hookpoint::studies {

/// The table of `plan` with no row run: each with its swept values and its subject, and nothing
/// measured.
StudyResult empty_table(const StudyPlan& plan);

/// A row by itself, with the verdicts of the Truths that look at no other.
RunResult assemble_row(const StudyPlan& plan, const StudyRows& kept, std::size_t row);

/// The table of `plan`. Depends on the kept runs alone, not on the order in which they came.
/// `notices` gets those of the runs.
StudyResult assemble(const StudyPlan& plan, const StudyRows& kept, Notices& notices);

/// Every Truth holds, no run failed, and no Truth, Claim, Plot or Table judges or shows nothing
/// that is not expected: what exit status 0 means. Skipped rows neither pass nor fail.
bool all_truths_hold(const StudyResult& result);

}  // namespace hookpoint::studies
