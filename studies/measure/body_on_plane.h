// A robot on a plane as the closed forms of docs/contact.md name its quantities.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "studies/measure/metric.h"

namespace hookpoint::studies {

/// Loads of the points of a rigid footprint along the normal.
struct NormalLoads {
  std::vector<double> at_points;  ///< > 0 [N]
  double across = 0.;             ///< how they grow along normal x along [N/m]
};

struct BodyOnPlane {
  double mass = 0., gravity = 0.;
  double sine = 0., cosine = 1.;  ///< of the slope theta
  /// From the centre of mass to where it touches, points or the lowest points of balls, in the
  /// plane [m].
  std::vector<Vector3d> footprint;
  double height = 0.;  ///< of the centre of mass above these [m]
  double gap = 0.;     ///< between the lowest of them and the plane at the start [m]
  /// The contacts are not level: how they share the load is not known.
  bool uneven = false;
  bool single_point = false;  ///< the robot has one boundary point: it cannot rock
  double speed = 0.;          ///< initial, in the plane; 0 of one that starts with its creep [m/s]
  bool settled = false;       ///< starts in balance: its tangential springs hold it already
  contact::MaterialConstants<double> material;
  const contact::LawDescription* law = nullptr;  ///< of engine dts
  bool peer = false;

  double contacts() const { return static_cast<double>(footprint.size()); }
  double tangent() const { return sine / cosine; }
  bool level() const { return sine < 1e-9; }
  double normal_load() const { return mass * gravity * cosine / contacts(); }
  bool sticks() const { return contact::holds_on_slope(tangent(), material.static_friction); }
  /// Whether friction falls from static to kinetic at once where a point breaks away.
  bool friction_drops() const;
  /// What of the steady friction a body carries at most that starts at rest: 1 of one that starts
  /// in balance. Springs which are not stretched yet swing past their rest, less where they are
  /// damped.
  double overshoot() const;
  /// Stiffness of all touching points along the plane [N/m]; 0 for a law without such springs.
  double tangential_stiffness() const;
  double slip_acceleration() const;
  /// Normal loads of the touching points [N], those of equal linear springs under the rigid body,
  /// which has its weight's part along `normal` and the moment `moment` [N m] of the friction up
  /// `along` about the centre of mass. Nothing where a point would lift or the points lie on a
  /// line.
  std::optional<NormalLoads> normal_loads(double moment, const Vector3d& along,
                                          const Vector3d& normal) const;
  /// Of our law: whether depth is proportional to load, so that a rigid footprint's loads are those
  /// of linear springs.
  bool linear_normal_force() const;
  /// Of each touching point [N].
  double friction_load() const;
};

/// Whether the measured robot's base is free, or kept in a plane that holds gravity and the
/// ground's normal, out of which nothing pushes it.
bool moves_as_if_free(const RunContext& context);

/// Why the scene is not one robot on a plane that nothing but gravity and the ground acts on; ""
/// where it is.
std::string not_alone_on_plane(const RunContext& context);

/// Why most closed forms do not apply: they require one rigid body that cannot roll, alone on a
/// plane. "" where they do.
std::string not_one_rigid_body(const RunContext& context);

/// Whether the measured robot is a ball: a single body that touches with one ball alone.
bool is_ball(const RunContext& context);

/// Why a robot that stands on the level does not rest as one rigid body would: gravity or the
/// ground turns a joint, or something else moves one at the start. "" where it does. A single rigid
/// body may be one that could roll: on the level it rests.
std::string not_resting_as_one_body(const RunContext& context);

/// Height of the lowest of what may touch over the ground at the start [m]; 0 where nothing may.
double lowest_gap(const RunContext& context);

/// The measured robot, its links where they are at the start; it must be alone on a plane. One that
/// starts in balance is taken level, before it leaned.
BodyOnPlane body_on_plane(const RunContext& context);

}  // namespace hookpoint::studies
