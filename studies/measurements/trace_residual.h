// How far a model is from a sample of a trace, and back. Of an orientation that is a rotation: the
// vector of the one that turns the measured into the model's.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "studies/measurements/trace_plan.h"

namespace hookpoint::studies {

// A trace's residuals are curve after curve: all samples of x, then of y, then of z.

/// Sets a sample's residuals among those of its trace: weight times (model less measured), `model`
/// one value a part of the port, in SI. Of an orientation weight times the rotation vector in world
/// axes [rad], of the shorter way round.
void set_residuals(const TracePlan& trace, std::size_t sample, std::span<const double> model,
                   std::span<double> residuals);

/// The residuals of a trace, which begin at `first` among those of all cases; empty where the run
/// has none.
std::span<const double> residuals_of(std::span<const double> all, const TracePlan& trace,
                                     std::size_t first);

/// What the model had at a sample, one value a part, in the port's unit, from the trace's
/// residuals; of an orientation the quaternion on the measured one's side.
std::vector<double> modelled(const TracePlan& trace, std::size_t sample,
                             std::span<const double> residuals);

/// What was measured there, in the port's unit.
std::vector<double> measured(const TracePlan& trace, std::size_t sample);

/// The residuals' length at a sample of their trace.
double distance(const TracePlan& trace, std::size_t sample, std::span<const double> residuals);

/// Mean over the traces of a case of the mean over their samples of the residuals' lengths: the
/// weighted distance of model and measurement. `residuals` of all of them.
double mean_distance(std::span<const TracePlan> traces, std::span<const double> residuals);

}  // namespace hookpoint::studies
