#include "contact/impulse/friction_discs.h"

#include <algorithm>
#include <cmath>

#include "contact/impulse/dense_factors.h"

namespace hookpoint::contact {
namespace {

// Of a damper, over the point's mass 1/A: higher takes fewer passes, and magnifies rounding of the slip.
constexpr double stiffness_share = 1e4;
// Points that are redundant but for a hair need more than the two or three passes of others.
constexpr int most_passes = 12;
constexpr double good_enough = 1e6;    // slip that the last pass may leave, over that which is none
constexpr int most_newton_steps = 50;  // of Newton's method, of a pass
constexpr double last_step = 30.;      // change of slip by the last step, over that which is none
constexpr double flat_slope = 0.1;     // share of a line's first slope that is its minimum
constexpr int most_line_trials = 40;   // of a length along a line
constexpr double longest_stretch = 8.;   // of a length, over the one before
constexpr double narrow_bracket = 1e-6;  // width of a bracket, of the length

}  // namespace

FrictionDiscs::FrictionDiscs(std::size_t most)
    : A_(4 * most * most),
      radius_(most),
      stiffness_(most),
      f_(2 * most),
      center_(2 * most),
      slip_(2 * most),
      answer_(2 * most),
      yield_(3 * most),
      outward_(2 * most),
      jacobian_(4 * most * most),
      pivot_(2 * most),
      change_(2 * most),
      slip_change_(2 * most) {
  live_.reserve(most);
}

// A_ and stiffness_ of the points of live_.
void FrictionDiscs::take(std::span<const double> A, std::size_t stride) {
  const std::size_t n = unknowns();
  for (std::size_t a = 0; a < n; ++a) {
    const std::size_t row = (2 * live_[a / 2] + a % 2) * stride;
    for (std::size_t b = 0; b < n; ++b) A_[a * n + b] = A[row + 2 * live_[b / 2] + b % 2];
  }
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const std::size_t i = 2 * k;
    stiffness_[k] = 2. * stiffness_share / (A_[i * n + i] + A_[(i + 1) * n + i + 1]);
  }
}

// Fills answer_, yield_ and outward_ for the slip at `length` along the line.
void FrictionDiscs::damp(double length) {
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const std::size_t i = 2 * k;
    const double stiffness = stiffness_[k], radius = radius_[k];
    const double x = center_[i] - stiffness * (slip_[i] + length * slip_change_[i]);
    const double y = center_[i + 1] - stiffness * (slip_[i + 1] + length * slip_change_[i + 1]);
    const double size = std::sqrt(x * x + y * y);
    double* const yield = &yield_[3 * k];
    if (size <= radius && radius > 0.) {
      answer_[i] = x;
      answer_[i + 1] = y;
      yield[0] = yield[2] = stiffness;
      yield[1] = outward_[i] = outward_[i + 1] = 0.;
    } else {
      const double per_size = size > 0. ? 1. / size : 0.;
      const double c = x * per_size, s = y * per_size, share = stiffness * radius * per_size;
      answer_[i] = radius * c;
      answer_[i + 1] = radius * s;
      outward_[i] = c;
      outward_[i + 1] = s;
      yield[0] = share * s * s;
      yield[1] = -share * c * s;
      yield[2] = share * c * c;
    }
  }
}

// Derivative of the pass's function along the line, from the answer there.
double FrictionDiscs::slope(double length) const {
  double sum = 0.;
  for (std::size_t i = 0; i < unknowns(); ++i)
    sum += slip_change_[i] * (f_[i] + length * change_[i] - answer_[i]);
  return sum;
}

// Its second derivative.
double FrictionDiscs::curvature() const {
  double sum = 0.;
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const std::size_t i = 2 * k;
    const double x = slip_change_[i], y = slip_change_[i + 1];
    const double* const yield = &yield_[3 * k];
    sum += x * change_[i] + y * change_[i + 1] + yield[0] * x * x + 2. * yield[1] * x * y +
           yield[2] * y * y;
  }
  return sum;
}

// 1 + D A in triangular factors, D the derivative of the answer: always regular.
bool FrictionDiscs::linearise() {
  const std::size_t n = unknowns();
  for (std::size_t k = 0; k < live_.size(); ++k) {
    const std::size_t i = 2 * k;
    const double xx = yield_[3 * k], xy = yield_[3 * k + 1], yy = yield_[3 * k + 2];
    double* const first = &jacobian_[i * n];
    double* const second = first + n;
    for (std::size_t j = 0; j < n; ++j) {
      const double along = A_[i * n + j], across = A_[(i + 1) * n + j];
      first[j] = xx * along + xy * across;
      second[j] = xy * along + yy * across;
    }
    first[i] += 1.;
    second[i + 1] += 1.;
  }
  return factorise_dense(std::span(jacobian_).first(n * n), std::span(pivot_).first(n));
}

void FrictionDiscs::solve_change(std::span<double> x) const {
  solve_dense(jacobian_, std::span(pivot_).first(x.size()), x);
}

