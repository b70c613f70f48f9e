// The law `impulse_reversal`: `impulse` with Mirtich's remedy against creep. A microcollision
// reverses the whole velocity that a point gains in one short flight, not only its normal part, so
// that every flight undoes the slip of the one before.
//
// A body at rest touches with several points at once, and no one of them can reverse its own
// velocity inside its cone; so the points near the ground are reversed together: find impulses p_i,
// each in its cone, with
//     u_i + sum_j K_ij p_j = u_i',      u_i' = -a_i u0/|a_n|,
// where a_i is the acceleration of point i in flight. If there are none, as much as can be of the
// tangential part is reversed, down to none (the points are stopped together); and if not even
// that, the collision is that of `impulse`.
#pragma once

#include <span>

#include "contact/impulse/impulse.h"
#include "math/matrix3.h"

namespace hookpoint::contact {

/// What the law `impulse_reversal` says of itself.
struct ImpulseReversal {
  static constexpr ImpulseLaw law = ImpulseLaw::impulse_reversal;
  static constexpr const char* name = "impulse_reversal";
  static constexpr const char* source = "Mirtich 1996";
  static constexpr const char* summary =
      "as impulse, but a rebound inside the cone reverses the whole velocity";
  static constexpr ConstantList constants = Impulse::constants;
  static constexpr ConstantList own_constants = Impulse::own_constants;

  /// Every flight undoes the slip of the one before: 0 [m/s].
  static std::optional<double> creep_speed(double /*tangent_of_slope*/, bool /*single_point*/,
                                           const Constants& /*material*/) {
    return 0.;
  }
  /// No closed form.
  static std::optional<double> impact_rate(double /*gravity*/, const Constants& /*material*/) {
    return std::nullopt;
  }
};

/// A collision is a microcollision while every point of its group moves along its normal slower
/// than this many u0. In a sustained contact |u_n| is u0; higher reverses landings too.
inline constexpr double microcollision_limit = 4.;

/// A point that takes part. World axes, SI.
struct ReversalPoint {
  Vector3d arm;      ///< from the centre of mass of a single body [m]
  Vector3d normal;   ///< unit, out of the ground
  double mu = 0.;    ///< coefficient of friction
  Vector3d gain;     ///< what flight adds to u until u_n = -u0, a_i u0/|a_n| [m/s]
  Symmetric3d K;     ///< collision matrix of the point, K_ii [1/kg]
  Vector3d impulse;  ///< result: p on the robot, in the cone [N s]
};

/// Velocity of the centre of mass [m/s] and angular velocity [rad/s], world axes.
struct Twist {
  Vector3d velocity, angular_velocity;
};

/// Finds the impulses that send every point of a single body off at -gain, to within `tolerance`
/// [m/s], by block Gauss-Seidel with projection on the cones; with the tangential part of -gain
/// times the greatest share in [0, 1] for which there are any (to 1/16). Result: whether there are.
/// `twist` is the body's before them. Cost: some 0.1 us a point and sweep, at most 400 sweeps a
/// share. No allocation. Source: Mirtich 1996 (the remedy, for one point); Jean & Moreau 1992 (the
/// sweeps).
bool reverse_together(std::span<ReversalPoint> points, double mass,
                      const Symmetric3d& inverse_inertia, const Twist& twist, double tolerance);

/// The same for any robot: `couplings` K_ij [1/kg], the velocity change of point i for a unit
/// impulse at point j, at i * points + j; `before` the points' velocities u_i [m/s]; `work` as many
/// numbers to work in.
bool reverse_together(std::span<ReversalPoint> points, std::span<const Matrix3d> couplings,
                      std::span<const Vector3d> before, std::span<Vector3d> work, double tolerance);

}  // namespace hookpoint::contact
