#include "simulation/wiring/force_window.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/core/rational.h"

namespace hookpoint::simulation {
namespace {

/// 0 before the edge, 1 after it.
double rise(double time, double edge) {
  return 0.5 * (1. - std::cos(std::numbers::pi * std::clamp(time / edge, 0., 1.)));
}

}  // namespace

double envelope(const ForceWindow& window, std::int64_t step, double deltat) {
  using control::Rational;
  if (window.edge > 0.) {
    const double time = (static_cast<double>(step) + 0.5) * deltat;
    return std::min(rise(time - window.from, window.edge), rise(window.to - time, window.edge));
  }
  const Rational time = Rational(step) * Rational::from(deltat);
  return time >= Rational::from(window.from) && time < Rational::from(window.to) ? 1. : 0.;
}

}  // namespace hookpoint::simulation
