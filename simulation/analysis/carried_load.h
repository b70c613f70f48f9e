// What carries a robot at its start: how much of its weight each touching point bears on which
// material, and how fast it comes down.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/terrain/terrain.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// The share of a material under the robot's carrying points.
struct CarriedLoad {
  int material = 0;        ///< index among the experiment's
  std::size_t points = 0;  ///< that carry the robot, on this material
  double mass = 0.;        ///< above each, the robot's that moves shared evenly [kg]
  double load = 0.;        ///< on each, mass times gravity [N]
  double least_mass = 0.;  ///< effective mass of an impact at one, joints free [kg]
  std::size_t body = 0;    ///< whose point that is, in the order of robot_tree.h
  int foot = no_material;  ///< material of that point's side
  /// Towards the ground, of its points when the lowest of them lands: by their speed at the start
  /// and the fall from there [m/s]; 0 for a robot that touches and does not come down.
  double impact_speed = 0.;
};

/// One a material under the robot's carrying points, of an experiment under engine dts and a force
/// law, at its initial state. Points carry a robot if they touch then; of a robot that does not
/// touch, those within 1 mm of its lowest. O(points * links).
std::vector<CarriedLoad> carried_loads(const Experiment& experiment, std::size_t robot,
                                       const contact::Terrain& terrain, const WorldInputs& inputs);

/// Throws ExperimentError where the foot's material states a stiffness or a damping: a contact is then of
/// both sides, and `who` computes the ground's constants alone.
void require_ground_alone(const Experiment& experiment, const CarriedLoad& carried,
                          const char* who);

}  // namespace hookpoint::simulation
