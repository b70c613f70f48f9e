// What of a robot touches in a peer: its shapes as they are, or boundary points as in our own engine.
#pragma once

#include <vector>

#include "contact/terrain/terrain.h"
#include "reference/robot_tree.h"

namespace hookpoint::reference {

/// Of the ball in place of a boundary point of radius 0, in an engine that takes shapes only [m].
/// Its centre is at the point, and the ground that it meets is lowered by as much.
inline constexpr double point_ball_radius = 1e-3;

/// Whether a shape touches by the library's own colliders: under `touch = shapes`, unless its samples
/// are to do so (ShapeSpec::boundary_points).
bool touches_as_it_is(const simulation::Experiment& experiment, const simulation::ShapeSpec& shape);
/// Those of a body, in its order.
std::vector<const simulation::ShapeSpec*> touching_shapes(const simulation::Experiment& experiment,
                                                          const simulation::BodySpec& body);

struct TouchingPoint {
  std::size_t body = 0;  ///< index in RobotTree::bodies
  int point = 0;         ///< index into BodySpec::boundary_points
  Vector3d p_BP;         ///< body axes [m]
  double radius = 0.;    ///< of the ball about it [m]
  int material = simulation::no_material;
};

/// Boundary points of every body that can move, but for the samples of shapes that touch as they are;
/// bodies in order.
std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const RobotTree& tree);
/// Of one body, counted as `body`.
std::vector<TouchingPoint> touching_points(const simulation::Experiment& experiment,
                                           const simulation::BodySpec& spec, std::size_t body);

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
