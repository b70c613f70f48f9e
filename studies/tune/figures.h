// The figures of a tuning.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/report/report.h"
#include "studies/tune/tune.h"

namespace hookpoint::studies {

/// Names of the figures that a plan may have, without extensions.
std::vector<std::string> tune_figure_names(const TunePlan& plan);

/// Draws those of which something is known into `folder`: the Pareto front (of the first objective
/// with each other one), how the search converged, one constant at a time, Sobol's indices, and the
/// depth of the feet over time with each set. Throws output::FileError.
std::vector<ReportFigure> draw_tune_figures(const TunePlan& plan, const TuneResult& result,
                                            const std::filesystem::path& folder);

}  // namespace hookpoint::studies
