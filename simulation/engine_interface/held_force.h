// Work of a force that is held over a step.
#pragma once

#include "contact/terrain/rolling.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {

/// F . (displacement of its point) + T . phi [J] on a body that has come from one pose X_WB to another by
/// the rotation vector phi. Exact for F, and for T where the body turns about one axis.
inline double held_force_work(const ForceInput& force, const Pose& before, const Pose& after) {
  const Vector3d way = after.position + rotate(after.orientation, force.point) - before.position -
                       rotate(before.orientation, force.point);
  const Vector3d turn = contact::rotation_vector(after.orientation * conjugate(before.orientation));
  return dot(force.force, way) + dot(force.torque, turn);
}

}  // namespace hookpoint::simulation
