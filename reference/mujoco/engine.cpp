// MuJoCo as a peer: what it lacks, and its factory.
#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "reference/mujoco/world.h"
#include "reference/settings.h"

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;

std::vector<EngineGap> gaps() {
  using enum EngineGap::Handling;
  return common_gaps_and(
      {single_friction_gap,
       {feature::massless, refused,
        "every body of MuJoCo that moves has a mass; give the link one"},
       {feature::restitution, noticed,
        "MuJoCo has no coefficient of restitution: how a body rebounds follows from its contact's "
        "damping"},
       {feature::tile_softness, noticed,
        "the ratio of tangential to normal constants (impratio) is one for a world, the "
        "ground's"}});
}

}  // namespace

simulation::EngineDescription describe_mujoco() {
  const std::string version = mujoco_version();
  return {"mujoco", version, "double", !version.empty(), settings_names("mujoco"), gaps()};
}

std::unique_ptr<simulation::Engine> make_mujoco(const simulation::Experiment& experiment) {
  return make_peer_engine(experiment, describe_mujoco(), [&] {
    return make_mujoco_world(experiment,
                             mujoco_settings(settings_of(experiment, "mujoco"), experiment.deltat,
                                             ground_material(experiment)));
  });
}

}  // namespace hookpoint::reference
