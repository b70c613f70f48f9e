#include "simulation/dts_engine/loop_assembly.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dts/forward_kinematics.h"
#include "simulation/dts_engine/constraint_set.h"
#include "simulation/dts_engine/robot_description.h"

namespace hookpoint::simulation {
namespace {

constexpr int most_rounds = 100;

}  // namespace

LoopAssembly assemble_loops(Experiment& experiment, std::size_t index) {
  RobotSpec& robot = experiment.robots[index];
  dts::RobotDescription description = describe_robot(robot);
  description.mobile = false;
  description.plane_normal.reset();
  const dts::Model<double> model(description);
  dts::State<double> state = initial_state(robot);
  const std::vector<double> given = state.joint_positions;
  dts::Workspace<double> workspace(model);

  // Where hinges point is known once their points are together.
  std::vector<std::pair<std::size_t, Vector3d>> hinges;
  for (std::size_t i = 0; i < experiment.loops.size(); ++i) {
    LoopSpec& loop = experiment.loops[i];
    if (static_cast<std::size_t>(loop.robot) != index || !loop.axes) continue;
    hinges.emplace_back(i, (*std::exchange(loop.axes, std::nullopt))[0]);
  }
  LoopAssembly result;
  ConstraintSet points(experiment, index, model);
  std::vector<LoopState> loops(experiment.loops.size());
  dts::forward_kinematics(model, state, workspace);
  points.publish(workspace, loops);
  for (const std::size_t i : points.loops())
    if (!experiment.loops[i].stiffness)
      result.gap_before = std::max(result.gap_before, loops[i].error);
  if (points.constrains()) result.gap_after = points.close(model, state, workspace, most_rounds);
  for (std::size_t i = 0; i < given.size(); ++i)
    result.farthest = std::max(result.farthest, std::abs(state.joint_positions[i] - given[i]));
  for (const auto& [i, axis] : hinges) {
    LoopSpec& loop = experiment.loops[i];
    const Vector3d unit = (1. / norm(axis)) * axis;
    const auto& bodies = workspace.bodies;
    const Vector3d world = bodies[static_cast<std::size_t>(loop.body_a)].R_WB * unit;
    const Matrix3d& R_b = bodies[static_cast<std::size_t>(loop.body_b)].R_WB;
    loop.axes = {unit, transpose_times(R_b, world)};
  }
  ConstraintSet whole(experiment, index, model);
  if (whole.constrains()) whole.close(model, state, workspace, 0);
  result.rows = whole.row_count();
  result.rank = whole.rank();
  std::size_t joint = 0;
  for (ChainSpec& chain : robot.chains)
    for (LinkSpec& link : chain.links) {
      link.angle = state.joint_positions[joint];
      link.rate = state.joint_rates[joint++];
    }
  return result;
}

}  // namespace hookpoint::simulation
