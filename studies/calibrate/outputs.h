// The files of a calibration's folder.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/files/csv.h"
#include "studies/calibrate/calibration.h"
#include "studies/report/report.h"

namespace hookpoint::studies {

/// The names of all that a calibration may leave, its store too.
std::vector<std::string> calibration_files(const CalibrationPlan& plan);

/// A row a subject and constant: value and 95 % interval in the constant's unit, whether the data
/// identify it, and the end of its range where the fit ends there. A constant that they do not
/// identify, or that was left out, has no value but the reason.
output::CsvTable calibration_table(const CalibrationPlan& plan, const CalibrationResult& result);
output::CsvTable correlations_table(const CalibrationPlan& plan, const CalibrationResult& result);
/// Every point that was looked at or fitted, in order.
output::CsvTable fits_table(const CalibrationPlan& plan, const CalibrationResult& result);
output::CsvTable folds_table(const CalibrationPlan& plan, const CalibrationResult& result);
/// Every sample: measured, and what each subject makes of it by these residuals of it; each in its
/// port's unit.
output::CsvTable curves_table(
    const CalibrationPlan& plan, const CalibrationResult& result,
    Residuals SubjectCalibration::*residuals = &SubjectCalibration::residuals);

/// The value of a fitted constant as it is written: six digits, in its unit.
std::string value_text(const CalibrationPlan& plan, const FittedConstant& constant, double share);

/// A sentence for each subject whose fit misses its own weights, and what to try.
std::vector<std::string> misfits(const CalibrationPlan& plan, const CalibrationResult& result);

/// The subjects with their errors, misfits and constants.
std::string calibration_json(const CalibrationPlan& plan, const CalibrationResult& result);

/// "materials/surface_hunt_crossley.hook".
std::string material_file(const CalibrationPlan& plan, const CalibrationSubject& subject);
/// Its Material with the fitted constants; those that the data do not identify are named as such.
/// "" without a fit.
std::string material_text(const CalibrationPlan& plan, const CalibrationSubject& subject,
                          const SubjectCalibration& result, const std::string& command);

/// Writes all of them that there are, figures and report.html too, and the folder's list of them.
/// Returns the figures. Throws output::FileError.
std::vector<ReportFigure> write_calibration(output::ResultFolder& folder,
                                            const CalibrationPlan& plan, const CalibrationRun& run,
                                            const std::string& command);

}  // namespace hookpoint::studies
