// Profile of a sum of squares: how far one constant can move before no values of the others explain
// the data. Needs no derivative at the optimum: it sees flat directions, steps and combinations of
// constants that a linearised model does not (Venzon & Moolgavkar 1988; Raue et al. 2009).
#pragma once

#include <cstddef>
#include <optional>

#include "studies/calibrate/least_squares.h"

namespace hookpoint::studies {

/// Bounds on the work of a profile.
struct ProfileOptions {
  FitOptions refit;              ///< of the other constants at each point
  std::size_t most_places = 16;  ///< of the constant, one side of the optimum
  /// Where two points, within the bound and beyond it, are closer than this part of their distance
  /// from the optimum, the end lies between them.
  double resolution = 0.05;
};

/// One end of a constant's interval.
struct ProfileEnd {
  double share = 0.;  ///< the constant, where the sum of squares reaches the bound
  /// The farthest point found at which the sum is within the bound.
  UnitPoint point;
  double sum = 0.;            ///< of squares there
  bool without_runs = false;  ///< the model has no residuals beyond
  std::size_t models = 0;     ///< points at which the model was evaluated
  /// A point whose sum is less than the optimum's by a part of the bound: the search then ended
  /// there.
  std::optional<LeastSquaresFit> better{};
};

/// From the optimum `fit` towards 0 (`up` false) or 1: how far `constant` can move while the least
/// sum of squares over the other constants stays within `bound`, which is greater than the
/// optimum's. At least the first crossing; a point beyond a barrier is found if a step lands on it.
ProfileEnd profile_end(const ResidualModel& model, const Linearisation& fit, std::size_t constant,
                       bool up, double bound, const ProfileOptions& options);

}  // namespace hookpoint::studies
