// Joints of a robot's file that do not move by themselves: those that are locked, and those that follow
// others.
#pragma once

#include <string>
#include <vector>

#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

/// The joint no longer moves: it stays at `q` [rad, m].
void fix_joint(double q, UrdfJoint& joint);

/// Where the joint starts if no argument says so: the file's own angle, 0 if it has none, or the limit
/// that is nearest to it.
double start_of(const UrdfJoint& joint);

/// Resolves trains of gears to the joint that leads them; what follows a joint that is fixed is fixed
/// too. An error for a joint that is not there, and for a ring. O(followers^2).
void settle_followers(UrdfRobot& robot, language::Report& report);

}  // namespace hookpoint::simulation
