// Intervals of the fitted constants: from a bootstrap, from profiles, and from points that explain
// the data as well.
#pragma once

#include <vector>

#include "studies/calibrate/profile.h"
#include "studies/calibrate/subject_fit.h"

namespace hookpoint::studies {

/// Sets intervals, correlations and reasons of `fit.result`. `points`: those of the bootstrap;
/// `ends`: of each constant's profile, lower and upper, or none; `as_good`: points that explain the
/// data as well; `tail`: part of the bootstrap beyond either end of an interval.
void find_intervals(SubjectFit& fit, const std::vector<UnitPoint>& points,
                    const std::vector<ProfileEnd>& ends, const std::vector<UnitPoint>& as_good,
                    double tail);

}  // namespace hookpoint::studies
