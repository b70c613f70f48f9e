// The files of a tuning's folder.
#pragma once

#include <string>
#include <vector>

#include "output/files/csv.h"
#include "studies/report/report.h"
#include "studies/tune/tune.h"

namespace hookpoint::studies {

/// The names of all that a tuning may leave, the store too.
std::vector<std::string> tune_files(const TunePlan& plan);

/// Every candidate in order: stage, generation, constants, whether it meets the requirements; of
/// each metric mean, standard error and the seeds' values; of each objective with a target the
/// distance from it and its standard error; and what became of its runs.
output::CsvTable evaluations_table(const TunePlan& plan, const TuneResult& result);
/// The Pareto set: number of the evaluation, constants, objectives (of one with a target the metric
/// and its distance), and which is recommended.
output::CsvTable pareto_table(const TunePlan& plan, const TuneResult& result);
/// Sobol's indices with their 95 % intervals: a row an objective and constant.
output::CsvTable indices_table(const TunePlan& plan, const TuneResult& result);
/// recommended.json.
std::string recommended_json(const TunePlan& plan, const TuneResult& result);
/// materials/NAME_tuned.hook: the Material with the recommended constants. `command` makes it.
std::string material_text(const TunePlan& plan, const TuneResult& result,
                          const std::string& command);

/// "materials/clay_tuned.hook".
std::string material_file(const TunePlan& plan);

/// Writes all of them, figures and report.html too, and the folder's list of them. Returns the
/// figures. Throws output::FileError.
std::vector<ReportFigure> write_tuning(output::ResultFolder& folder, const TunePlan& plan,
                                       const TuneRun& run, const std::string& command);

/// What a candidate sets in the scene; nothing for the files' own constants.
std::vector<ConstantSetting> settings_of(const TunePlan& plan, const Candidate& candidate);

/// "better", "worse", "within the noise", "not decided".
std::string_view words_of(ObjectiveComparison::Verdict verdict);

}  // namespace hookpoint::studies
