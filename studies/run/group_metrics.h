// Metrics of several runs together: over a sweep, and between subjects.
#pragma once

#include <span>
#include <vector>

#include "studies/plan/plan.h"
#include "studies/run/rows.h"

namespace hookpoint::studies {

/// Greatest distance between points of equal index of two paths [m].
double path_distance(std::span<const Vector3d> a, std::span<const Vector3d> b);

/// Greatest over least of `values`, less 1; nothing of fewer than two, or unless all are positive.
std::optional<double> spread(std::span<const double> values);

/// Fills in the metrics of scope sweep, whose rows hold each run's part so far, and of scope
/// subjects, and `result.peer_distances`.
void measure_groups(const StudyPlan& plan, const StudyRows& kept, StudyResult& result);

}  // namespace hookpoint::studies
