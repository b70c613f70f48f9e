// What a contact law reads and returns. A law is a pure function
//     (kinematics of a boundary point, committed memory, material, step) -> (force, next memory)
// of one point; it never mutates an anchor, so an integrator may evaluate it at as many trial
// states as it likes and commit the memory once, at the accepted state (docs/contact.md).
#pragma once

#include "math/vector3.h"

namespace hookpoint::contact {

/// What a law integrates along with the motion, of one point: its continuous state. A law says how
/// many of these numbers it has (`bristle_states`: 0, 3 or 4); those that it has not stay 0.
template <class Real>
struct Bristle {
  Vector3<Real> deflection;  ///< z (u), of the bristle along the tile, world axes [m]
  Real sliding{};            ///< S, from 0 sticking to 1 sliding
};

/// One boundary point against the tile under it. World axes, SI.
template <class Real>
struct PointKinematics {
  Vector3<Real> position;   ///< x, p_WP [m]
  Vector3<Real> velocity;   ///< dx/dt, v_WP [m/s]
  Vector3<Real> normal;     ///< unit normal of the tile, out of the ground
  Real depth{};             ///< delta, penetration along the normal, > 0 inside [m]
  Bristle<Real> bristle{};  ///< the integrator's, of the same instant
};

/// What a point remembers between steps. Plain value: copying it is a checkpoint.
template <class Real>
struct Memory {
  Vector3<Real> hook;     ///< h, the anchor on the ground [m]; meaningful while attached
  Vector3<Real> stretch;  ///< e_old, tangential part of x - h when the memory was committed [m]
  Mask<Real> attached{};  ///< the point was inside the ground at the commit
  Mask<Real> sliding{};   ///< the last commit was a slip: kinetic friction holds until the trial
                          ///< falls below it
};

template <class Real>
struct Reaction {
  Vector3<Real> force;  ///< on the robot, world axes [N]
  Memory<Real> next;    ///< to commit if the step is accepted
  /// The point's bristle, projected into the plane of the tile now under it and clipped to what its
  /// load can hold; an accepted state continues with it. 0 out of reach.
  Bristle<Real> bristle;
  Bristle<Real> bristle_rate;  ///< its time derivative [m/s, 1/s]
};

/// Constants of a tile's surface (docs/contact.md says which law reads which). SI.
template <class Real>
struct MaterialConstants {
  Real normal_stiffness{1e5};       ///< k [N/m]
  Real normal_damping{300.};        ///< c [N s/m]
  Real tangential_stiffness{1e5};   ///< k_t [N/m]
  Real tangential_damping{300.};    ///< c_t [N s/m]
  Real static_friction{0.8};        ///< mu_s
  Real kinetic_friction{0.8};       ///< mu_k
  Real nominal_penetration{1e-3};   ///< d0 [m]
  Real nominal_stiffness{1e4};      ///< k1 [N/m], law `nominal`
  Real blend_width{0.};             ///< w [m], over which k1 turns into k, law `nominal`
  Real restitution{0.};             ///< e, impulse laws
  Real exponent{1.5};               ///< n of k d^n, hunt_crossley
  Real hysteresis_damping{0.5};     ///< alpha, c [s/m], hunt_crossley, exponential
  Real regularisation_speed{1e-3};  ///< v_s [m/s], regularised Coulomb friction
  Real stribeck_speed{1e-2};        ///< v_St [m/s]: over which mu falls from static to kinetic
  Real viscous_friction{0.};        ///< sigma2 [N s/m], lugre, elastoplastic
  Real breakaway{0.7};              ///< fraction of mu_k N up to which a bristle is elastic,
                                    ///< elastoplastic
  Real exponential_force{0.5336};   ///< d1 [N], at height d0, exponential
  Real exponential_rate{1150.};     ///< d2 [1/m], exponential
  Real exponential_height{0.};      ///< d0 [m] above the tile, exponential
  Real sliding_time{0.01};          ///< tau [s], in which S follows stick and slip, exponential
  Real rebound_speed{1e-3};         ///< u0 [m/s], least rebound of a microcollision, impulse laws
  // Beside every force law (surface_forces.h).
  Real rolling_resistance{0.};   ///< b [m], lever of the load against rolling
  Real spinning_resistance{0.};  ///< s [m], the same against spin about the normal
  Real adhesion{0.};             ///< A [N], pull along the normal on each contact
  Real friction_across{0.};      ///< mu_k across the foot's x axis; 0: as along it
};

}  // namespace hookpoint::contact
