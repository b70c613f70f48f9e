// A method of a calibration: how the optimum, the intervals and the folds are found. A method is a
// row in a file of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "studies/calibrate/subject_fit.h"

namespace hookpoint::studies {

class CalibrationMethod {
 public:
  virtual ~CalibrationMethod() = default;

  /// Error of these cases by their residuals; nothing where runs are missing that it needs.
  virtual std::optional<double> error_over(const Cases& cases,
                                           const Residuals& residuals) const = 0;
  /// Finds the optimum. False where no point has a value: then the result's status says why.
  virtual bool search() = 0;
  /// Finds the constants' intervals about the optimum.
  virtual void intervals() = 0;
  /// Cross-validates: each part of the cases by constants that were fitted without it.
  virtual void folds() = 0;
};

struct MethodDefinition {
  /// Rows of the store that it requests at most for a subject of so many constants.
  std::size_t (*rows)(const CalibrationPlan& plan, std::size_t constants);
  std::unique_ptr<CalibrationMethod> (*make)(SubjectFit& fit);
};

extern const MethodDefinition fit_by_squares, fit_by_distance;

}  // namespace hookpoint::studies
