// Everything of a robot that evolves by its dynamics, as a regular value: a copy is a checkpoint.
#pragma once

#include <vector>

#include "math/rotation.h"

namespace hookpoint::dts {

template <class Real>
struct State {
  Vector3<Real> base_position;          ///< p_WB [m]
  Quaternion<Real> base_orientation;    ///< R_WB, unit
  Vector3<Real> base_velocity;          ///< v_WB, of the base frame's origin, world axes [m/s]
  Vector3<Real> base_angular_velocity;  ///< w_WB, world axes [rad/s]
  std::vector<Real> joint_positions;    ///< q, chain by chain [rad or m]
  std::vector<Real> joint_rates;        ///< dq/dt
};

}  // namespace hookpoint::dts
