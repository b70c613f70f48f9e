// The sliding flow of a collision in contact axes: the tangential velocity in polar form, s = |u_t|
// and its direction (c, d) = u_t/s, driven by friction mu (Mirtich 1996, chapter 3; Bhatt &
// Koechling 1995).
#pragma once

#include "math/matrix3.h"

namespace hookpoint::contact {

/// Contact axes e1, e2, n in which the tangential 2x2 block of K is diagonal: e1, e2 are that
/// block's eigenvectors, so nothing depends on the axes in which the problem came.
struct CollisionAxes {
  Vector3d e1, e2, n;
  double k1 = 0., k2 = 0.;  ///< coupling e_i . K n [1/kg]
  double a1 = 0., a2 = 0.;  ///< eigenvalues of the tangential block [1/kg]
  double knn = 0.;          ///< n . K n [1/kg]
};
CollisionAxes collision_axes(const Symmetric3d& K, const Vector3d& n);

/// d/dp_n of (|u_t|, direction angle times |u_t|, u_n) while sliding along the unit tangent (c, d),
/// and the derivative of `turn` over the direction angle: where it is negative, a direction that
/// hardly turns will go on not to.
struct SlidingRates {
  double speed, turn, normal, turn_gradient;
};
inline SlidingRates sliding_rates(const CollisionAxes& axes, double mu, double c, double d) {
  const double g1 = axes.k1 - mu * axes.a1 * c;
  const double g2 = axes.k2 - mu * axes.a2 * d;
  return {g1 * c + g2 * d, g2 * c - g1 * d, axes.knn - mu * (axes.k1 * c + axes.k2 * d),
          mu * (axes.a1 - axes.a2) * (c * c - d * d) - axes.k1 * c - axes.k2 * d};
}

/// Tangential impulse per normal impulse once the sliding has stopped: the friction that holds the
/// point if it is inside the cone, else friction at the limit while the point slides off along the
/// one direction in which it can.
struct StoppedFriction {
  double f1, f2;  ///< components along e1, e2
  double normal;  ///< du_n/dp_n [1/kg]
};
StoppedFriction stopped_friction(const CollisionAxes& axes, double mu);

/// A point of the collision's path. s, c, d as above; p in contact axes [N s]; W the work of the
/// normal impulse [J].
struct CollisionPoint {
  double s = 0., c = 1., d = 0.;
  double p1 = 0., p2 = 0., pn = 0.;
  double W = 0.;
};

/// One Dormand-Prince 5(4) step of the sliding flow over dtau = dp_n/s, the parameter in which the
/// flow is smooth up to the standstill: (c, d)' = turn (-d, c), s' = speed s, p' = s (-mu c, -mu d,
/// 1), W' = s u_n. `un` is u_n at the collision's start [m/s]. `error` receives the estimated local
/// error of u_t [m/s].
CollisionPoint sliding_step(const CollisionAxes& axes, double mu, double un,
                            const CollisionPoint& from, double dtau, double* error);

/// u_n at `point` of a collision that began with `un` [m/s].
inline double normal_velocity(const CollisionAxes& axes, double un, const CollisionPoint& point) {
  return un + axes.k1 * point.p1 + axes.k2 * point.p2 + axes.knn * point.pn;
}

}  // namespace hookpoint::contact
