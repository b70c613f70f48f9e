// The experiment as a MuJoCo world.
#pragma once

#include <memory>

#include "reference/peer_engine.h"

namespace hookpoint::reference {

/// Throws ExperimentError where MuJoCo's compiler refuses the model.
std::unique_ptr<PeerWorld> make_mujoco_world(const simulation::Experiment& experiment,
                                             Settings settings);

}  // namespace hookpoint::reference