// One pass: the gradient A (f - answer) to nothing, f_ and slip_ on the way.
bool FrictionDiscs::minimise(double slip_rounding) {
  const std::size_t n = unknowns();
  const std::span<double> change = std::span(change_).first(n);
  for (int step = 0; step < most_newton_steps; ++step) {
    damp(0.);
    for (std::size_t i = 0; i < n; ++i) change[i] = answer_[i] - f_[i];
    double gradient = 0., largest = 0.;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.;
      for (std::size_t j = 0; j < n; ++j) sum += A_[i * n + j] * change[j];
      gradient = std::max(gradient, std::abs(sum));
    }
    if (gradient <= slip_rounding) return true;
    if (!linearise()) return false;
    solve_change(change);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.;
      for (std::size_t j = 0; j < n; ++j) sum += A_[i * n + j] * change[j];
      slip_change_[i] = sum;
      largest = std::max(largest, std::abs(sum));
    }
    const bool last = largest <= last_step * slip_rounding;
    // The minimum along the line, where its slope rises through 0: Newton's method in a bracket.
    const double first = last ? 0. : slope(0.);
    double low = 0., high = 0., length = 1.;
    for (int trial = 0; !last && trial < most_line_trials; ++trial) {
      damp(length);
      const double here = slope(length);
      if (std::abs(here) <= -flat_slope * first) break;
      (here < 0. ? low : high) = length;
      if (high > 0. && high - low <= narrow_bracket * high) break;
      const double next = length - here / curvature();
      if (next > low && (high == 0. || next < high))
        length = std::min(next, longest_stretch * length);
      else
        length = high == 0. ? 2. * length : 0.5 * (low + high);
    }
    for (std::size_t i = 0; i < n; ++i) {
      f_[i] += length * change[i];
      slip_[i] += length * slip_change_[i];
      slip_change_[i] = 0.;
    }
    if (!last) continue;
    damp(0.);
    return true;
  }
  return false;
}

bool FrictionDiscs::find(std::span<const double> A, std::size_t stride, std::span<const double> u,
                         std::span<const double> radius, std::span<double> f,
                         double slip_rounding) {
  live_.clear();
  for (std::size_t k = 0; k < radius.size(); ++k) {
    if (!(radius[k] > 0.)) {
      f[2 * k] = f[2 * k + 1] = 0.;
      continue;
    }
    // The guess, in its disc.
    const std::size_t i = 2 * live_.size();
    const double length = std::hypot(f[2 * k], f[2 * k + 1]);
    const double share = length > radius[k] ? radius[k] / length : 1.;
    f_[i] = share * f[2 * k];
    f_[i + 1] = share * f[2 * k + 1];
    radius_[live_.size()] = radius[k];
    live_.push_back(k);
  }
  take(A, stride);
  const std::size_t n = unknowns();
  double left = 0.;
  for (int pass = 0; pass < most_passes; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = u[2 * live_[i / 2] + i % 2];
      for (std::size_t j = 0; j < n; ++j) sum += A_[i * n + j] * f_[j];
      slip_[i] = sum;
      slip_change_[i] = 0.;
      center_[i] = f_[i];
    }
    if (!minimise(slip_rounding)) return false;
    // The dampers' answer is inside the discs.
    left = 0.;
    for (std::size_t i = 0; i < n; ++i) {
      f_[i] = answer_[i];
      left = std::max(left, std::abs(f_[i] - center_[i]) / stiffness_[i / 2]);
    }
    if (left <= slip_rounding) break;
  }
  for (std::size_t i = 0; i < n; ++i) f[2 * live_[i / 2] + i % 2] = f_[i];
  return left <= good_enough * slip_rounding;
}

bool FrictionDiscs::begin_response(std::span<const double> A, std::size_t stride,
                                   std::span<const double> after, std::span<const double> radius,
                                   std::span<const double> f) {
  live_.clear();
  for (std::size_t k = 0; k < radius.size(); ++k) {
    radius_[k] = radius[k];
    live_.push_back(k);
  }
  take(A, stride);
  std::copy(f.begin(), f.end(), center_.begin());
  std::copy(after.begin(), after.end(), slip_.begin());
  std::fill_n(slip_change_.begin(), unknowns(), 0.);
  damp(0.);
  return linearise();
}

void FrictionDiscs::respond(std::span<const double> slip, std::span<const double> radius,
                            std::span<double> f) const {
  for (std::size_t k = 0; k < radius.size(); ++k) {
    const std::size_t i = 2 * k;
    const double xx = yield_[3 * k], xy = yield_[3 * k + 1], yy = yield_[3 * k + 2];
    f[i] = radius[k] * outward_[i] - xx * slip[i] - xy * slip[i + 1];
    f[i + 1] = radius[k] * outward_[i + 1] - xy * slip[i] - yy * slip[i + 1];
  }
  solve_change(f);
}

}  // namespace hookpoint::contact
