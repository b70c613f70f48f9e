// Random paths of a boundary point over a plane, and a law run along them.
#pragma once

#include <rapidcheck.h>

#include <vector>

#include "contact/vocabulary.h"
#include "math/rotation.h"

namespace hookpoint::test_support {

using contact::MaterialConstants;
using contact::Memory;
using contact::PointKinematics;
using contact::Reaction;

/// A number from `low` to `high` on a lattice of a million points, whatever rapidcheck's size.
inline double number(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 1000001)) * 1e-6;
}

inline MaterialConstants<double> any_material() {
  MaterialConstants<double> material;
  material.normal_stiffness = number(1e3, 1e6);
  material.normal_damping = number(0., 1e3);
  material.tangential_stiffness = number(1e3, 1e6);
  material.tangential_damping = number(0., 1e3);
  material.kinetic_friction = number(0., 1.);
  material.static_friction = material.kinetic_friction + number(0., 0.5);
  material.exponent = number(1., 2.);
  material.hysteresis_damping = number(0., 2.);
  return material;
}

inline Quaterniond any_rotation() {
  return exponential(Vector3d{number(-2., 2.), number(-2., 2.), number(-2., 2.)});
}

/// Positions one step apart, about the level plane through the origin, mostly inside the ground;
/// the first is outside.
/// Start and floor are off the lattice of the moves, so that no depth is exactly 0, where
/// touch-down is discontinuous.
inline std::vector<Vector3d> any_path(std::size_t steps = 40) {
  constexpr double deepest = -1.0000123456e-3;
  std::vector<Vector3d> path{{0., 0., 1.234567891e-4}};
  for (std::size_t i = 0; i < steps; ++i) {
    const double lift = number(-2.3e-4, 2e-4);
    path.push_back({path.back().x + number(-5e-4, 5e-4), path.back().y + number(-5e-4, 5e-4),
                    std::max(deepest, path.back().z + lift)});
  }
  return path;
}

/// The point at path[k] with the velocity that took it there, over the plane through `origin` with
/// unit normal `normal`.
inline PointKinematics<double> point_at(const std::vector<Vector3d>& path, std::size_t k,
                                        const Vector3d& normal, double dt,
                                        const Vector3d& origin = {}) {
  return {path[k], (1. / dt) * (path[k] - path[k - 1]), normal, -dot(path[k] - origin, normal)};
}

/// The law's reactions at path[1], path[2], ..., each from the memory committed by the one before.
template <class Law>
std::vector<Reaction<double>> reactions_along(const std::vector<Vector3d>& path,
                                              const Vector3d& normal,
                                              const MaterialConstants<double>& material, double dt,
                                              const Vector3d& origin = {}) {
  std::vector<Reaction<double>> reactions;
  Memory<double> memory;
  for (std::size_t k = 1; k < path.size(); ++k) {
    reactions.push_back(Law::evaluate(point_at(path, k, normal, dt, origin), memory, material, dt));
    memory = reactions.back().next;
  }
  return reactions;
}

}  // namespace hookpoint::test_support
