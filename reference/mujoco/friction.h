// The directions of friction in MuJoCo's contacts.
#pragma once

#include <array>

#include "math/vector3.h"

namespace hookpoint::reference {

/// The two tangents of a contact with that unit `normal`, along which the pyramid of friction has
/// its edges: the world's y made orthogonal to the normal (z where the normal leans to y by 30 deg
/// or more), and normal x that.
std::array<Vector3d, 2> mujoco_tangents(const Vector3d& normal);

}  // namespace hookpoint::reference
