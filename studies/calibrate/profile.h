// Profile of a fit: how far one constant can move before no values of the others explain the data.
// Needs no derivative at the optimum: it sees flat directions, steps, curved valleys and separate
// ones, which a linearised model does not (Venzon & Moolgavkar 1988; Raue et al. 2009). What was
// fitted may be any function, found by any search.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "studies/calibrate/least_squares.h"

namespace hookpoint::studies {

/// A fit and how well other points explain its data.
struct ProfileProblem {
  UnitPoint optimum;
  ResidualModel model;
  /// How much worse than the optimum: 0 at the optimum, 1 at the end of an interval, growing as the
  /// square of a small distance; negative of a point that is better.
  std::function<double(const Residuals& residuals)> excess{};
  /// What a refit starts from, as residuals whose sum of squares it makes less; of least squares
  /// the residuals themselves. `from`: at the refit's start.
  std::function<Residuals(const Residuals& residuals, const Residuals& from)> to_squares{};
  /// Share of each constant at which its value is 0; nothing on a logarithmic range. A product or a
  /// power of constants is a straight line over the logarithms of their values.
  std::vector<std::optional<double>> zeros{};
  /// Whether a better optimum ends the profile. If not it counts as inside.
  bool ends_where_better = true;
};

/// Bounds on the work of a profile.
struct ProfileOptions {
  FitOptions refit;              ///< of the other constants at each place
  double wide_difference;        ///< share over which a refit differentiates that is over ripples
  std::size_t most_places = 16;  ///< of the constant, one side of the optimum, to the first end
  /// Where two points, within the bound and beyond it, are closer than this part of their distance
  /// from the optimum, the end lies between them.
  double resolution = 0.05;
};

/// A greater excess than this is not what chance makes of a point that is right: 99.9 % for the
/// 95 % of an excess of 1, 3.29^2/1.96^2. Within it nothing is called identified.
inline constexpr double surely_outside = 2.82;

/// One end of a constant's interval.
struct ProfileEnd {
  double share = 0.;          ///< the constant, where the excess reaches 1
  double wide_share = 0.;     ///< of the interval of 99.9 %: the farthest share found within it
  UnitPoint point;            ///< the farthest point found that explains the data
  bool without_runs = false;  ///< the model has no residuals beyond
  std::size_t models = 0;     ///< points at which the model was evaluated
  std::optional<UnitPoint> better{};  ///< better than the optimum: the profile then ended there
  /// Not surely outside, beyond the end, in a valley of its own: no valley leads there at the
  /// places that were refitted.
  std::optional<UnitPoint> apart{};
};

/// From the optimum towards 0 (`up` false) or 1: how far `constant` can move while the others,
/// refitted, explain the data. Beyond the first end it is refitted at places all the way to the end
/// of the range, and from the best of these all constants are.
ProfileEnd profile_end(const ProfileProblem& problem, std::size_t constant, bool up,
                       const ProfileOptions& options);

/// Refits all constants from `start`; the best point found, nothing where the model has no
/// residuals there.
struct FreeRefit {
  UnitPoint point;
  double excess = 0.;
  std::size_t models = 0;
};
std::optional<FreeRefit> refit_all(const ProfileProblem& problem, const UnitPoint& start,
                                   const ProfileOptions& options);

}  // namespace hookpoint::studies
