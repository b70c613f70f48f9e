// The path of one foot relative to the body: carried along by the ground in stance, through the air
// in swing.
#pragma once

#include "math/vector3.h"

namespace hookpoint::control {

/// The body's motion over level ground, body axes: x forward, y left [m/s], about z up [rad/s].
struct PlanarTwist {
  double forward = 0., sideways = 0., turn = 0.;
};

/// Where a point of the ground, now at `p` (body axes, m), is after the body has moved with `twist`
/// for `time` [s]; negative: was. Exact for constant twist.
Vector3d carried(const Vector3d& p, const PlanarTwist& twist, double time);

/// The velocity of a point of the ground as the body sees it, -(v + w x p) [m/s].
Vector3d ground_velocity(const Vector3d& p, const PlanarTwist& twist);

/// What a stance foot does with its contact sensor.
struct GroundSearch {
  bool sensed = false;   ///< there is a sensor
  bool contact = false;  ///< what it says
  double depth = 0.;     ///< how far below the nominal ground the foot looks for it [m]
  double speed = 0.;     ///< how fast [m/s]
};

/// How a foot swings.
struct SwingHeight {
  double step_height = 0.;  ///< above the ground, halfway [m]
  double lift = 0.;         ///< part of the swing in which it rises before it goes forwards
};

/// One foot relative to the body; plain values, so that whoever holds it can save it.
struct FootPath {
  Vector3d position;  ///< body axes; z is the height over the nominal ground [m]
  Vector3d origin,
      origin_velocity;  ///< where the last swing began and how fast the ground moved there [m, m/s]
  double progress = -1.;  ///< through the swing, 0 to 1; negative in stance

  bool swinging() const { return progress >= 0.; }
  /// Carried by the ground for `dt` [s]; without contact the foot sinks in search of it, with
  /// contact it returns to nominal height.
  void stand(const PlanarTwist& twist, double dt, const GroundSearch& search);
  void lift_off(const PlanarTwist& twist);
  /// `done` 0...1 of the way to `target`, `duration` [s] the whole way. Horizontally the cubic
  /// (Hermite) that leaves and meets the ground with the ground's own velocity; the height
  /// step_height 64 s^3 (1 - s)^3, at rest at both ends. With `lift` > 0 it stays over where it
  /// lifted off for that part of the swing, and over its target for as long at the end; its height
  /// grows and falls by the quintic 10 r^3 - 15 r^4 + 6 r^5 in twice that time.
  void swing(double done, const Vector3d& target, const PlanarTwist& twist, double duration,
             const SwingHeight& height);
  void touch_down() { progress = -1.; }
};

}  // namespace hookpoint::control
