#include "simulation/analysis/dynamics_report.h"

#include <cmath>

#include "dts/energy.h"
#include "simulation/analysis/stability.h"
#include "simulation/dts_engine/robot_system.h"
#include "simulation/experiment/ground.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

std::vector<ChainDynamics> chain_dynamics(const RobotSpec& spec,
                                          const dts::Workspace<double>& workspace) {
  std::vector<ChainDynamics> chains;
  const std::vector<std::string> bodies = body_names(spec);
  auto acceleration = workspace.joint_accelerations.begin();
  for (std::size_t c = 0; c < spec.chains.size(); ++c) {
    const ChainSpec& chain = spec.chains[c];
    const auto end = acceleration + static_cast<std::ptrdiff_t>(chain.links.size());
    const dts::Wrench<double>& hip = workspace.hip_wrenches[c];
    chains.push_back(
        {chain.name, bodies[chain.carrier], {acceleration, end}, hip.force, hip.moment});
    acceleration = end;
  }
  return chains;
}

RobotDynamics robot_dynamics(const Experiment& experiment, int index,
                             const contact::Terrain* ground, const WorldInputs& inputs,
                             const std::vector<std::string>& body_names) {
  const RobotSpec& spec = experiment.robots[index];
  RobotSystem robot(experiment, static_cast<std::size_t>(index), ground, inputs);
  const dts::Workspace<double>& workspace = robot.workspace();

  RobotDynamics report;
  report.name = spec.name;
  report.base_acceleration = workspace.base_acceleration;
  report.base_angular_acceleration = workspace.base_angular_acceleration;
  report.chains = chain_dynamics(spec, workspace);
  report.kinetic_energy = dts::kinetic_energy(robot.model(), workspace);
  report.potential_energy = dts::potential_energy(robot.model(), experiment.gravity, workspace);
  report.linear_momentum = dts::linear_momentum(robot.model(), workspace);
  report.angular_momentum = dts::angular_momentum(robot.model(), workspace);
  for (const ContactPoint& point : robot.contacts().points()) {
    if (point.depth > 0.)
      report.contacts.push_back(
          {body_names[point.body], point.depth, point.position, point.normal, point.force});
  }
  return report;
}

/// Throws ExperimentError where a number of the report is none, or beyond all.
void check_finite(const RobotDynamics& robot) {
  const auto finite = [](const Vector3d& v) { return std::isfinite(v.x + v.y + v.z); };
  bool good = finite(robot.base_acceleration) && finite(robot.base_angular_acceleration) &&
              finite(robot.linear_momentum) && finite(robot.angular_momentum) &&
              std::isfinite(robot.kinetic_energy) && std::isfinite(robot.potential_energy);
  for (const ChainDynamics& chain : robot.chains) {
    good = good && finite(chain.hip_force) && finite(chain.hip_moment);
    for (const double acceleration : chain.joint_accelerations)
      good = good && std::isfinite(acceleration);
  }
  for (const ContactReport& contact : robot.contacts) good = good && finite(contact.force);
  if (!good)
    throw ExperimentError(
        "the dynamics of robot " + robot.name +
        " are beyond the range of numbers: make its masses, speeds and distances, "
        "or gravity, of usual size");
}

}  // namespace

DynamicsReport evaluate_dynamics(const Experiment& experiment) {
  DynamicsReport report;
  report.world = experiment.world;
  const bool has_forces = contact::find_force_law(experiment.contact) != nullptr;
  const auto ground = has_forces ? make_ground(experiment) : std::nullopt;
  const std::vector<std::string> names = body_trails(experiment);
  const WorldInputs inputs = initial_inputs(experiment);
  auto first_body = names.begin();
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    const auto end = first_body + static_cast<std::ptrdiff_t>(body_count(experiment.robots[i]));
    report.robots.push_back(robot_dynamics(experiment, static_cast<int>(i),
                                           ground ? &*ground : nullptr, inputs, {first_body, end}));
    check_finite(report.robots.back());
    first_body = end;
  }
  const double step = stability_bound(experiment).step;
  if (std::isfinite(step)) report.largest_stable_step = step;
  return report;
}

}  // namespace hookpoint::simulation
