// Reports when a drive has to give more than its joint's effort_limit lets through. The limit
// itself is in the joint's torque (simulation/experiment/joint_forces.h), in every engine alike.
#pragma once

#include <string>
#include <vector>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

class EffortWatch {
 public:
  explicit EffortWatch(const Experiment& experiment);

  /// Appends to `notices` a line for each joint that exceeds its limit for the first time, in
  /// the step that begins at `time` [s]. O(joints with a limit that never reached it);
  /// allocates nothing unless it tells.
  void look(const WorldInputs& inputs, double time, std::vector<std::string>& notices);

 private:
  struct Limited {
    std::size_t joint = 0;  ///< in WorldInputs::joint_torques
    double limit = 0.;      ///< [N m, N]
    std::string trail;
    const char* unit = "";
  };
  std::vector<Limited> limited_;
};

}  // namespace hookpoint::simulation
