// A calibration for readers: report.html and the terminal's text.
#pragma once

#include <string>
#include <vector>

#include "studies/calibrate/calibration.h"
#include "studies/report/report.h"

namespace hookpoint::studies {

/// The page. Pure: the same arguments give the same bytes.
std::string calibration_html(const CalibrationPlan& plan, const CalibrationResult& result,
                             const ReportContext& context,
                             const std::vector<ReportFigure>& figures);

/// A few lines a subject.
std::string calibration_terminal_text(const CalibrationPlan& plan, const CalibrationResult& result);

}  // namespace hookpoint::studies
