// The largest step with which an integrator keeps the linear vibration m x'' + c x' + k x = 0 from
// growing. For a robot on its ground the caller reduces the contacts to the stiffest mode
// (docs/contact.md).
#pragma once

#include <complex>
#include <optional>
#include <string_view>

namespace hookpoint::integrators {

struct Mode {
  double stiffness = 0.;  ///< k >= 0 [N/m]
  double damping = 0.;    ///< c >= 0 [N s/m]
  double mass = 1.;       ///< effective mass m > 0 [kg]
};

/// c/k for zeta = c/(2 sqrt(k m)) < 1 (0 without damping: never stable), 4 m/(c + sqrt(c^2 - 4 k
/// m)) above [s].
double explicit_euler_bound(const Mode& mode);

/// (sqrt(c^2 + 4 k m) - c)/k; 2/w without damping, 2 m/c without stiffness [s].
double semi_implicit_euler_bound(const Mode& mode);

/// Where |R(lambda dt)| first exceeds 1 for an eigenvalue lambda of the mode, R(z) = 1 + z + z^2/2
/// + z^3/6 + z^4/24; 2 sqrt(2)/w without damping, 2.785.../|lambda| for real eigenvalues [s].
double rk4_bound(const Mode& mode);

/// The same for one eigenvalue of a linear system with many modes [1/s]: explicit Euler's -2 Re/|
/// |^2, 0 where it does not decay; RK4's, 0 where it grows; infinity for eigenvalue 0. There is
/// none such of semi-implicit Euler, which treats position and velocity unlike.
double explicit_euler_bound(std::complex<double> eigenvalue);
double rk4_bound(std::complex<double> eigenvalue);

/// The bound of the integrator of that name [s]; infinity for a mode without forces; none for an
/// unknown name.
std::optional<double> largest_stable_step(std::string_view integrator, const Mode& mode);

}  // namespace hookpoint::integrators
