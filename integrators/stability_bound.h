// What an integrator says of its stability on linear vibrations, and the largest step with which it
// keeps one from growing. For a robot on its ground see simulation/analysis/stable_step.h and
// docs/contact.md.
#pragma once

#include <complex>
#include <functional>
#include <variant>

namespace hookpoint::integrators {

struct StepperDescription;

/// The vibration m x'' + c x' + k x = 0.
struct Mode {
  double stiffness = 0.;  ///< k >= 0 [N/m]
  double damping = 0.;    ///< c >= 0 [N s/m]
  double mass = 1.;       ///< effective mass m > 0 [kg]
};

/// Nothing is said: the bound is found from steps that the method takes on the linear system.
struct BoundFromSteps {};

/// A method that treats positions and velocities alike, as Runge-Kutta methods do, multiplies the
/// motion exp(lambda t) of any linear system by R(lambda h) in a step h.
struct EigenvalueBound {
  /// h up to which |R(lambda h)| <= 1 for the eigenvalue lambda [1/s]: 0 where it grows from the
  /// shortest step on, infinity for lambda = 0 [s].
  double (*largest_step)(std::complex<double> eigenvalue) = nullptr;
};

/// A method that treats them unlike: with symmetric K and C no motion of z'' + C z' + K z = 0 grows
/// as long as h^2 stiffness K + h damping C has no eigenvalue above 1.
struct MatrixBound {
  double stiffness = 0., damping = 0.;
  double joints = 1.;  ///< factor of what joints add to K and C; below 0 where they are implicit
};

using LinearStability = std::variant<BoundFromSteps, EigenvalueBound, MatrixBound>;

/// The largest step with which the method does not let the mode grow [s]; infinity for a mode
/// without forces and for an adaptive method.
double largest_stable_step(const StepperDescription& method, const Mode& mode);

/// The largest h for which `grows(h)` is false, h in units of the shortest time in which anything
/// moves: within a relative 4e-8, from 1e-4 (below: 0) to 1e4 (above: infinity). About 40 calls.
double largest_step_without_growth(const std::function<bool(double h)>& grows);

}  // namespace hookpoint::integrators
