// The tables of the report, as HTML.
#pragma once

#include <string>

#include "studies/result.h"
#include "studies/summary.h"

namespace hookpoint::studies {

/// Subjects by metrics: the worst measurement beside its closed form and the verdicts; median and
/// range where there is none.
std::string summary_table(const StudyResult& study, const StudySummary& summary);

/// Verdicts that do not hold and runs that stopped, the first forty; "" when there are none.
std::string failure_table(const StudyResult& study);

/// Every run as a row. Above 5000 rows only those that failed or stopped, and a line that says so.
std::string runs_table(const StudyResult& study);

}  // namespace hookpoint::studies
