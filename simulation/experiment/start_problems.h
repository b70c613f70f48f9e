// What an initial state may not be, whoever writes it: a file or a program.
#pragma once

#include <array>
#include <string>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Planes of world axes by their normals x, y, z.
inline constexpr std::array<const char*, 3> planes{"yz", "xz", "xy"};

// "" where nothing is wrong.

/// Of the base's initial velocity: a fixed base has none, a planar one has none out of its plane.
std::string velocity_problem(const RobotSpec& robot);
/// Of its angular velocity, likewise.
std::string angular_velocity_problem(const RobotSpec& robot);
/// Of a joint's initial angle: it lies within the joint's limits.
std::string angle_problem(const LinkSpec& link);

}  // namespace hookpoint::simulation
