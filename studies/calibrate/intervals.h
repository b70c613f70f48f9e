// What profiles and bootstrap say of the constants of a fit.
#pragma once

#include <vector>

#include "studies/calibrate/profiles.h"
#include "studies/calibrate/subject_fit.h"

namespace hookpoint::studies {

/// Sets the interval of every constant, and whether the data identify it: it is not identifiable
/// where the interval spans more than half of its range or reaches an end of it, where the fit ends
/// at one, where no run has a value beyond, or where separate values explain the data.
void set_intervals(SubjectFit& fit, const Profiles& profiles);

/// Sets the correlations of the constants over the points of a bootstrap.
void set_correlations(SubjectFit& fit, const std::vector<UnitPoint>& points);

}  // namespace hookpoint::studies
