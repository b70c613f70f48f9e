#include "simulation/analysis/period_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "integrators/vector_space_system.h"
#include "simulation/analysis/eigen_decompositions.h"

namespace hookpoint::simulation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// z'' + C z' + K z = a, as an integrator sees a mechanism.
class LinearMechanism final : public integrators::VectorSpaceSystem {
 public:
  VectorXd held;  ///< a

  explicit LinearMechanism(const LinearDynamics& dynamics)
      : VectorSpaceSystem(static_cast<std::size_t>(dynamics.stiffness.rows())),
        held(VectorXd::Zero(dynamics.stiffness.rows())),
        dynamics_(dynamics) {}

  integrators::Status accelerations(integrators::Stage, double, std::span<const double> q,
                                    std::span<const double> v, std::span<double> a) override {
    const Eigen::Index n = held.size();
    const Eigen::Map<const VectorXd> z(q.data(), n), rate(v.data(), n);
    Eigen::Map<VectorXd> acceleration(a.data(), n);
    acceleration = held;
    acceleration.noalias() -= dynamics_.stiffness * z;
    acceleration.noalias() -= dynamics_.damping * rate;
    if (h_ == 0.) return integrators::Status::ok;
    acceleration.noalias() -= h_ * dynamics_.of_joints.stiffness * rate;
    acceleration = mass_.solve(acceleration).eval();
    return integrators::Status::ok;
  }

  void take_joints_at_end_of(double h) override {
    if (h == h_) return;
    h_ = h;
    mass_.compute(MatrixXd::Identity(held.size(), held.size()) + h * dynamics_.of_joints.damping +
                  h * h * dynamics_.of_joints.stiffness);
  }

 private:
  const LinearDynamics& dynamics_;
  double h_ = 0.;
  Eigen::LLT<MatrixXd> mass_;  ///< 1 + h C_j + h^2 K_j
};

/// One step of the integrator: a column is what the step itself makes of a unit position, velocity
/// or held acceleration.
Advance one_step(const integrators::StepperDescription& stepper, const LinearDynamics& dynamics,
                 double h) {
  LinearMechanism mechanism(dynamics);
  const auto method = stepper.make(mechanism, {});
  const Eigen::Index n = mechanism.held.size();
  Advance step{MatrixXd::Identity(2 * n, 2 * n), MatrixXd::Zero(2 * n, n)};
  const auto take = [&](auto column) {
    const auto size = static_cast<std::size_t>(n);
    const auto status =
        method->step(mechanism, 0., h, {column.data(), size}, {column.data() + n, size});
    if (status != integrators::Status::ok)
      column.setConstant(std::numeric_limits<double>::infinity());
  };
  for (Eigen::Index i = 0; i < 2 * n; ++i) take(step.now.col(i));
  for (Eigen::Index i = 0; i < n; ++i) {
    mechanism.held = VectorXd::Unit(n, i);
    take(step.held.col(i));
  }
  return step;
}

/// `count` steps of the same held acceleration, by doubling.
Advance repeated(const Advance& step, std::int64_t count) {
  Advance whole{MatrixXd::Identity(step.now.rows(), step.now.cols()),
                MatrixXd::Zero(step.held.rows(), step.held.cols())};
  Advance power = step;
  for (std::int64_t left = count; left > 0; left /= 2) {
    if (left % 2 == 1) {
      whole.held = power.now * whole.held + power.held;
      whole.now = power.now * whole.now;
    }
    power.held = power.now * power.held + power.held;
    power.now = power.now * power.now;
  }
  return whole;
}

/// Values that arrive some periods late, in the part of the state given to it.
double pass_through(double value, Eigen::Ref<VectorXd> line) {
  if (line.size() == 0) return value;
  const double arrived = line[0];
  for (Eigen::Index i = 0; i + 1 < line.size(); ++i) line[i] = line[i + 1];
  line[line.size() - 1] = value;
  return arrived;
}

}  // namespace

PeriodMap::PeriodMap(const integrators::StepperDescription& stepper, const LinearDynamics& dynamics,
                     std::span<const JointLoop> loops, double falling_rate, double h)
    : falling_rate_(falling_rate),
      joints_(dynamics.joints),
      loops_(loops),
      size_(2 * dynamics.stiffness.rows()) {
  const auto steps_in = [](double time, double unit) {
    return static_cast<std::int64_t>(std::ceil(time / unit - 1e-9));
  };
  const double shortest = loops.empty() ? 0. : loops.front().period;
  const std::int64_t steps = std::max<std::int64_t>(1, steps_in(shortest, h));
  period_ = static_cast<double>(steps) * h;
  advance_ = repeated(one_step(stepper, dynamics, h), steps);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    late_.push_back({steps_in(loops[i].delay, period_), steps_in(loops[i].rate_delay, period_)});
    size_ += memory_size(i);
  }
}

bool PeriodMap::grows() const {
  constexpr double least_growth = 1e-9, least_rate = 1e-6;
  MatrixXd map(size_, size_);
  for (Eigen::Index i = 0; i < size_; ++i) map.col(i) = after(VectorXd::Unit(size_, i));
  if (!map.allFinite()) return true;
  const Eigen::VectorXcd all = general_eigenvalues(map);
  // Of a motion that nothing resists z+ = z + T z': a double eigenvalue 1, which round-off parts.
  const double least_change = least_rate * std::max(1., period_);
  // What falls over by itself does so in the fastest at exp(sqrt(-K) T), and without turning.
  const double falls = std::exp(1.01 * falling_rate_ * period_);
  return std::ranges::any_of(all, [&](const std::complex<double>& value) {
    if (value.real() > 0. && std::abs(value.imag()) < least_rate && value.real() < falls)
      return false;
    return std::abs(value) > 1. + least_growth && std::abs(value - 1.) > least_change;
  });
}

/// What arrives later, then what the controller carries on.
Eigen::Index PeriodMap::memory_size(std::size_t loop) const {
  return late_[loop].angle + late_[loop].rate +
         static_cast<Eigen::Index>(control::memory_size(loops_[loop].gains));
}

VectorXd PeriodMap::after(VectorXd state) const {
  const Eigen::Index n = joints_.cols();
  const VectorXd positions = joints_ * state.head(n);
  const VectorXd rates = joints_ * state.segment(n, n);
  VectorXd torques = VectorXd::Zero(joints_.rows());
  Eigen::Index at = 2 * n;
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    const auto sensed = static_cast<Eigen::Index>(loops_[i].sensed);
    const Eigen::Index length = memory_size(i);
    torques[static_cast<Eigen::Index>(loops_[i].driven)] +=
        torque(i, positions[sensed], rates[sensed], state.segment(at, length));
    at += length;
  }
  state.head(2 * n) =
      (advance_.now * state.head(2 * n) + advance_.held * (joints_.transpose() * torques)).eval();
  return state;
}

double PeriodMap::torque(std::size_t loop, double position, double rate,
                         Eigen::Ref<VectorXd> memory) const {
  const Late& late = late_[loop];
  const double seen = pass_through(position, memory.head(late.angle));
  const double seen_rate = pass_through(rate, memory.segment(late.angle, late.rate));
  const control::FeedbackGains& gains = loops_[loop].gains;
  return control::feedback(gains, seen, seen_rate, period_,
                           {memory.data() + late.angle + late.rate, control::memory_size(gains)});
}

}  // namespace hookpoint::simulation
