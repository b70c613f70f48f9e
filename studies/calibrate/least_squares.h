// Nonlinear least squares in the unit box: Levenberg and Marquardt's method from several starts.
// What is fitted may be any function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hookpoint::studies {

/// A point in the unit box, one share of its range a constant.
using UnitPoint = std::vector<double>;
using Residuals = std::vector<double>;
/// Residuals at a point, always equally many; nothing where the model has none.
using ResidualModel = std::function<std::optional<Residuals>(const UnitPoint&)>;

/// A model at one point, and how it changes there.
struct Linearisation {
  UnitPoint point;
  Residuals residuals;
  std::vector<Residuals> derivative;  ///< by each share
};

double sum_of_squares(const Residuals& residuals);

struct FitOptions {
  double difference = 1e-5;  ///< share of its range by which a constant is moved for a derivative
  int most_steps = 100;      ///< points that are tried, those for derivatives not counted
  double tolerance = 1e-10;  ///< relative change of sum and point below which a fit ends
};

/// A point from which no step makes the sum of squares less.
struct LeastSquaresFit {
  UnitPoint point;
  double sum = 0.;         ///< of squares of the residuals
  std::size_t models = 0;  ///< points at which the model was evaluated
};

/// Derivatives by central differences, at an edge of the box and where a neighbour has no residuals
/// by one-sided ones. Nothing where the point itself has no residuals.
std::optional<Linearisation> linearise(const ResidualModel& model, const UnitPoint& point,
                                       double difference);

/// From `start`, where the model has residuals, downhill: MINPACK's Levenberg-Marquardt (Moré 1978)
/// over u with share = (1 + sin u)/2, so that no step leaves the box (James & Roos 1975). A point
/// without residuals counts as a step too far. Nothing without residuals at the start.
std::optional<LeastSquaresFit> refine(const ResidualModel& model, const UnitPoint& start,
                                      const FitOptions& options);
/// The same where the start is linearised already.
LeastSquaresFit refine(const ResidualModel& model, const Linearisation& start,
                       const FitOptions& options);

/// Where a search of the whole box begins: `first`, then `count` points of a low-discrepancy
/// sequence (Roberts' R_d) behind a random shift from `seed`.
std::vector<UnitPoint> spread_starts(std::size_t constants, std::vector<UnitPoint> first,
                                     std::size_t count, std::uint64_t seed);

/// Covariance of the fitted shares, s^2 (J^T J)^-1 with s^2 = sum/(residuals - constants), row by
/// row; nothing where a constant, or a combination of them, changes no residual, or where there are
/// not more residuals than constants.
std::optional<std::vector<std::vector<double>>> covariance(const Linearisation& fit);

/// The step from the point of `fit` to the least sum of squares of its linearised residuals; where
/// constants, or combinations of them, change no residual, the shortest such step: it leaves those
/// where they are and does not touch the others (pseudo-inverse).
UnitPoint gauss_newton_step(const Linearisation& fit);

/// What the linearised residuals say of moving one constant with the others refitted.
struct LinearProfile {
  double curvature = 0.;  ///< the sum of squares is the least one + curvature distance^2
  UnitPoint others;       ///< by how much each other constant moves with it; 0 of itself
};
LinearProfile linear_profile(const Linearisation& fit, std::size_t constant);

}  // namespace hookpoint::studies
