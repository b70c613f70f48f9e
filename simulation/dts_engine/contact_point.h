// A boundary point of a robot as a place on the ground, and what it remembers.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/terrain/rolling.h"
#include "contact/terrain/terrain.h"
#include "contact/vocabulary.h"
#include "dts/workspace.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct BoundaryPoint {
  std::size_t body = 0;             ///< 0 the base, then links chain by chain
  Vector3d p_BP;                    ///< body axes [m]
  double radius = 0.;               ///< of the ball about p_BP; 0 of a point [m]
  int foot_material = no_material;  ///< of its shape, point or body
};

/// Those of all bodies that can move, body by body: a fixed base cannot be moved by the ground.
std::vector<BoundaryPoint> boundary_points(const RobotSpec& robot);

/// A boundary point and what the law made of it at the accepted state that was evaluated last.
struct ContactPoint : BoundaryPoint {
  contact::Memory<double> before;     ///< what `committed` was before the last step, to undo it
  contact::Memory<double> committed;  ///< of the accepted state before this one
  contact::Memory<double> pending;    ///< to be committed when the step from this state is taken
  /// Of a ball: how it stood when `before`, `committed` and `pending` were made.
  contact::BallFrame before_frame, committed_frame, pending_frame;
  Vector3d position;    ///< where it touches: p_WP less radius times the normal [m]
  Vector3d normal;      ///< of the tile under p_WP
  double depth = 0.;    ///< > 0 inside the ground [m]
  int material = 0;     ///< of the tile under it
  Vector3d force;       ///< on the robot, world axes [N]
  Vector3d moment;      ///< likewise, of resistance to rolling and spinning [N m]
  bool inside = false;  ///< the law reached it at the accepted state before this one

  /// Changes sign where the point leaves its side, just behind that surface: there it is on the
  /// other side, and the event is not met again at its own restart.
  double side_event(double depth_now, double reach) const;

  /// The step from the evaluated state is taken.
  void commit() {
    committed = pending;
    if (radius > 0.) committed_frame = pending_frame;
  }
  /// The ground is far below: no force, and nothing to remember.
  void leave_ground() {
    pending = {};
    force = {};
    inside = false;
  }
  /// The committed memory as a ball that now stands in `now` has carried it along.
  contact::Memory<double> carried(const contact::BallFrame& now) const;
};

/// The depth that the law gets from an adaptive integrator: a point stays on its side of the
/// surface where the law begins, `reach` above the ground [m], until the event at which it crosses
/// has been reached, so that no step meets a jump. `inside`: it is on the ground's side.
double depth_on_side(bool inside, double depth_now, double reach);

/// Where a boundary point meets the ground: a ball at its centre less its radius along the normal
/// of the tile under the centre.
struct ContactKinematics {
  Vector3d position;        ///< [m]
  Vector3d velocity;        ///< of the body's material there [m/s]
  contact::TilePoint tile;  ///< with the depth of `position`
};
ContactKinematics contact_kinematics(const ContactPoint& point, const dts::BodyMotion<double>& body,
                                     const contact::Terrain& ground);
/// The x axis of a body, world axes: along it `kinetic_friction` holds, across it `friction_across`.
inline Vector3d x_axis(const dts::BodyMotion<double>& body) {
  return {body.R_WB.xx, body.R_WB.yx, body.R_WB.zx};
}
/// How the ball of a boundary point stands; a point needs none.
contact::BallFrame ball_frame(const ContactPoint& point, const dts::BodyMotion<double>& body,
                              const contact::TilePoint& tile);

}  // namespace hookpoint::simulation
