#include "studies/calibrate/response_surface.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cstddef>
#include <numeric>

namespace hookpoint::studies {
namespace {

using Index = Eigen::Index;

constexpr std::size_t places_a_coefficient = 3;
/// How far from the middle of the points a surface is believed, in half widths of their box.
constexpr double reach = 3.;

Index signed_size(std::size_t size) { return static_cast<Index>(size); }

/// 1, u_i, and u_i u_j with i <= j.
std::size_t coefficient_count(std::size_t constants) {
  return 1 + constants + constants * (constants + 1) / 2;
}

Eigen::VectorXd terms_at(const Eigen::VectorXd& u) {
  Eigen::VectorXd terms(signed_size(coefficient_count(static_cast<std::size_t>(u.size()))));
  Index at = 0;
  terms(at++) = 1.;
  for (Index i = 0; i < u.size(); ++i) terms(at++) = u(i);
  for (Index i = 0; i < u.size(); ++i)
    for (Index j = i; j < u.size(); ++j) terms(at++) = u(i) * u(j);
  return terms;
}

double sum_of(const std::vector<double>& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.);
}

}  // namespace

std::optional<ResponseSurface> ResponseSurface::fit(std::vector<PlacedErrors> looked) {
  if (looked.empty()) return std::nullopt;
  const std::size_t constants = looked.front().point.size(), things = looked.front().errors.size();
  const std::size_t count = coefficient_count(constants);
  if (looked.size() < places_a_coefficient * count) return std::nullopt;
  std::ranges::stable_sort(looked, {}, [](const PlacedErrors& one) { return sum_of(one.errors); });
  looked.resize(places_a_coefficient * count);
  ResponseSurface surface;
  for (std::size_t i = 0; i < constants; ++i) {
    const auto [low, high] =
        std::ranges::minmax(looked, {}, [&](const PlacedErrors& one) { return one.point[i]; });
    surface.middle_.push_back(0.5 * (low.point[i] + high.point[i]));
    surface.half_width_.push_back(0.5 * (high.point[i] - low.point[i]));
    if (!(surface.half_width_.back() > 0.)) return std::nullopt;
  }
  Eigen::MatrixXd terms(signed_size(looked.size()), signed_size(count));
  Eigen::MatrixXd errors(signed_size(looked.size()), signed_size(things));
  for (std::size_t row = 0; row < looked.size(); ++row) {
    Eigen::VectorXd u(signed_size(constants));
    for (std::size_t i = 0; i < constants; ++i)
      u(signed_size(i)) = (looked[row].point[i] - surface.middle_[i]) / surface.half_width_[i];
    terms.row(signed_size(row)) = terms_at(u).transpose();
    for (std::size_t i = 0; i < things; ++i)
      errors(signed_size(row), signed_size(i)) = looked[row].errors[i];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(terms);
  if (solver.rank() < signed_size(count)) return std::nullopt;
  const Eigen::MatrixXd fitted = solver.solve(errors);
  for (Index i = 0; i < fitted.rows(); ++i) {
    std::vector<double>& row = surface.coefficients_.emplace_back();
    for (Index j = 0; j < fitted.cols(); ++j) row.push_back(fitted(i, j));
  }
  return surface;
}

std::optional<UnitPoint> ResponseSurface::least(std::span<const int> times) const {
  const Index constants = signed_size(middle_.size());
  const auto sum = [&](std::size_t coefficient) {
    const std::vector<double>& row = coefficients_[coefficient];
    return std::inner_product(row.begin(), row.end(), times.begin(), 0.);
  };
  Eigen::VectorXd slope(constants);
  Eigen::MatrixXd curvature(constants, constants);
  std::size_t at = 1;
  for (Index i = 0; i < constants; ++i) slope(i) = sum(at++);
  for (Index i = 0; i < constants; ++i)
    for (Index j = i; j < constants; ++j) {
      const double coefficient = sum(at++);
      curvature(i, j) = curvature(j, i) = i == j ? 2. * coefficient : coefficient;
    }
  const Eigen::LLT<Eigen::MatrixXd> solver(curvature);
  if (solver.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd u = solver.solve(-slope);
  UnitPoint point;
  for (std::size_t i = 0; i < middle_.size(); ++i)
    point.push_back(std::clamp(
        middle_[i] + half_width_[i] * std::clamp(u(signed_size(i)), -reach, reach), 0., 1.));
  return point;
}

}  // namespace hookpoint::studies
