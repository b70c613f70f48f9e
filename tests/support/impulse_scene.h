// Experiments under an impulse law, made of robot descriptions: what the truths about impacts of
// articulated robots start from.
#pragma once

#include <memory>

#include "dts/configuration.h"
#include "simulation/dts_engine/dts_engine.h"

namespace hookpoint::testing {

inline simulation::MassSpec mass_spec(const dts::MassProperties<double>& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

inline simulation::ChainSpec chain_spec(const dts::ChainDescription& chain, std::size_t first_joint,
                                        const dts::State<double>& state) {
  simulation::ChainSpec spec;
  spec.hip_distance = chain.hip_position;
  spec.hip_orientation = chain.hip_orientation;
  spec.carrier = chain.carrier;
  for (std::size_t n = 0; n < chain.links.size(); ++n) {
    const dts::LinkDescription& link = chain.links[n];
    simulation::LinkSpec& added = spec.links.emplace_back();
    added.joint_location = link.joint_position;
    added.joint_orientation = link.joint_orientation;
    added.a = link.a;
    added.alpha = link.alpha;
    added.d = link.d;
    added.theta = link.theta;
    added.joint = link.joint == dts::JointType::revolute ? simulation::JointKind::revolute
                                                         : simulation::JointKind::prismatic;
    added.body.mass = mass_spec(link.mass);
    added.rotor_inertia = link.rotor_inertia;
    added.angle = state.joint_positions[first_joint + n];
    added.rate = state.joint_rates[first_joint + n];
  }
  return spec;
}

/// The robot at `state` over level ground at z = 0 of the material, no boundary points yet.
inline simulation::Experiment impulse_experiment(const dts::RobotDescription& robot,
                                                 const dts::State<double>& state,
                                                 const contact::MaterialConstants<double>& material,
                                                 const Vector3d& gravity, double deltat,
                                                 const std::string& law = "impulse") {
  simulation::Experiment experiment;
  experiment.gravity = gravity;
  experiment.deltat = deltat;
  experiment.contact = law;
  experiment.materials.push_back({"floor", material});
  experiment.terrain.emplace();
  simulation::RobotSpec spec;
  spec.name = "robot";
  spec.mobile = robot.mobile;
  spec.base.mass = mass_spec(robot.base);
  spec.location = state.base_position;
  spec.orientation = state.base_orientation;
  spec.velocity = state.base_velocity;
  spec.angular_velocity = state.base_angular_velocity;
  std::size_t joint = 0;
  for (const dts::ChainDescription& chain : robot.chains) {
    spec.chains.push_back(chain_spec(chain, joint, state));
    joint += chain.links.size();
  }
  experiment.robots.push_back(spec);
  return experiment;
}

/// Boundary points of body `body` (0 the base, then links chain by chain) of the only robot.
inline std::vector<Vector3d>& points_of(simulation::Experiment& experiment, std::size_t body) {
  simulation::RobotSpec& robot = experiment.robots[0];
  if (body == 0) return robot.base.boundary_points;
  --body;
  for (simulation::ChainSpec& chain : robot.chains) {
    if (body < chain.links.size()) return chain.links[body].body.boundary_points;
    body -= chain.links.size();
  }
  throw std::out_of_range("no such body");
}

/// What an engine publishes, as a state.
inline dts::State<double> state_of(const simulation::WorldState& world) {
  const simulation::BodyState& base = world.bodies[0];
  dts::State<double> state{
      base.position, base.orientation, base.velocity, base.angular_velocity, {}, {}};
  for (const simulation::JointState& joint : world.joints) {
    state.joint_positions.push_back(joint.angle);
    state.joint_rates.push_back(joint.rate);
  }
  return state;
}

}  // namespace hookpoint::testing
