// The law `impulse`: every contact, also a resting one, is a train of collisions (Mirtich 1996). A
// collision that is too weak to lift the point at the rebound speed u0 is given the energy to do
// so: that keeps a resting body bouncing, and creeping.
#pragma once

#include "contact/impulse/collision.h"
#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// Answers one collision: collision matrix K [1/kg], velocity u of the point [m/s] and unit normal
/// n, all in world axes, and the tile's material -> impulse on the robot [N s]. Reads
/// kinetic_friction, restitution and rebound_speed of the material. Cost and errors as
/// resolve_collision.
inline Collision impulse(const Symmetric3d& K, const Vector3d& u, const Vector3d& n,
                         const MaterialConstants<double>& material) {
  return resolve_collision(
      {K, u, n, material.kinetic_friction, material.restitution, material.rebound_speed});
}

}  // namespace hookpoint::contact
