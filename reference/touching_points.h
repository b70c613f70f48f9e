// What of a robot touches the ground in a peer: its boundary points as in our own engine, or, of a
// single body, its shapes.
#pragma once

#include <vector>

#include "contact/terrain/terrain.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

/// Of the ball in place of a boundary point of radius 0, in an engine that takes shapes only [m].
/// Its centre is at the point, and the ground that it meets is lowered by as much (ground_of).
inline constexpr double point_ball_radius = 1e-3;

/// A robot with chains, with a ContactPoint that the file names or without shapes on its base
/// touches by its boundary points; any other one by its shapes.
bool touches_by_points(const simulation::Experiment& experiment, int robot);

struct TouchingPoint {
  std::size_t body = 0;  ///< index in RobotTree::bodies
  int point = 0;         ///< index into BodySpec::boundary_points
  Vector3d p_BP;         ///< body axes [m]
  double radius = 0.;    ///< of the ball about it [m]
};

/// The boundary points of every body that can move, of robots that touch by points; bodies in
/// order.
std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const RobotTree& tree);

/// Where a point meets the ground: a ball at its centre less its radius along the normal of the
/// tile under the centre.
struct Meeting {
  Vector3d position;  ///< world axes [m]
  Vector3d normal;    ///< of the tile, out of the ground
  double depth = 0.;  ///< > 0 inside [m]
  int material = 0;   ///< of the tile, index into Experiment::materials
};
Meeting meet(const contact::Terrain& ground, const TouchingPoint& point,
             const simulation::BodyState& body);

/// How a named ContactPoint is published, under the force of the step that led to `body`. It slides
/// where it carries and its material moves along the tile faster than 1 mm/s: no library says which
/// of its contacts slip, and ODE's forces are not at their own limits there (docs).
simulation::PointState point_state(const Meeting& meeting, const simulation::BodyState& body,
                                   const Vector3d& force);

}  // namespace hookpoint::reference
