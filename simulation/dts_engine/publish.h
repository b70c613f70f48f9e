// What a robot shows of its motion after a step: copies, but for the orientations of its links,
// which go on without a jump.
#pragma once

#include <span>

#include "simulation/dts_engine/articulated_robot.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Positions, velocities and orientations of the robot's bodies; what `bodies` holds gives the
/// signs of the quaternions. Of the ground nothing: force and contacts 0.
void publish_motion(const ArticulatedRobot& robot, std::span<BodyState> bodies);

/// Angles, rates, accelerations and torques of its joints.
void publish_joints(const ArticulatedRobot& robot, std::span<JointState> joints);

/// What each chain does to the base, in the step just taken.
void publish_hips(const ArticulatedRobot& robot, std::span<ChainState> chains);

/// The signs that the links' published quaternions have beside those that follow from their
/// rotations, one a link: what a run that is resumed needs to go on bit for bit.
void save_signs(const ArticulatedRobot& robot, std::span<const BodyState> bodies,
                std::span<double> signs);
void restore_signs(const ArticulatedRobot& robot, std::span<const double> signs,
                   std::span<BodyState> bodies);

}  // namespace hookpoint::simulation
