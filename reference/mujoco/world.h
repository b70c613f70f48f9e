// The experiment as a MuJoCo world.
#pragma once

#include <memory>
#include <string>

#include "reference/peer_engine.h"
#include "reference/settings.h"

namespace hookpoint::reference {

/// The library's version; empty where the build has none.
std::string mujoco_version();

/// Throws ExperimentError where MuJoCo's compiler refuses the model, or the build has
/// none.
std::unique_ptr<PeerWorld> make_mujoco_world(const simulation::Experiment& experiment,
                                             const MujocoSettings& settings);

}  // namespace hookpoint::reference
