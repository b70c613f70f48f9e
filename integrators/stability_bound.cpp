#include "integrators/stability_bound.h"

#include <cmath>
#include <complex>
#include <limits>

namespace hookpoint::integrators {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool without_forces(const Mode& mode) { return mode.stiffness == 0. && mode.damping == 0.; }

/// The eigenvalue of greatest modulus, of those with non-negative imaginary part [1/s].
std::complex<double> fastest_eigenvalue(const Mode& mode) {
  const double discriminant = mode.damping * mode.damping - 4. * mode.stiffness * mode.mass;
  const std::complex<double> root = std::sqrt(std::complex<double>(discriminant));
  if (discriminant >= 0.) return -(mode.damping + root) / (2. * mode.mass);
  return (root - mode.damping) / (2. * mode.mass);
}

double rk4_amplification(std::complex<double> z) {
  return std::abs(1. + z * (1. + z / 2. * (1. + z / 3. * (1. + z / 4.))));
}

}  // namespace

double explicit_euler_bound(std::complex<double> eigenvalue) {
  // |1 + lambda dt| = 1. Decay below round-off of the modulus is none.
  constexpr double least_decay = 1e-12;
  const double modulus = std::abs(eigenvalue);
  if (modulus == 0.) return infinity;
  const double decay = -eigenvalue.real() / modulus;
  return decay > least_decay ? 2. * decay / modulus : 0.;
}

double explicit_euler_bound(const Mode& mode) {
  return without_forces(mode) ? infinity : explicit_euler_bound(fastest_eigenvalue(mode));
}

double semi_implicit_euler_bound(const Mode& mode) {
  if (without_forces(mode)) return infinity;
  const double root = std::sqrt(mode.damping * mode.damping + 4. * mode.stiffness * mode.mass);
  // (root - c)/k, multiplied by (root + c)/(root + c): no cancellation, and k may be 0.
  return 4. * mode.mass / (root + mode.damping);
}

double rk4_bound(std::complex<double> eigenvalue) {
  constexpr double least_growth = 1e-12;
  const double modulus = std::abs(eigenvalue);
  if (modulus == 0.) return infinity;
  const std::complex<double> direction = eigenvalue / modulus;
  // What grows by itself grows with every step that is short enough. Growth below round-off of
  // the modulus is none.
  if (direction.real() > least_growth) return 0.;
  // The region |R| <= 1 ends between 2.6 and 3.4 from the origin in the left half plane; march out,
  // then bisect. Below 1 an undamped mode's |R| = 1 - O(|z|^6) is too near 1 to be compared.
  const auto unstable = [&](double r) { return rk4_amplification(r * direction) > 1.; };
  double low = 1.;
  double high = low;
  while (!unstable(high)) {
    low = high;
    high += 0.01;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (unstable(middle) ? high : low) = middle;
  }
  return low / modulus;
}

double rk4_bound(const Mode& mode) {
  return without_forces(mode) ? infinity : rk4_bound(fastest_eigenvalue(mode));
}

std::optional<double> largest_stable_step(std::string_view integrator, const Mode& mode) {
  if (integrator == "explicit_euler") return explicit_euler_bound(mode);
  if (integrator == "semi_implicit_euler") return semi_implicit_euler_bound(mode);
  if (integrator == "rk4") return rk4_bound(mode);
  return std::nullopt;
}

}  // namespace hookpoint::integrators
