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

  /// Weight times (model less measured) of every sample of these cases, one after the other, at a
  /// point of the box of the subject's constants; an empty point has those of the scene itself.
  /// Between two steps a port lies on the line that joins them. Nothing where a run cannot be made
  /// or breaks off, or where residuals are too large: then `why` says it. From any thread. Throws
  /// CalibrationInterrupted.
  std::optional<Residuals> residuals(const UnitPoint& point, std::span<const std::size_t> cases,
                                     std::string* why = nullptr) const;

 private:
  /// The settings of the subject's constants that are of the scene.
  std::vector<ConstantSetting> settings_at(const UnitPoint& point) const;
  /// What the clock of a trace reads at time 0, where that is fitted; else 0, as its times are.
  double offset_at(const UnitPoint& point, const TracePlan& trace) const;
  bool add_case(const UnitPoint& point, const CalibrationCase& one, Residuals& residuals,
                std::string& why) const;

  const CalibrationPlan& plan_;
  const CalibrationSubject& subject_;
  const EngineTable& engines_;
  const std::atomic<bool>& stop_;
};

}  // namespace hookpoint::studies
