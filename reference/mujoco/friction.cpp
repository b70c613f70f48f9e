#include "reference/mujoco/friction.h"

#include <cmath>

namespace hookpoint::reference {

std::array<Vector3d, 2> mujoco_tangents(const Vector3d& normal) {
  const Vector3d axis = std::abs(normal.y) < 0.5 ? Vector3d{0., 1., 0.} : Vector3d{0., 0., 1.};
  const Vector3d across = axis - dot(axis, normal) * normal;
  const Vector3d first = (1. / norm(across)) * across;
  return {first, cross(normal, first)};
}

}  // namespace hookpoint::reference
