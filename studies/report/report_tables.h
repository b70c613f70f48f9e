// The tables of the report, as HTML.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/results/idleness.h"
#include "studies/results/result.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {

/// The subject's marker in its colour, as in the figures. `subject_style`: of `subject_styles`.
std::string swatch(int subject_style);

/// Subjects by some metrics of one regime: the worst measurement beside its closed form and the
/// verdicts; median and range where there is none.
std::string summary_table(const StudyResult& study, const RegimeTable& table,
                          const std::vector<std::size_t>& metrics);

/// The metrics of `table` in portions that fit the page's width side by side.
std::vector<std::vector<std::size_t>> page_portions(const StudyResult& study,
                                                    const RegimeTable& table);

/// Each Truth in words with how many of its values agree; "" when there are none.
std::string truths_table(const StudyResult& study);

/// Verdicts of finished runs that do not hold, the first forty; "" when there are none.
std::string failure_table(const StudyResult& study);

/// Blocks that judge or show nothing, and why; "" when there are none.
std::string idle_table(const std::vector<IdleBlock>& blocks);

/// Reasons why metrics that have closed forms in other runs have none; "" when there are none.
std::string missing_forms_table(const StudyResult& study);

/// Runs that stopped on the way: where, when and why, the first forty; "" when there are none.
std::string stopped_table(const StudyResult& study);

/// Runs whose step is above the stability bound, as the plan warned of them; "" without.
std::string warning_list(const std::vector<std::string>& warnings);

/// Every run as a row. Above 5000 rows only those that failed or stopped, and a line that says so.
std::string runs_table(const StudyResult& study);

/// Versions, flags, host and date, line by line; "" when there are none.
std::string provenance_table(const std::vector<std::pair<std::string, std::string>>& lines);

}  // namespace hookpoint::studies
