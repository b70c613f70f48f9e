// Reports when a drive meets its effort_limit or its velocity_limit. The limits themselves are in
// the joint's torque (simulation/experiment/joint_forces.h, speed_limits.h), in every engine alike.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

class DriveWatch {
 public:
  explicit DriveWatch(const Experiment& experiment);

  /// Appends to `notices` a line for each limit that a drive meets for the first time, in the step
  /// that begins at `time` [s] with the joints as they are. O(limits that were never met);
  /// allocates nothing unless it tells.
  void look(const WorldInputs& inputs, std::span<const JointState> joints, double time,
            std::vector<std::string>& notices);

 private:
  struct Limited {
    std::size_t joint = 0;  ///< in WorldInputs::joint_torques
    double limit = 0.;      ///< [N m, N; rad/s, m/s]
    std::string trail;
    const char* unit = "";
  };
  std::vector<Limited> efforts_, speeds_;
};

}  // namespace hookpoint::simulation
