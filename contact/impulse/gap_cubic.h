// The gap of a point over a flight that has been flown, from what it was at both ends: where the
// point came through the ground in between.
#pragma once

#include <cmath>

#include "math/bisect.h"

namespace hookpoint::contact {

/// Gap [m] and its rate [m/s] at one end of a flight.
struct GapRate {
  double gap = 0., rate = 0.;
};

/// The cubic through both ends, g0 + r0 t + c t^2 + d t^3; its error is gap'''' h^4/384.
class GapCubic {
 public:
  /// `duration` h > 0 [s].
  GapCubic(const GapRate& start, const GapRate& end, double duration)
      : start_(start), end_(end), h_(duration) {
    const double slope = (end.gap - start.gap) / h_;
    c_ = (3. * slope - 2. * start.rate - end.rate) / h_;
    d_ = (start.rate + end.rate - 2. * slope) / (h_ * h_);
  }

  double at(double t) const { return start_.gap + t * (start_.rate + t * (c_ + t * d_)); }

  /// When the gap comes down to zero on its way to below `floor` (< 0), for the first time [s]; h
  /// if it does not go there. A point that starts at the ground, not above it, is let down by half
  /// of what is left to `floor`.
  double landing(double floor) const {
    const double bottom = end_.gap < floor ? h_ : lowest();
    if (!(at(bottom) < floor)) return h_;
    const double peak = start_.rate > 0. ? highest() : 0.;
    const double top = peak > 0. && peak < bottom ? peak : 0.;
    const double height = at(top);
    const double level = height > 0. ? 0. : 0.5 * (height + floor);
    return bisect([&](double t) { return level - at(t); }, top, bottom);
  }

 private:
  // Where the rate r0 + 2 c t + 3 d t^2 changes sign upwards, if the point was falling at the start
  // and rises at the end; else the start.
  double lowest() const {
    if (!(start_.rate < 0. && end_.rate > 0.)) return 0.;
    return -start_.rate / (c_ + root());
  }
  double highest() const { return start_.rate / (root() - c_); }
  double root() const { return std::sqrt(std::fmax(0., c_ * c_ - 3. * d_ * start_.rate)); }

  GapRate start_, end_;
  double h_, c_, d_;
};

}  // namespace hookpoint::contact
