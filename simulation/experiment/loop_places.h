// A loop as places of its two bodies that stay together.
#pragma once

#include <array>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// p of body a and of body b, in the axes of either [m].
using LoopPlace = std::array<Vector3d, 2>;

/// One where the bodies turn freely; of a hinge a second one along its axis. How far apart these are is
/// of no influence on the motion.
inline std::vector<LoopPlace> loop_places(const LoopSpec& loop) {
  constexpr double hinge_length = 0.1;
  std::vector<LoopPlace> places{{loop.point_a, loop.point_b}};
  if (loop.axes)
    places.push_back({loop.point_a + hinge_length * (*loop.axes)[0],
                      loop.point_b + hinge_length * (*loop.axes)[1]});
  return places;
}

}  // namespace hookpoint::simulation
