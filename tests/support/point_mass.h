// A point mass on the plane z = 0 under one contact law, with integrators of its own: what the
// truths of the laws are measured on.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/contact_path.h"

namespace hookpoint::test_support {

constexpr double g = 9.81;

/// Gravity is tilted by `slope` towards the direction `azimuth`: the slope's own axes.
struct PointMass {
  double mass = 1., slope = 0., azimuth = 0.;
  MaterialConstants<double> material{};
  Vector3d position{}, velocity{}, ground_force{};
  Memory<double> memory{};
  Bristle<double> bristle{};
  double pull = 1.;  ///< part of the weight along the slope that acts
  Vector3d push{};   ///< a force besides the weight [N]

  Vector3d downhill() const { return {std::cos(azimuth), std::sin(azimuth), 0.}; }
  Vector3d weight() const {
    return pull * tangential_load() * downhill() - normal_load() * Vector3d{0., 0., 1.};
  }
  double normal_load() const { return mass * g * std::cos(slope); }
  double tangential_load() const { return mass * g * std::sin(slope); }
  double downhill_position() const { return dot(position, downhill()); }
  double downhill_speed() const { return dot(velocity, downhill()); }

  /// At rest where springs k and a hook at the origin carry the weight.
  void settle() {
    position = (tangential_load() / material.tangential_stiffness) * downhill() -
               normal_load() / material.normal_stiffness * Vector3d{0., 0., 1.};
    memory = {{}, tangential(position, {0., 0., 1.}), true, false};
  }
  /// Semi-implicit Euler; the bristle has moved with the velocity, as the position has.
  template <class Law>
  void step(double dt) {
    PointKinematics<double> point{position, velocity, {0., 0., 1.}, -position.z, bristle};
    point.bristle = Law::evaluate(point, memory, material, dt).bristle;
    bristle = bristle_after(Law::evaluate(point, memory, material, dt), dt);
    point.bristle = bristle;
    const auto reaction = Law::evaluate(point, memory, material, dt);
    ground_force = reaction.force;
    memory = reaction.next;
    velocity += dt / mass * (weight() + push + ground_force);
    position += dt * velocity;
  }
  template <class Law>
  void run(double dt, double duration) {
    const auto steps = static_cast<long>(std::lround(duration / dt));
    for (long i = 0; i < steps; ++i) step<Law>(dt);
  }
  /// The pull grows from 0 to the whole over `duration`, by half a cosine.
  template <class Law>
  void load_slowly(double dt, double duration) {
    const auto steps = static_cast<long>(std::lround(duration / dt));
    for (long i = 0; i < steps; ++i) {
      pull = 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i + 1) /
                                  static_cast<double>(steps));
      step<Law>(dt);
    }
  }
};

inline MaterialConstants<double> well_damped() {
  MaterialConstants<double> material;
  material.normal_stiffness = 2e4;
  material.tangential_stiffness = 1e4;
  material.normal_damping = 200.;
  material.tangential_damping = 150.;
  return material;
}

}  // namespace hookpoint::test_support
