// A build without MuJoCo: the engine is known by name, and says that it is missing.
#include "reference/mujoco/world.h"

namespace hookpoint::reference {

std::string mujoco_version() { return {}; }

std::unique_ptr<PeerWorld> make_mujoco_world(const simulation::Experiment& /*experiment*/,
                                             const MujocoSettings& /*settings*/) {
  throw simulation::ExperimentError(
      "engine mujoco: this build has none; install libmujoco-dev and build again");
}

}  // namespace hookpoint::reference
