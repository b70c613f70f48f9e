#include "studies/calibrate/least_squares.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

#include "studies/search/random_point.h"

namespace hookpoint::studies {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// u of share = (1 + sin u)/2. One turn is added: MINPACK measures its first step by the size of u,
/// which is 0 in the middle of a range otherwise.
double angle_of(double share) { return std::asin(2. * share - 1.) + 2. * std::numbers::pi; }
double share_at(double angle) { return 0.5 * (1. + std::sin(angle)); }

/// At the very edge d share/d u is 0, and no step would leave it.
constexpr double edge = 1e-3;

MatrixXd matrix_of(const Linearisation& linearised) {
  MatrixXd matrix(static_cast<Index>(linearised.residuals.size()),
                  static_cast<Index>(linearised.derivative.size()));
  for (Index column = 0; column < matrix.cols(); ++column) {
    const Residuals& values = linearised.derivative[static_cast<std::size_t>(column)];
    matrix.col(column) = VectorXd::Map(values.data(), matrix.rows());
  }
  return matrix;
}

/// What Eigen's solver asks of a problem.
class BoundedProblem {
 public:
  BoundedProblem(const ResidualModel& model, const Linearisation& start, const FitOptions& options)
      : model_(model), start_(start), options_(options) {
    start_angles_ = angles_of(start.point);
    // Longer than the residuals at the start, so never taken.
    too_far_ =
        10. * std::sqrt(sum_of_squares(start.residuals) /
                        static_cast<double>(std::max<std::size_t>(1, start.residuals.size()))) +
        1.;
  }

  int inputs() const { return static_cast<int>(start_.point.size()); }
  int values() const { return static_cast<int>(start_.residuals.size()); }

  int operator()(const VectorXd& angles, VectorXd& residuals) {
    const auto found =
        angles == start_angles_ ? std::optional(start_.residuals) : ask(shares_of(angles));
    if (found)
      residuals = VectorXd::Map(found->data(), values());
    else
      residuals.setConstant(too_far_);
    return 0;
  }

  int df(const VectorXd& angles, MatrixXd& derivative) {
    const auto found = angles == start_angles_
                           ? std::optional(start_)
                           : linearise([this](const UnitPoint& point) { return ask(point); },
                                       shares_of(angles), options_.difference);
    if (!found) return -1;  // ends the search at this point
    derivative = matrix_of(*found);
    for (Index i = 0; i < derivative.cols(); ++i) derivative.col(i) *= 0.5 * std::cos(angles[i]);
    return 0;
  }

  static VectorXd angles_of(const UnitPoint& shares) {
    VectorXd angles(static_cast<Index>(shares.size()));
    for (Index i = 0; i < angles.size(); ++i)
      angles[i] = angle_of(shares[static_cast<std::size_t>(i)]);
    return angles;
  }
  static UnitPoint shares_of(const VectorXd& angles) {
    UnitPoint shares;
    for (const double angle : angles) shares.push_back(share_at(angle));
    return shares;
  }
  std::size_t models() const { return models_; }

 private:
  std::optional<Residuals> ask(const UnitPoint& point) {
    ++models_;
    return model_(point);
  }

  const ResidualModel& model_;
  const Linearisation& start_;
  const FitOptions& options_;
  VectorXd start_angles_;
  double too_far_ = 0.;
  std::size_t models_ = 0;
};

/// Within the box, and off its edges.
UnitPoint off_the_edges(UnitPoint point) {
  for (double& share : point) share = std::clamp(share, edge, 1. - edge);
  return point;
}

}  // namespace

double sum_of_squares(const Residuals& residuals) {
  double sum = 0.;
  for (const double residual : residuals) sum += residual * residual;
  return sum;
}

std::optional<Linearisation> linearise(const ResidualModel& model, const UnitPoint& point,
                                       double difference) {
  Linearisation result{point, {}, {}};
  auto here = model(point);
  if (!here) return std::nullopt;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const auto neighbour = [&](double share) -> std::optional<Residuals> {
      UnitPoint moved = point;
      moved[i] = share;
      return share < 0. || share > 1. ? std::nullopt : model(moved);
    };
    const double below = point[i] - difference, above = point[i] + difference;
    const auto less = neighbour(below), more = neighbour(above);
    const Residuals& left = less ? *less : *here;
    const Residuals& right = more ? *more : *here;
    const double width = (more ? above : point[i]) - (less ? below : point[i]);
    Residuals& column = result.derivative.emplace_back(here->size(), 0.);
    if (width > 0.)
      for (std::size_t j = 0; j < column.size(); ++j) column[j] = (right[j] - left[j]) / width;
  }
  result.residuals = std::move(*here);
  return result;
}

