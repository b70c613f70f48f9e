// A single rigid body at rest on a plane, as the closed forms of the peers' creep want it.
#pragma once

#include <optional>
#include <vector>

#include "simulation/experiment/closed_form.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// A rigid body that lies on a slope.
struct RestingBody {
  const simulation::MassSpec* mass;
  Quaterniond orientation;
  Vector3d normal;               ///< of the ground, unit
  Vector3d downhill;             ///< unit, along the fall
  Vector3d across;               ///< normal x downhill
  double pull = 0., press = 0.;  ///< parts of m g along the fall and into the ground [N]
  /// From the centre of mass to where it touches: touching points, or the lowest points of balls
  /// about them; world axes [m].
  std::vector<Vector3d> arms;
  std::vector<double> radii;  ///< of the balls that touch there; 0 of a point [m]
  Vector3d origin;            ///< of the body's frame from the centre of mass, world axes [m]

  /// `a` of world axes along downhill, across and the normal.
  Vector3d in_slope(const Vector3d& a) const {
    return {dot(a, downhill), dot(a, across), dot(a, normal)};
  }
};

/// The experiment's one robot on its slope; `mass` points into the experiment. No closed form where
/// there is another robot, a chain, a grid, no fall, a shape that is no single box, or where the
/// body can roll.
simulation::ClosedForm<RestingBody> resting_body(const simulation::Experiment& experiment);

/// Normal loads a + b x + c y [N, N/m, N/m] of touching points at x downhill and y across from the
/// centre of mass: those of equal springs under a rigid body. They add up to `press`, and their
/// moment about the centre of mass is that of a `friction` [N] up the slope. No closed form for
/// fewer than three points, or points on one line.
simulation::ClosedForm<Vector3d> normal_loads(const RestingBody& body, double friction);
/// The load on the touching point `arm`.
double load_at(const RestingBody& body, const Vector3d& loads, const Vector3d& arm);

}  // namespace hookpoint::reference
