#include "simulation/analysis/period_map.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "simulation/analysis/eigen_decompositions.h"

namespace hookpoint::simulation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A state (z, z') after some time: `now` of it before, and `held` of an acceleration that is held
/// meanwhile.
struct Advance {
  MatrixXd now, held;
};

/// One step of the integrator on z'' + C z' + K z = a.
Advance one_step(std::string_view integrator, const Vibration& vibration, double h) {
  const Eigen::Index n = vibration.stiffness.rows();
  const MatrixXd one = MatrixXd::Identity(n, n), none = MatrixXd::Zero(n, n);
  Advance step{MatrixXd(2 * n, 2 * n), MatrixXd(2 * n, n)};
  if (integrator == "semi_implicit_euler") {
    // v+ = v + h (a - K z - C v), z+ = z + h v+.
    const MatrixXd kept = one - h * vibration.damping;
    step.now << one - h * h * vibration.stiffness, h * kept, -h * vibration.stiffness, kept;
    step.held << h * h * one, h * one;
    return step;
  }
  MatrixXd rate(2 * n, 2 * n), push(2 * n, n);
  rate << none, one, -vibration.stiffness, -vibration.damping;
  push << none, one;
  // The sums of (h L)^i/i! and h (h L)^i/(i+1)!, up to the method's order.
  const int order = integrator == "rk4" ? 4 : 1;
  MatrixXd term = MatrixXd::Identity(2 * n, 2 * n);
  step.now = term;
  step.held = MatrixXd::Zero(2 * n, n);
  for (int i = 1; i <= order; ++i) {
    step.held += h / i * term * push;
    term = h / i * rate * term;
    step.now += term;
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

/// The state of robot and controllers from one update to the next, linear in it.
class PeriodMap {
 public:
  PeriodMap(std::string_view integrator, const Vibration& vibration,
            std::span<const JointLoop> loops, double falling_rate, double h)
      : falling_rate_(falling_rate),
        joints_(vibration.joints),
        loops_(loops),
        size_(2 * vibration.stiffness.rows()) {
    const auto steps_in = [](double time, double unit) {
      return static_cast<std::int64_t>(std::ceil(time / unit - 1e-9));
    };
    const std::int64_t steps = std::max<std::int64_t>(1, steps_in(loops.front().period, h));
    period_ = static_cast<double>(steps) * h;
    advance_ = repeated(one_step(integrator, vibration, h), steps);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      late_.push_back({steps_in(loops[i].delay, period_), steps_in(loops[i].rate_delay, period_)});
      size_ += memory_size(i);
    }
  }

  /// |eigenvalue| above 1, motions that nothing resists apart.
  bool grows() const {
    MatrixXd map(size_, size_);
    for (Eigen::Index i = 0; i < size_; ++i) map.col(i) = after(VectorXd::Unit(size_, i));
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

 private:
  struct Late {
    std::int64_t angle, rate;  ///< periods
  };
  static constexpr double least_growth = 1e-9, least_rate = 1e-6;

  /// What arrives later, then what the controller carries on.
  Eigen::Index memory_size(std::size_t i) const {
    const JointLoop& loop = loops_[i];
    return late_[i].angle + late_[i].rate + Eigen::Index{loop.differenced} +
           Eigen::Index{loop.filter_time > 0.} + Eigen::Index{loop.integral != 0.};
  }

  VectorXd after(VectorXd state) const {
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

  /// What the controllers do in an update (control/components/pd.cpp, pid.cpp), about a rest.
  double torque(std::size_t i, double position, double rate, Eigen::Ref<VectorXd> memory) const {
    const JointLoop& loop = loops_[i];
    const double q = pass_through(position, memory.head(late_[i].angle));
    double derivative = pass_through(rate, memory.segment(late_[i].angle, late_[i].rate));
    double* kept = memory.data() + late_[i].angle + late_[i].rate;
    if (loop.differenced) {
      derivative = (q - *kept) / period_;
      *kept++ = q;
    }
    if (loop.filter_time > 0.) {
      *kept += (derivative - *kept) * period_ / (loop.filter_time + period_);
      derivative = *kept++;
    }
    double torque = -loop.proportional * q - loop.derivative * derivative;
    if (loop.integral != 0.) {
      torque += *kept;
      *kept -= loop.integral * q * period_;
    }
    return torque;
  }

  double falling_rate_;
  const MatrixXd& joints_;
  std::span<const JointLoop> loops_;
  Eigen::Index size_;
  double period_ = 0.;
  Advance advance_;
  std::vector<Late> late_;
};

/// The fastest that anything moves [1/s]: no explicit method bears steps of several of its times.
double fastest_rate(const Vibration& vibration, std::span<const JointLoop> loops) {
  double stiffness = vibration.stiffness.norm(), damping = vibration.damping.norm();
  for (const JointLoop& loop : loops) {
    const double lever = vibration.joints.row(static_cast<Eigen::Index>(loop.sensed)).norm() *
                         vibration.joints.row(static_cast<Eigen::Index>(loop.driven)).norm();
    stiffness += std::abs(loop.proportional) * lever;
    damping += std::abs(loop.derivative) * lever;
  }
  return std::max(std::sqrt(stiffness), damping);
}

/// Positions, velocities and what controllers remember in units of one size: time in 1/`rate`.
Vibration scaled(const Vibration& vibration, double rate) {
  return {vibration.stiffness / (rate * rate), vibration.damping / rate, vibration.joints};
}

std::vector<JointLoop> scaled(std::span<const JointLoop> loops, double rate) {
  std::vector<JointLoop> all(loops.begin(), loops.end());
  for (JointLoop& loop : all) {
    loop.proportional /= rate * rate;
    loop.derivative /= rate;
    loop.integral /= rate * rate * rate;
    for (double* time : {&loop.filter_time, &loop.period, &loop.delay, &loop.rate_delay})
      *time *= rate;
  }
  return all;
}

}  // namespace

double largest_stable_step(std::string_view integrator, const Vibration& vibration,
                           std::span<const JointLoop> loops) {
  if (loops.empty()) return largest_stable_step(integrator, vibration);
  if (integrator != "explicit_euler" && integrator != "semi_implicit_euler" && integrator != "rk4")
    return std::numeric_limits<double>::infinity();
  const double rate = fastest_rate(vibration, loops);
  if (rate == 0.) return std::numeric_limits<double>::infinity();
  const Vibration slow = scaled(vibration, rate);
  const std::vector<JointLoop> slow_loops = scaled(loops, rate);
  const double period = slow_loops.front().period;
  const auto dividing = [&](double h) { return h < period ? period / std::ceil(period / h) : h; };
  const double falling_rate = std::sqrt(std::max(0., largest_eigenvalue(-slow.stiffness)));
  const auto grows = [&](double h) {
    return PeriodMap(integrator, slow, slow_loops, falling_rate, dividing(h)).grows();
  };
  constexpr double least = 1e-4, most = 1e4;
  if (grows(least)) return 0.;
  double low = least, high = 2. * least;
  for (; !grows(high); high *= 2.) {
    if (high > most) return std::numeric_limits<double>::infinity();
    low = high;
  }
  for (int i = 0; i < 24; ++i) {
    const double middle = std::sqrt(low * high);
    (grows(middle) ? high : low) = middle;
  }
  return dividing(low) / rate;
}

}  // namespace hookpoint::simulation
