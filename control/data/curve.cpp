// The cubic in each interval is the Hermite cubic of the values and slopes at its two ends. The
// slope at a point is that of the polynomial through the point and its two neighbours on either
// side (fewer in a short table, other neighbours at its ends), so data that lie on a cubic are
// reproduced exactly, and a changed row changes the curve only near it.
#include "control/data/curve.h"

#include <algorithm>
#include <array>

#include "control/data/table.h"

namespace hookpoint::control {
namespace {

/// Derivative at t[0] of the polynomial through the first `count` points (t, y): the sum of (y_j -
/// y_0) l_j'(t_0), with the Lagrange polynomials' l_j'(t_0) = prod_{m != 0,j} (t_0 - t_m)/(t_j -
/// t_m) / (t_j - t_0).
double derivative_at_first(const std::array<double, 5>& t, const std::array<double, 5>& y,
                           std::size_t count) {
  double derivative = 0.;
  for (std::size_t j = 1; j < count; ++j) {
    double weight = 1. / (t[j] - t[0]);
    for (std::size_t m = 1; m < count; ++m) {
      if (m != j) weight *= (t[0] - t[m]) / (t[j] - t[m]);
    }
    derivative += weight * (y[j] - y[0]);
  }
  return derivative;
}

}  // namespace

Curve::Curve(std::vector<double> time, std::vector<double> value, Shape shape, bool closed)
    : time_(std::move(time)), value_(std::move(value)) {
  if (shape == Shape::linear || time_.size() < 2) return;
  for (std::size_t i = 0; i < time_.size(); ++i) slope_.push_back(slope_at(i, closed));
}

double Curve::slope_at(std::size_t point, bool closed) const {
  const auto points = static_cast<std::ptrdiff_t>(time_.size());
  const auto here = static_cast<std::ptrdiff_t>(point);
  const std::ptrdiff_t count = std::min<std::ptrdiff_t>(5, points);
  // A closed curve has points - 1 different ones a round, of this duration.
  const std::ptrdiff_t round = points - 1;
  const double duration = time_.back() - time_.front();
  const std::ptrdiff_t begin =
      closed ? here - count / 2 : std::clamp<std::ptrdiff_t>(here - count / 2, 0, points - count);
  std::array<double, 5> t{time_[point]}, y{value_[point]};
  std::size_t used = 1;
  for (std::ptrdiff_t i = begin; i < begin + count; ++i) {
    if (i == here) continue;
    const std::ptrdiff_t turns = i < 0 ? -1 : i >= points ? 1 : 0;
    const std::ptrdiff_t index = i - turns * round;
    t[used] = time_[index] + static_cast<double>(turns) * duration;
    y[used++] = value_[index];
  }
  return derivative_at_first(t, y, used);
}

Curve::Sample Curve::at(double time) const {
  const std::size_t i = row_at(time_, time);
  if (time < time_.front() || i + 1 == time_.size()) return {value_[i], 0.};
  const double h = time_[i + 1] - time_[i];
  const double s = (time - time_[i]) / h;
  const double rise = value_[i + 1] - value_[i];
  if (slope_.empty()) return {value_[i] + s * rise, rise / h};
  // p(s) = y0 + s (d0 + s (3 rise - 2 d0 - d1 + s (d0 + d1 - 2 rise))) with d = h slope, so p(1) =
  // y1, p'(0) = d0, p'(1) = d1.
  const double d0 = h * slope_[i], d1 = h * slope_[i + 1];
  const double quadratic = 3. * rise - 2. * d0 - d1, cubic = d0 + d1 - 2. * rise;
  return {value_[i] + s * (d0 + s * (quadratic + s * cubic)),
          (d0 + s * (2. * quadratic + s * 3. * cubic)) / h};
}

}  // namespace hookpoint::control
