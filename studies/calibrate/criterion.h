// How much worse a point explains the data than the optimum of a fit does: the bound of an
// interval of 95 %. Each method of a calibration has a criterion of its own for what it makes
// least; a profile asks nothing else of a method.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "studies/calibrate/least_squares.h"

namespace hookpoint::studies {

/// Root mean squares, and mean distances, that differ by less than this part of the weight's error
/// are equal: how the numbers of a table are rounded makes more.
inline constexpr double equal_errors = 1e-6;

/// Excess of a point over the optimum by its residuals: 1 at the end of an interval.
using Excess = std::function<double(const Residuals& residuals)>;

/// Of a sum of squares S of n independent residuals and p constants: (S - least)/(s^2 t^2) with
/// s^2 = least/(n - p) and t Student's of 95 % with n - p degrees of freedom: one constant is
/// moved, and F(1, n - p) is t^2. Correlated residuals count as n/`worth`.
Excess excess_of_squares(const Residuals& at_optimum, std::size_t constants, double worth);

/// Of the mean m of what several independent things add, with `of_things` their parts at a point
/// and `at_optimum` those of the optimum: (m / (t/2 e))^2, m the mean of the differences thing by
/// thing, e its standard error, t Student's of `count` things; with the sign of m. Of correlated
/// things `worth` say as much as one.
///
/// Why t/2: beside the optimum a difference is s_i d + h_i d^2/2 with scores s_i whose mean is 0 at
/// the optimum, so m = h d^2/2 and e = s d/sqrt(n). The fitted constant's standard error is
/// s/(h sqrt(n)) whatever is made least (Huber 1967), so |d| = t s/(h sqrt(n)) is where
/// m = (t/2) e. Of squares of independent residuals it is the bound above.
struct PairedThings {
  std::vector<double> at_optimum;
  double worth = 1.;
  double count = 0.;  ///< independent things that say how large the noise is
  double equal = 0.;  ///< means that differ by less are equal
  /// One thing alone does not decide: its difference counts as twice the second largest at most
  /// (it is winsorised).
  bool limits_largest = false;
};
double paired_excess(const PairedThings& things, const std::vector<double>& parts);
/// The same with the things' scores times d, where these are known: a difference of lengths varies
/// less than its score where it is not small beside the noise, which made intervals too narrow.
double paired_excess(const PairedThings& things, const std::vector<double>& parts,
                     const std::vector<double>& scores);

}  // namespace hookpoint::studies