LeastSquaresFit refine(const ResidualModel& model, const Linearisation& start,
                       const FitOptions& options) {
  BoundedProblem problem(model, start, options);
  Eigen::LevenbergMarquardt<BoundedProblem> solver(problem);
  solver.parameters.factor = 0.1;  // a first step of at most a tenth of u, which is about 2 pi
  solver.parameters.maxfev = options.most_steps;
  solver.parameters.ftol = options.tolerance;
  solver.parameters.xtol = options.tolerance;
  VectorXd angles = BoundedProblem::angles_of(start.point);
  solver.minimize(angles);
  LeastSquaresFit fit{BoundedProblem::shares_of(angles), solver.fnorm * solver.fnorm,
                      problem.models()};
  if (fit.sum <= sum_of_squares(start.residuals)) return fit;
  return {start.point, sum_of_squares(start.residuals), problem.models()};
}

std::optional<LeastSquaresFit> refine(const ResidualModel& model, const UnitPoint& start,
                                      const FitOptions& options) {
  const auto linearised = linearise(model, off_the_edges(start), options.difference);
  if (!linearised) return std::nullopt;
  LeastSquaresFit fit = refine(model, *linearised, options);
  fit.models += 1 + 2 * start.size();
  return fit;
}

std::vector<UnitPoint> spread_starts(std::size_t constants, std::vector<UnitPoint> first,
                                     std::size_t count, std::uint64_t seed) {
  // The positive root g of g^(d+1) = g + 1: the golden ratio of d dimensions. Point n is frac(shift
  // + n (1/g, 1/g^2, ...)) (M. Roberts, "The unreasonable effectiveness of quasirandom sequences",
  // 2018).
  double ratio = 2.;
  for (int i = 0; i < 60; ++i)
    ratio = std::pow(1. + ratio, 1. / (static_cast<double>(constants) + 1.));
  std::mt19937_64 random(seed);
  UnitPoint shift(constants);
  for (double& part : shift) part = random_point(random);
  for (std::size_t n = 1; n <= count; ++n) {
    UnitPoint& point = first.emplace_back(constants);
    for (std::size_t i = 0; i < constants; ++i) {
      const double unwrapped =
          shift[i] + static_cast<double>(n) * std::pow(ratio, -static_cast<double>(i + 1));
      point[i] = unwrapped - std::floor(unwrapped);
    }
  }
  return first;
}

std::optional<std::vector<std::vector<double>>> covariance(const Linearisation& fit) {
  const MatrixXd derivative = matrix_of(fit);
  const Eigen::ColPivHouseholderQR<MatrixXd> factors(derivative);
  const Index constants = derivative.cols();
  if (derivative.rows() <= constants || factors.rank() < constants) return std::nullopt;
  // J P = Q R, so (J^T J)^-1 = P R^-1 R^-T P^T.
  const MatrixXd inverse = factors.matrixR()
                               .topLeftCorner(constants, constants)
                               .triangularView<Eigen::Upper>()
                               .solve(MatrixXd::Identity(constants, constants));
  const MatrixXd turned = factors.colsPermutation() * inverse;
  const double variance =
      sum_of_squares(fit.residuals) / static_cast<double>(derivative.rows() - constants);
  const MatrixXd product = variance * turned * turned.transpose();
  std::vector<std::vector<double>> result;
  for (Index row = 0; row < constants; ++row) {
    std::vector<double>& values = result.emplace_back();
    for (Index column = 0; column < constants; ++column) values.push_back(product(row, column));
  }
  return result;
}

UnitPoint gauss_newton_step(const Linearisation& fit) {
  const MatrixXd derivative = matrix_of(fit);
  const VectorXd step = derivative.completeOrthogonalDecomposition().solve(
      -VectorXd::Map(fit.residuals.data(), derivative.rows()));
  return {step.begin(), step.end()};
}

LinearProfile linear_profile(const Linearisation& fit, std::size_t constant) {
  const auto rows = static_cast<Index>(fit.residuals.size());
  const std::size_t count = fit.point.size();
  const MatrixXd derivative = matrix_of(fit);
  LinearProfile linear{0., UnitPoint(count, 0.)};
  VectorXd rest = derivative.col(static_cast<Index>(constant));
  if (count > 1) {
    MatrixXd others(rows, static_cast<Index>(count) - 1);
    Index at = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (i != constant) others.col(at++) = derivative.col(static_cast<Index>(i));
    const VectorXd moved = others.completeOrthogonalDecomposition().solve(-rest);
    rest += others * moved;
    at = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (i != constant) linear.others[i] = moved(at++);
  }
  linear.curvature = rest.squaredNorm();
  return linear;
}

}  // namespace hookpoint::studies
