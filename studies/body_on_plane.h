// A robot on a plane as the closed forms of docs/contact.md name its quantities.
#pragma once

#include <optional>
#include <vector>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/metric.h"

namespace hookpoint::studies {

struct BodyOnPlane {
  double mass = 0., gravity = 0.;
  double sine = 0., cosine = 1.;    ///< of the slope theta
  std::vector<Vector3d> footprint;  ///< touching points from the centre of mass, in the plane [m]
  double height = 0.;               ///< of the centre of mass above the touching points [m]
  double gap = 0.;                  ///< between the lowest point and the plane at the start [m]
  bool single_point = false;        ///< the robot has one boundary point: it cannot rock
  double speed = 0.;                ///< initial, in the plane [m/s]
  contact::MaterialConstants<double> material;
  std::optional<contact::AnyForceLaw> law;  ///< of engine dts
  bool peer = false;

  double contacts() const { return static_cast<double>(footprint.size()); }
  double tangent() const { return sine / cosine; }
  bool level() const { return sine < 1e-9; }
  double normal_load() const { return mass * gravity * cosine / contacts(); }
  bool sticks() const { return contact::holds_on_slope(tangent(), material.static_friction); }
  double slip_acceleration() const;
  /// Of each touching point [N].
  double friction_load() const;
};

/// Whether the measured robot's base is free, or kept in a plane that holds gravity and the
/// ground's normal, out of which nothing pushes it.
bool moves_as_if_free(const RunContext& context);

/// The closed forms want: one rigid body that cannot roll, a plane, no other forces.
bool one_rigid_body(const RunContext& context);

/// Whether a robot with chains stands on the level as if it were one rigid body: gravity turns no
/// joint and nothing else moves one at the start.
bool stands_as_one_body(const RunContext& context);

/// The measured robot, its links where they are at the start. One of the two conditions above must
/// hold.
BodyOnPlane body_on_plane(const RunContext& context);

}  // namespace hookpoint::studies
