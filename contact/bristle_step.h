// A law's bristle over one step, for whoever integrates it beside positions and velocities.
#pragma once

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// The contact point with its bristle projected into the tile's plane and clipped to what the
/// present load can hold (Reaction::bristle). Once a step.
template <class Law, class Real>
PointKinematics<Real> held_point(const Law& law, PointKinematics<Real> point,
                                 const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
  if constexpr (Law::bristle_states > 0)
    point.bristle = law.evaluate(point, memory, material, dt).bristle;
  return point;
}

/// The reaction under an integrator whose positions move with the new velocities: position and
/// depth are those at the end of a step `dt` [s], the bristle is that of its beginning. The force
/// comes from the bristle moved to the end by its own rate; a force from the bristle left behind
/// would pump energy into its spring, as explicit Euler does. Bristle and rate of the reaction are
/// those of the beginning. Two evaluations for a law with a bristle.
template <class Law, class Real>
Reaction<Real> reaction_with_moved_bristle(const Law& law, PointKinematics<Real> point,
                                           const Memory<Real>& memory,
                                           const MaterialConstants<Real>& material,
                                           const Real& dt) {
  Reaction<Real> reaction = law.evaluate(point, memory, material, dt);
  if constexpr (Law::bristle_states > 0) {
    point.bristle.deflection = reaction.bristle.deflection + dt * reaction.bristle_rate.deflection;
    point.bristle.sliding = reaction.bristle.sliding + dt * reaction.bristle_rate.sliding;
    const Reaction<Real> moved = law.evaluate(point, memory, material, dt);
    reaction.force = moved.force;
    reaction.next = moved.next;
  }
  return reaction;
}

}  // namespace hookpoint::contact
