// A single rigid body at rest on a plane, as the closed forms of the peers' creep want it.
#pragma once

#include <optional>
#include <vector>

#include "simulation/experiment.h"

namespace hookpoint::reference {

/// A rigid body that lies on a slope.
struct RestingBody {
  const simulation::MassSpec* mass;
  Quaterniond orientation;
  Vector3d normal;               ///< of the ground, unit
  Vector3d downhill;             ///< unit, along the fall
  double pull = 0., press = 0.;  ///< parts of m g along the fall and into the ground [N]
  std::vector<Vector3d> arms;    ///< of the touching points from the centre of mass, world axes [m]
};

/// The experiment's one robot on its slope; `mass` points into the experiment. Nothing where there
/// is another robot, a chain, a grid, no fall, or a shape that is no single box.
std::optional<RestingBody> resting_body(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
