// The pull of a person: a spring and a damper between a point of a body and a target, which is
// dragged. Worked out at each step's beginning and held over the step.
#pragma once

#include <vector>

#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

class Pull {
 public:
  /// On nobody. The stiffness lets a tenth of a metre carry the heaviest robot's weight, W / 0.1 m;
  /// the damping is 0.7 of that at which a mass of W / g would just not swing. Both are small
  /// enough that the force, held over a step, is stable on the lightest body at its end, where a
  /// slender rod resists as a quarter of its mass would: k dt^2 / (m/4) <= 1/10, c dt / (m/4) <=
  /// 1/2.
  explicit Pull(const Experiment& experiment);

  /// F = k (target - p) - c v of the point as `state` has it; `input` is to act from now on.
  void act(const WorldState& state, PullInput& input);
  /// Simulator.pull.body, .point, .target, .stiffness, .damping and .force.
  void add_ports(std::vector<Port>& ports);

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive("pull_body", self.body_);
    archive("pull_point", self.point_);
    archive("pull_target", self.target_);
    archive("pull_stiffness", self.stiffness_);
    archive("pull_damping", self.damping_);
  }

 private:
  std::vector<std::size_t> first_bodies_;  ///< of each robot; then how many there are
  double body_ = -1.;                      ///< index in WorldState::bodies; -1: none
  Vector3d point_;                         ///< body axes [m]
  Vector3d target_;                        ///< world axes [m]
  double stiffness_ = 0.;                  ///< [N/m]
  double damping_ = 0.;                    ///< [N s/m]
  Vector3d force_;                         ///< world axes [N]
};

}  // namespace hookpoint::simulation
