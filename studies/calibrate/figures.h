// The figures of a calibration: what was measured, and what each subject makes of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/calibrate/calibration.h"
#include "studies/report/report.h"

namespace hookpoint::studies {

/// Traces that are drawn; curves.csv has them all.
inline constexpr std::size_t most_trace_figures = 12;

/// Names of the figures that a plan may have, without extensions: two a trace, the curve and what
/// is left of it.
std::vector<std::string> calibration_figure_names(const CalibrationPlan& plan);

/// Draws the first traces, with every subject that has a fit, into `folder`. Throws
/// output::FileError.
std::vector<ReportFigure> draw_calibration_figures(const CalibrationPlan& plan,
                                                   const CalibrationResult& result,
                                                   const std::filesystem::path& folder);

}  // namespace hookpoint::studies
