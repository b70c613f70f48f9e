// Subjects of a calibration that judged nothing, with the reason of each.
#pragma once

#include <vector>

#include "studies/calibrate/calibration.h"
#include "studies/results/idleness.h"

namespace hookpoint::studies {

/// Subjects without a fit, subjects of which no constant changes a trace (no fault where every
/// trace may be empty), and folds without an error. A subject that cannot run here is left out; it
/// is a fault if no other has a fit.
std::vector<IdleBlock> idle_blocks(const CalibrationPlan& plan, const CalibrationResult& result);

}  // namespace hookpoint::studies
