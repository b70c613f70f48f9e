// Bodies that do not touch at the start and may later: what their first contact feels.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "simulation/analysis/linear_dynamics.h"
#include "simulation/analysis/robots_in_touch.h"

namespace hookpoint::simulation {

/// The first contact of two bodies, or of a body and an obstacle.
struct Meeting {
  std::size_t robot = 0, other = 0;  ///< by number; the same for self-contact and an obstacle
  Vector3d normal{0., 0., 1.};       ///< any: the answer is the same in all directions
  /// Largest eigenvalue of how the places that meet answer a force, joints free [1/kg].
  double inverse_mass = 0.;
  contact::MaterialConstants<double> material;
  double load = 0.;  ///< the weight of what meets [N]
};

/// Of each pair of materials the meeting that a step has the hardest time with: at the corner of
/// each body's box where the effective mass is least: there one place is at least as hard on the step as
/// the several of a face. Left out are robots of one group of `touching`. None under `touch = points`. `rests`: one a
/// robot. O(bodies links^2 + pairs of bodies).
std::vector<Meeting> meeting_bodies(const Experiment& experiment,
                                    std::span<const RobotAtRest> rests,
                                    std::span<const RobotsInTouch> touching);

}  // namespace hookpoint::simulation
