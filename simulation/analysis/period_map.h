// A robot whose joints are under wired controllers, from one update of these to the next: the exact
// map of its linear dynamics.
#pragma once

#include <cstdint>
#include <span>

#include "integrators/stepper.h"
#include "simulation/analysis/joint_loops.h"
#include "simulation/analysis/linear_dynamics.h"

namespace hookpoint::simulation {

/// A state (z, z') after some time: `now` of it before, and `held` of an acceleration that is held
/// meanwhile.
struct Advance {
  Eigen::MatrixXd now, held;
};

/// The state of robot and controllers from one update to the next, linear in it. Controllers see
/// the state at the beginning of a step and hold their torque, all at the period of the first; a
/// delay that is no whole number of periods counts as the next larger one that is.
class PeriodMap {
 public:
  /// `stepper`: of fixed steps, `h` each [s]. Without `loops` the period is one step. Whatever has
  /// a size, `dynamics` and `loops` outlive it. `falling_rate`: of the motion that falls over by
  /// itself, the fastest [1/s].
  PeriodMap(const integrators::StepperDescription& stepper, const LinearDynamics& dynamics,
            std::span<const JointLoop> loops, double falling_rate, double h);

  /// Whether a motion grows: motions that nothing resists apart, and those that fall over by
  /// themselves. An eigenvalue problem of size 2 n + what the controllers remember.
  bool grows() const;

 private:
  struct Late {
    std::int64_t angle, rate;  ///< periods
  };

  Eigen::Index memory_size(std::size_t loop) const;
  Eigen::VectorXd after(Eigen::VectorXd state) const;
  double torque(std::size_t loop, double position, double rate,
                Eigen::Ref<Eigen::VectorXd> memory) const;

  double falling_rate_;
  const Eigen::MatrixXd& joints_;
  std::span<const JointLoop> loops_;
  Eigen::Index size_;
  double period_ = 0.;
  Advance advance_;
  std::vector<Late> late_;
};

}  // namespace hookpoint::simulation
