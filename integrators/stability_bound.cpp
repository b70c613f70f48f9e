#include "integrators/stability_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/stepper.h"
#include "integrators/vector_space_system.h"

namespace hookpoint::integrators {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The eigenvalue of greatest modulus, of those with non-negative imaginary part [1/s].
std::complex<double> fastest_eigenvalue(const Mode& mode) {
  const double discriminant = mode.damping * mode.damping - 4. * mode.stiffness * mode.mass;
  const std::complex<double> root = std::sqrt(std::complex<double>(discriminant));
  if (discriminant >= 0.) return -(mode.damping + root) / (2. * mode.mass);
  return (root - mode.damping) / (2. * mode.mass);
}

/// x'' = -(k x + c x')/m, as an integrator sees a mechanism.
class OneMode final : public VectorSpaceSystem {
 public:
  explicit OneMode(const Mode& mode) : VectorSpaceSystem(1), mode_(mode) {}
  Status accelerations(Stage, double, std::span<const double> q, std::span<const double> v,
                       std::span<double> a) override {
    a[0] = -(mode_.stiffness * q[0] + mode_.damping * v[0]) / mode_.mass;
    return Status::ok;
  }

 private:
  Mode mode_;
};

/// Whether the matrix of one step of `h` [s], of which a step from (1, 0) and one from (0, 1) are
/// the columns, has an eigenvalue beyond the unit circle. `rate`: in units of which velocities are
/// of the size of positions [1/s].
bool grows_in_a_step(const StepperDescription& method, const Mode& mode, double rate, double h) {
  constexpr double rounding = 1e-9;
  OneMode system(mode);
  const auto stepper = method.make(system, {});
  double x[] = {1., 0.}, v[] = {0., rate};
  for (int column = 0; column < 2; ++column) {
    if (stepper->step(system, 0., h, {&x[column], 1}, {&v[column], 1}) != Status::ok) return true;
  }
  const double half_trace = 0.5 * (x[0] + v[1] / rate);
  const double determinant = (x[0] * v[1] - x[1] * v[0]) / rate;
  const double discriminant = half_trace * half_trace - determinant;
  const double radius = discriminant > 0. ? std::abs(half_trace) + std::sqrt(discriminant)
                                          : std::sqrt(std::max(0., determinant));
  return radius > 1. + rounding;
}

}  // namespace

double largest_stable_step(const StepperDescription& method, const Mode& mode) {
  if (method.adaptive() || (mode.stiffness == 0. && mode.damping == 0.)) return infinity;
  if (const auto* bound = std::get_if<EigenvalueBound>(&method.stability))
    return bound->largest_step(fastest_eigenvalue(mode));
  if (const auto* bound = std::get_if<MatrixBound>(&method.stability)) {
    // h^2 stiffness k + h damping c = m, solved without cancellation, and k may be 0.
    const double c = bound->damping * mode.damping;
    const double root = std::sqrt(c * c + 4. * bound->stiffness * mode.stiffness * mode.mass);
    return 2. * mode.mass / (root + c);
  }
  const double rate = std::abs(fastest_eigenvalue(mode));
  return largest_step_without_growth(
             [&](double h) { return grows_in_a_step(method, mode, rate, h / rate); }) /
         rate;
}

double largest_step_without_growth(const std::function<bool(double h)>& grows) {
  constexpr double least = 1e-4, most = 1e4;
  if (grows(least)) return 0.;
  double low = least, high = 2. * least;
  for (; !grows(high); high *= 2.) {
    if (high > most) return infinity;
    low = high;
  }
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low * high);
    (grows(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace hookpoint::integrators
