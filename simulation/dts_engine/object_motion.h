// How the objects that may touch move.
#pragma once

#include "dts/workspace.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// How an object moves, world axes.
struct ObjectMotion : dts::BodyMotion<double> {
  Vector3d belt;  ///< velocity of its material over its surface, beside that [m/s]

  Vector3d to_world(const Vector3d& p_O) const { return p_WB + R_WB * p_O; }
  Vector3d to_object(const Vector3d& p_W) const { return transpose_times(R_WB, p_W - p_WB); }
  Vector3d velocity_at(const Vector3d& p_W) const { return v_WB + cross(w_WB, p_W - p_WB); }
};

/// Of a robot's body.
ObjectMotion motion_of(const BodyState& body);

/// Of the terrain or an obstacle, `elapsed` [s] after the step's start.
ObjectMotion motion_of(const SurfaceMotion& surface, double elapsed);

}  // namespace hookpoint::simulation
