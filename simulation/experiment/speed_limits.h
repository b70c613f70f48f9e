// What drives hold back of their torques, so as not to take their joints beyond velocity_limit.
//
// A drive that turns its joint with the torque d, s = sign(d), may accelerate it by at most
//
//   s a <= (velocity_limit - s v)/T        T the step: after it the joint is at its limit
//
// and holds back the least part x of d, 0 <= x <= 1, that keeps this; all of it where that is not
// enough. It never brakes. Accelerations are linear in what drives hold back,
//
//   a(x) = a(0) - sum_j c_j x_j        c_j: what the whole torque of drive j makes of them
//
// with s_i c_ij = s_i W_ij s_j |d_j| and a mobility W that is positive definite, so that the parts
// of all drives are one and projected Gauss-Seidel finds them (Cottle, Pang & Stone, The Linear
// Complementarity Problem, 2009, section 5.2).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

class SpeedLimits {
 public:
  /// Of the robot's joints, with T = `step` [s]. Allocates; nothing else does.
  SpeedLimits(const RobotSpec& robot, double step);
  /// Whether any joint has a limit.
  bool any() const { return !limited_.empty(); }

  /// Finds what the drives hold back of `drives` [N m, N], within effort_limit, at joint rates
  /// `rates` and accelerations `accelerations` under the whole of them; all one a joint.
  /// `without(held_back)` returns the accelerations under what is left. False where nothing is held
  /// back. O(limits met) calls.
  template <class Without>
  bool find(std::span<const double> drives, std::span<const double> rates,
            std::span<const double> accelerations, Without&& without) {
    begin(drives, rates, accelerations);
    bool any = false;
    for (; exceeded(); any = true) {
      for (std::size_t j = 0; j < limited_.size(); ++j) {
        if (!exceeds(j)) continue;
        take_all_of(j);
        fill_column(j, without(held_back()));
        limited_[j].bound = true;
      }
      solve();
    }
    take_parts();
    return any;
  }
  /// As `find` found it [N m, N], one a joint.
  std::span<const double> held_back() const { return held_back_; }

 private:
  struct Limited {
    std::size_t joint = 0;
    double limit = 0.;         ///< [rad/s, m/s]
    double drive = 0.;         ///< d
    double sign = 0.;          ///< s; 0 without a drive
    double room = 0.;          ///< (velocity_limit - s v)/T
    double acceleration = 0.;  ///< a(0)
    double part = 0.;          ///< x
    bool bound = false;        ///< its column is known
  };
  void begin(std::span<const double> drives, std::span<const double> rates,
             std::span<const double> accelerations);
  /// s a(x) of a joint with the parts found so far.
  double forward(std::size_t i) const;
  bool exceeds(std::size_t i) const;
  bool exceeded() const;
  void take_all_of(std::size_t j);
  void take_parts();
  void fill_column(std::size_t j, std::span<const double> accelerations);
  void solve();

  double step_;
  std::vector<Limited> limited_;
  std::vector<double> columns_;    ///< c, row i of joint i, limits alone
  std::vector<double> held_back_;  ///< one a joint
};

}  // namespace hookpoint::simulation
