// What acts on bodies from outside over a step, one after the other: the experiment's forces, then
// the pull.
#pragma once

#include <vector>

#include "reference/robot_tree.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

/// The body of each ForceSpec, as published.
inline std::vector<std::size_t> forced_bodies(const simulation::Experiment& experiment,
                                              const RobotTree& tree) {
  std::vector<std::size_t> bodies;
  for (const simulation::ForceSpec& force : experiment.forces)
    bodies.push_back(tree.index(force.robot, force.body));
  return bodies;
}

/// `visit(body, force)`; `forced`: as above.
template <class Visit>
void for_each_force(const std::vector<std::size_t>& forced, const simulation::WorldInputs& inputs,
                    const Visit& visit) {
  for (std::size_t i = 0; i < forced.size(); ++i) visit(forced[i], inputs.forces[i]);
  if (inputs.pull.robot >= 0) visit(inputs.pull.index, inputs.pull.force);
}

}  // namespace hookpoint::reference
