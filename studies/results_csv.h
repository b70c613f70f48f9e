// The files of a study's folder: tables, traces, the experiment as printed, and where it all came
// from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/csv.h"
#include "studies/plan.h"
#include "studies/provenance.h"
#include "studies/result.h"

namespace hookpoint::studies {

/// The sweep parameters, `subject, engine, law, integrator, settings`, then each metric with its
/// `_predicted` and `_ok`, then `status`. `timing` chooses the timing metrics (timing.csv) or all
/// others (results.csv, the same bytes every time).
output::CsvTable results_table(const StudyResult& result, bool timing);

/// The names of all that a study may leave in its folder, reports and figures too, and rows/.
std::vector<std::string> study_files(const StudyPlan& plan);

/// Names of a study's own tables, which no figure may have.
const std::vector<std::string>& table_names();

/// Writes all of them into `folder`. Throws output::FileError.
void write_study_files(const std::filesystem::path& folder, const StudyPlan& plan,
                       const StudyResult& result, const Provenance& provenance);

}  // namespace hookpoint::studies
