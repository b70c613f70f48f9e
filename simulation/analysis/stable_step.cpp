#include "simulation/analysis/stable_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "simulation/analysis/eigen_decompositions.h"
#include "simulation/analysis/period_map.h"

namespace hookpoint::simulation {
namespace {

using integrators::StepperDescription;

constexpr double unlimited = std::numeric_limits<double>::infinity();
/// Of the fastest: below, an eigenvalue is a motion that nothing resists, and round-off.
constexpr double least_eigenvalue = 1e-6;
/// Of an eigenvalue in units of the fastest, times its own size: what rounding adds to it, some
/// sizes of a matrix whose positions and velocities differ by that size.
constexpr double eigenvalue_rounding = 1e-14;

/// K and C with what joints have of them as the method counts it.
LinearDynamics counted(const integrators::MatrixBound& bound, LinearDynamics dynamics) {
  if (bound.joints == 1.) return dynamics;
  dynamics.stiffness += (bound.joints - 1.) * dynamics.of_joints.stiffness;
  dynamics.damping += (bound.joints - 1.) * dynamics.of_joints.damping;
  return dynamics;
}

/// Whether h^2 stiffness K + h damping C has all eigenvalues below 1.
bool bears(const integrators::MatrixBound& bound, const LinearDynamics& dynamics, double h) {
  const Eigen::Index n = dynamics.stiffness.rows();
  const Eigen::LLT<Eigen::MatrixXd> factors(Eigen::MatrixXd::Identity(n, n) -
                                            bound.stiffness * h * h * dynamics.stiffness -
                                            bound.damping * h * dynamics.damping);
  return factors.info() == Eigen::Success;
}

/// The step h at which h^2 stiffness K + h damping C first has the eigenvalue 1.
double step_of(const integrators::MatrixBound& bound, const StepperDescription& stepper,
               const LinearDynamics& whole, double least) {
  const LinearDynamics dynamics = counted(bound, whole);
  if (std::isfinite(least) && bears(bound, dynamics, least)) return least;
  const double k = std::max(0., largest_eigenvalue(dynamics.stiffness));
  const double c = std::max(0., largest_eigenvalue(dynamics.damping));
  if (k == 0. && c == 0.) return unlimited;
  double low = integrators::largest_stable_step(stepper, {k, c, 1.});
  double high = std::min(1. / std::sqrt(bound.stiffness * k), 1. / (bound.damping * c));
  // Where joints pull against the rest, the greatest K and C may not come together, or never resist.
  for (; bound.joints < 0. && bears(bound, dynamics, high); high *= 2.) {
    if (std::isinf(2. * high)) return unlimited;
    low = high;
  }
  for (int i = 0; i < 40 && high - low > 1e-12 * high; ++i) {
    const double h = 0.5 * (low + high);
    (bears(bound, dynamics, h) ? low : high) = h;
  }
  return low;
}

/// Of z'' + C z' + K z = 0, for all but motions that nothing resists and those that fall over by
/// themselves, whose eigenvalue is real and above 0 (K of steady loads may have negative ones).
std::vector<std::complex<double>> eigenvalues(const LinearDynamics& dynamics) {
  const Eigen::Index n = dynamics.stiffness.rows();
  // Rates in units of the fastest, so that positions and velocities are of one size.
  const double unit = std::max(std::sqrt(dynamics.stiffness.norm()), dynamics.damping.norm());
  Eigen::MatrixXd system(2 * n, 2 * n);
  system << Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Identity(n, n),
      -dynamics.stiffness / (unit * unit), -dynamics.damping / unit;
  const Eigen::VectorXcd all = general_eigenvalues(system);
  std::vector<std::complex<double>> resisted;
  for (std::complex<double> value : all) {
    // No growth, but a swing that nothing damps.
    if (value.real() > 0. && value.real() * std::abs(value) < eigenvalue_rounding) value.real(0.);
    const bool falls = value.real() > 0. && std::abs(value.imag()) < 1e-6 * value.real();
    if (std::abs(value) > least_eigenvalue && !falls) resisted.push_back(unit * value);
  }
  return resisted;
}

double step_of(const integrators::EigenvalueBound& bound, const LinearDynamics& dynamics) {
  double least = unlimited;
  for (const std::complex<double>& eigenvalue : eigenvalues(dynamics))
    least = std::min(least, bound.largest_step(eigenvalue));
  return least;
}

/// The fastest that anything moves [1/s]: no explicit method bears steps of several of its times.
double fastest_rate(const LinearDynamics& dynamics, std::span<const JointLoop> loops) {
  double stiffness = dynamics.stiffness.norm(), damping = dynamics.damping.norm();
  for (const JointLoop& loop : loops) {
    const double lever = dynamics.joints.row(static_cast<Eigen::Index>(loop.sensed)).norm() *
                         dynamics.joints.row(static_cast<Eigen::Index>(loop.driven)).norm();
    stiffness += std::abs(loop.gains.proportional) * lever;
    damping += std::abs(loop.gains.derivative) * lever;
  }
  return std::max(std::sqrt(stiffness), damping);
}

/// Positions, velocities and what controllers remember in units of one size: time in 1/`rate`.
LinearDynamics scaled(const LinearDynamics& dynamics, double rate) {
  return {dynamics.stiffness / (rate * rate),
          dynamics.damping / rate,
          dynamics.joints,
          {dynamics.of_joints.stiffness / (rate * rate), dynamics.of_joints.damping / rate}};
}

std::vector<JointLoop> scaled(std::span<const JointLoop> loops, double rate) {
  std::vector<JointLoop> all(loops.begin(), loops.end());
  for (JointLoop& loop : all) {
    loop.gains.proportional /= rate * rate;
    loop.gains.derivative /= rate;
    loop.gains.integral /= rate * rate * rate;
    for (double* time : {&loop.gains.filter_time, &loop.period, &loop.delay, &loop.rate_delay})
      *time *= rate;
  }
  return all;
}

/// From the steps themselves, with the controllers' updates.
double step_of_map(const StepperDescription& stepper, const LinearDynamics& dynamics,
                   std::span<const JointLoop> loops, double least) {
  const double rate = fastest_rate(dynamics, loops);
  if (rate == 0.) return unlimited;
  const LinearDynamics slow = scaled(dynamics, rate);
  const std::vector<JointLoop> slow_loops = scaled(loops, rate);
  const double period = loops.empty() ? 0. : slow_loops.front().period;
  const auto dividing = [&](double h) { return h < period ? period / std::ceil(period / h) : h; };
  const double falling_rate = std::sqrt(std::max(0., largest_eigenvalue(-slow.stiffness)));
  const auto grows = [&](double h) {
    return PeriodMap(stepper, slow, slow_loops, falling_rate, dividing(h)).grows();
  };
  if (loops.empty() && std::isfinite(least) && !grows(least * rate)) return least;
  const double low = integrators::largest_step_without_growth(grows);
  return dividing(low) / rate;
}

}  // namespace

double largest_stable_step(const StepperDescription& stepper, const LinearDynamics& dynamics,
                           std::span<const JointLoop> loops, double least) {
  if (stepper.adaptive()) return unlimited;
  if (!loops.empty()) return step_of_map(stepper, dynamics, loops, least);
  if (dynamics.stiffness.isZero(0.) && dynamics.damping.isZero(0.)) return unlimited;
  if (!dynamics.stiffness.allFinite() || !dynamics.damping.allFinite()) return unlimited;
  // Of rates beyond the range of numbers.
  if (!std::isfinite(dynamics.stiffness.norm()) || !std::isfinite(dynamics.damping.norm()))
    return 0.;
  if (const auto* bound = std::get_if<integrators::EigenvalueBound>(&stepper.stability))
    return step_of(*bound, dynamics);
  if (const auto* bound = std::get_if<integrators::MatrixBound>(&stepper.stability))
    return step_of(*bound, stepper, dynamics, least);
  return step_of_map(stepper, dynamics, loops, least);
}

}  // namespace hookpoint::simulation
