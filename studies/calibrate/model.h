// A subject as a function: constants in, weighted differences from what was measured out.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/calibrate/problem.h"

namespace hookpoint::studies {

/// `stop` was set in the middle of a run.
struct CalibrationInterrupted {};

class CalibrationModel {
 public:
  /// All outlives it.
  CalibrationModel(const CalibrationPlan& plan, const CalibrationSubject& subject,
                   const EngineTable& engines, const std::atomic<bool>& stop)
      : plan_(plan), subject_(subject), engines_(engines), stop_(stop) {}

  /// Weight times (model less measured) of every sample of these cases, one after the other, with
  /// `values` in the units of the subject's constants; between two steps a port lies on the line
  /// that joins them. Nothing where a run cannot be made or breaks off: then `why` says it. From
  /// any thread. Throws CalibrationInterrupted.
  std::optional<Residuals> residuals(std::span<const ConstantSetting> constants,
                                     std::span<const std::size_t> cases,
                                     std::string* why = nullptr) const;

  /// The settings of the subject's constants at a place of their box.
  std::vector<ConstantSetting> settings_at(const Shares& place) const;

 private:
  bool add_case(std::span<const ConstantSetting> constants, const CalibrationCase& one,
                Residuals& residuals, std::string& why) const;

  const CalibrationPlan& plan_;
  const CalibrationSubject& subject_;
  const EngineTable& engines_;
  const std::atomic<bool>& stop_;
};

}  // namespace hookpoint::studies
