// The files of a study's folder: tables, traces, the experiment as printed, and where it all came
// from.
#pragma once

#include <filesystem>

#include "output/csv.h"
#include "studies/plan.h"
#include "studies/provenance.h"
#include "studies/result.h"

namespace hookpoint::studies {

/// The sweep parameters, `subject, engine, law, integrator, settings`, then each metric with its
/// `_predicted` and `_ok`, then `status`. `timing` chooses the timing metrics (timing.csv) or all
/// others (results.csv, the same bytes every time).
output::CsvTable results_table(const StudyResult& result, bool timing);

/// Writes all of them into `folder`. Throws output::FileError.
void write_study_files(const std::filesystem::path& folder, const StudyPlan& plan,
                       const StudyResult& result, const Provenance& provenance);

}  // namespace hookpoint::studies
