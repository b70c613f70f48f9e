// One frictional collision at one point, after Mirtich 1996 (chapter 3): the normal impulse p_n
// plays the part of time, and the relative velocity u of the contact point is integrated over it
// under Coulomb's law,
//     du/dp_n = K (n - mu u_t/|u_t|)          while it slides,
//     du_t/dp_n = 0                           while it sticks and the friction that this takes is
//     inside the cone,
// through compression (until u_n = 0) and restitution (Stronge's energetic hypothesis). The law
// knows of the bodies only the collision matrix K, so it serves a single rigid body and an
// articulated robot alike (docs/contact_impulse.md).
#pragma once

#include "math/matrix3.h"

namespace hookpoint::contact {

/// What a collision is made of. Any one set of axes (world or contact), SI.
struct CollisionProblem {
  Symmetric3d K;  ///< collision matrix, du = K dp, symmetric positive definite [1/kg]
  Vector3d u;  ///< velocity of the robot's point relative to the ground before the collision [m/s]
  Vector3d n;  ///< unit normal, out of the ground
  double mu = 0.;             ///< Coulomb's coefficient of friction, >= 0
  double restitution = 0.;    ///< e: the restored share of the compression work is e^2, 0 <= e <= 1
  double rebound_speed = 0.;  ///< u0: restitution lasts at least until u_n = u0, >= 0 [m/s]
};

struct Collision {
  Vector3d
      impulse;  ///< p on the robot, axes of the problem [N s]; zero if the point does not approach
  bool solved = true;  ///< false: a number is not finite or K is not positive definite
};

/// The impulse of one collision. Exact where the sliding direction is constant (K isotropic in the
/// tangent plane and without coupling, motion in a plane of symmetry, sticking), else integrated
/// adaptively to about 1e-8 of the impulse. Result: |p_t| <= mu p_n; the kinetic energy does not
/// grow for e <= 1, except by what lifts u_n to u0. Cost: about 0.1 us in closed form, a few us
/// otherwise. No allocation. Source: Mirtich 1996, chapter 3; Stronge 1990 for the
/// restitution; Bhatt & Koechling 1995 for the flow.
Collision resolve_collision(const CollisionProblem& problem);

}  // namespace hookpoint::contact
