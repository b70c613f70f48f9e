// Robots that start deep inside what holds them, whose springs throw them out, and robots that are too
// heavy for their ground.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct StartDepth {
  std::size_t robot = 0;
  /// The place of the robot is to be changed; false: the stiffness of what it stands on.
  bool by_place = true;
  std::string message;
};

/// Under a force law of engine dts:
/// - one of each robot and what it starts inside of (terrain, an obstacle, another robot) by more than ten
///   times the depth at which it rests, if the springs hold enough energy to lift it by its own size;
/// - one of each free robot that is placed at rest in the terrain, deeper than a tenth of its size.
/// On the terrain a shape counts by its boundary points. O(points + detection).
std::vector<StartDepth> start_depths(const Experiment& experiment);

}  // namespace hookpoint::simulation
