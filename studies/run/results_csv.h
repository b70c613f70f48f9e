// The files of a study's folder: tables, traces, the experiment as printed, and where it all came
// from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/files/csv.h"
#include "studies/plan/plan.h"
#include "studies/results/result.h"
#include "studies/run/provenance.h"

namespace hookpoint::studies {

/// The sweep parameters, `subject, engine, law, integrator, settings`, then each metric with its
/// `_predicted` and `_ok`, then `status`. `timing` chooses the timing metrics (timing.csv) or all
/// others (results.csv, the same bytes every time).
output::CsvTable results_table(const StudyResult& result, bool timing);

/// Folders of a study's own folder, kept from run to run: its runs where it shares no store, and
/// what goes to and fro between it and a cluster.
inline constexpr const char* store_folder = "store/";
inline constexpr const char* cluster_folder = "cluster/";

/// The names of all that a study or a Wall may leave in its folder, reports and figures too.
std::vector<std::string> study_files(const StudyPlan& plan);

/// What the results are of: experiment.hook, scene.hook where all rows have one scene, and
/// provenance.json. Throws output::FileError.
void write_origin(output::ResultFolder& folder, const StudyPlan& plan,
                  const Provenance& provenance);

/// Writes all of them into `folder`: through ResultFolder::write those that a report links to.
/// Throws output::FileError.
void write_study_files(output::ResultFolder& folder, const StudyPlan& plan,
                       const StudyResult& result, const Provenance& provenance);

}  // namespace hookpoint::studies
