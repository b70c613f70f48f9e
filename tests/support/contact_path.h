// Random paths of a boundary point over a plane, and a law run along them.
#pragma once

#include <rapidcheck.h>

#include <functional>
#include <vector>

#include "contact/vocabulary.h"
#include "math/rotation.h"

namespace hookpoint::test_support {

using contact::Bristle;
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
  material.nominal_penetration = number(1e-4, 1e-3);
  material.nominal_stiffness = number(1e3, 1e6);
  material.blend_width = std::max(0., number(-5e-4, 5e-4));
  material.stribeck_speed = number(1e-3, 0.5);
  material.viscous_friction = number(0., 50.);
  material.breakaway = number(0.1, 1.);
  material.exponential_force = number(0.1, 10.);
  material.exponential_rate = number(100., 2000.);
  material.exponential_height = number(0., 1e-3);
  material.sliding_time = number(1e-4, 0.1);
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
  return {path[k], (1. / dt) * (path[k] - path[k - 1]), normal, -dot(path[k] - origin, normal), {}};
}

/// The bristle one step after a state that `reaction` was for, by explicit Euler.
inline Bristle<double> bristle_after(const Reaction<double>& reaction, double dt) {
  return {reaction.bristle.deflection + dt * reaction.bristle_rate.deflection,
          reaction.bristle.sliding + dt * reaction.bristle_rate.sliding};
}

/// The point as an accepted state goes on: with `bristle`, where the law holds it.
template <class Law>
PointKinematics<double> accepted(PointKinematics<double> point, const Bristle<double>& bristle,
                                 const MaterialConstants<double>& material, double dt) {
  point.bristle = bristle;
  point.bristle = Law::evaluate(point, {}, material, dt).bristle;
  return point;
}

/// Law::evaluate as one piece of machine code: where it is inlined, rounding may differ from place to
/// place (a product and a sum are contracted or not).
template <class Law>
[[gnu::noinline]] Reaction<double> reaction_of(const PointKinematics<double>& point,
                                               const Memory<double>& memory,
                                               const MaterialConstants<double>& material,
                                               double dt) {
  return Law::evaluate(point, memory, material, dt);
}

/// The law's reactions at path[1], path[2], ..., each from the memory committed by the one before.
/// `meanwhile(k, memory)` is called before each.
template <class Law>
[[gnu::noinline]] std::vector<Reaction<double>> reactions_along(
    const std::vector<Vector3d>& path, const Vector3d& normal,
    const MaterialConstants<double>& material, double dt, const Vector3d& origin = {},
    const std::function<void(std::size_t k, const Memory<double>& memory)>& meanwhile = {}) {
  std::vector<Reaction<double>> reactions;
  Memory<double> memory;
  Bristle<double> bristle;
  for (std::size_t k = 1; k < path.size(); ++k) {
    if (meanwhile) meanwhile(k, memory);
    const auto point = accepted<Law>(point_at(path, k, normal, dt, origin), bristle, material, dt);
    reactions.push_back(reaction_of<Law>(point, memory, material, dt));
    memory = reactions.back().next;
    bristle = bristle_after(reactions.back(), dt);
  }
  return reactions;
}

}  // namespace hookpoint::test_support
