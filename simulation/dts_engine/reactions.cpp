#include "simulation/dts_engine/reactions.h"

#include "dts/body_accelerations.h"
#include "dts/forward_dynamics.h"

namespace hookpoint::simulation {

Reactions::Reactions(const ArticulatedRobot& robot)
    : robot_(robot),
      workspace_(robot.workspace()),
      torques_(robot.model().link_count()),
      accelerations_(robot.model().body_count()),
      wrenches_(robot.model().body_count()) {}

void Reactions::publish(std::span<JointReaction> reactions) {
  workspace_ = robot_.workspace();
  robot_.find_torques(torques_);
  robot_.constraints().add_forces(workspace_, torques_);
  const Vector3d& gravity = robot_.gravity();
  dts::forward_dynamics<double>(robot_.model(), gravity, torques_, workspace_);
  dts::body_accelerations<double>(robot_.model(), robot_.state(), workspace_, accelerations_);
  dts::joint_reactions<double>(robot_.model(), gravity, workspace_, accelerations_, wrenches_);
  for (std::size_t link = 0; link < reactions.size(); ++link)
    reactions[link] = {wrenches_[link + 1].force, wrenches_[link + 1].moment};
}

}  // namespace hookpoint::simulation
