#include "simulation/wiring/ports.h"

#include <fmt/format.h>

#include <utility>

#include "language/document/document.h"
#include "language/names.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/wiring/derived_ports.h"

namespace hookpoint::simulation {
namespace {

Port readable(std::string trail, std::string unit, const double& value) {
  Port port;
  port.trail = std::move(trail);
  port.unit = std::move(unit);
  port.value = &value;
  return port;
}

void add_vector(std::vector<Port>& ports, const std::string& trail, const char* unit,
                const Vector3d& v) {
  ports.push_back(readable(trail + ".x", unit, v.x));
  ports.push_back(readable(trail + ".y", unit, v.y));
  ports.push_back(readable(trail + ".z", unit, v.z));
}

void add_orientation(std::vector<Port>& ports, const std::string& trail, const Quaterniond& q) {
  ports.push_back(readable(trail + ".orientation.w", "", q.w));
  ports.push_back(readable(trail + ".orientation.x", "", q.x));
  ports.push_back(readable(trail + ".orientation.y", "", q.y));
  ports.push_back(readable(trail + ".orientation.z", "", q.z));
}

/// Marks the ports from `first` on as worked out on demand.
void on_demand(std::vector<Port>& ports, std::size_t first, Lazy& lazy) {
  for (; first < ports.size(); ++first) ports[first].lazy = &lazy;
}

/// A body's motion under `trail`, its position under the name `position_name`.
void add_body(std::vector<Port>& ports, const std::string& trail, const char* position_name,
              const BodyState& body, const DerivedPorts::BodyValues& values,
              DerivedPorts& derived) {
  add_vector(ports, trail + "." + position_name, "m", body.position);
  add_orientation(ports, trail, body.orientation);
  add_vector(ports, trail + ".velocity", "m/s", body.velocity);
  add_vector(ports, trail + ".angular_velocity", "rad/s", body.angular_velocity);
  std::size_t first = ports.size();
  add_vector(ports, trail + ".contact.force", "N", body.contact_force);
  on_demand(ports, first, derived.contact_forces());
  first = ports.size();
  add_vector(ports, trail + ".linear_acceleration", "m/s^2", values.acceleration);
  add_vector(ports, trail + ".angular_acceleration", "rad/s^2", values.angular_acceleration);
  on_demand(ports, first, derived.accelerations());
  ports.push_back(readable(trail + ".contact.count", "", values.contacts));
  ports.back().lazy = &derived.contacts();
}

void add_robot(std::vector<Port>& ports, const std::string& trail, const RobotSums& values,
               const double& numerical_energy, DerivedPorts& derived) {
  const std::size_t first = ports.size();
  ports.push_back(readable(trail + ".kinetic_energy", "J", values.kinetic_energy));
  ports.push_back(readable(trail + ".potential_energy", "J", values.potential_energy));
  add_vector(ports, trail + ".center_of_mass", "m", values.center_of_mass);
  add_vector(ports, trail + ".center_of_mass_velocity", "m/s", values.center_velocity);
  ports.push_back(readable(trail + ".total_mass", "kg", values.mass));
  on_demand(ports, first, derived.energies());
  if (!derived.balance().is_known()) return;
  ports.push_back(readable(trail + ".numerical_energy", "J", numerical_energy));
  ports.back().lazy = &derived.numerical_energies();
}

void add_joint(std::vector<Port>& ports, const std::string& trail, const JointUnits& units,
               const JointState& joint, double& drive, const JointBiasValues& bias, Lazy& lazy) {
  ports.push_back(readable(trail + ".angle", units.position, joint.angle));
  ports.push_back(readable(trail + ".rate", units.rate, joint.rate));
  ports.push_back(readable(trail + ".acceleration", units.acceleration, joint.acceleration));
  ports.push_back(readable(trail + ".total_torque", units.torque, joint.torque));
  ports.push_back(readable(trail + ".torque", units.torque, drive));
  ports.back().writable = &drive;
  const std::size_t first = ports.size();
  ports.push_back(readable(trail + ".gravity_torque", units.torque, bias.gravity));
  ports.push_back(readable(trail + ".bias_torque", units.torque, bias.all));
  on_demand(ports, first, lazy);
}

void add_integrator(std::vector<Port>& ports, const std::string& trail,
                    const IntegratorState& integrator) {
  ports.push_back(readable(trail + "steps", "", integrator.steps));
  ports.push_back(readable(trail + "rejected", "", integrator.rejected));
  ports.push_back(readable(trail + "evaluations", "", integrator.evaluations));
  ports.push_back(readable(trail + "jacobians", "", integrator.jacobians));
  ports.push_back(readable(trail + "events", "", integrator.events));
}

void add_input(std::vector<Port>& ports, const std::string& trail, const char* unit, Vector3d& v) {
  add_vector(ports, trail, unit, v);
  ports[ports.size() - 3].writable = &v.x;
  ports[ports.size() - 2].writable = &v.y;
  ports[ports.size() - 1].writable = &v.z;
}

/// Where an obstacle is, and how it moves in the next step.
void add_obstacle(std::vector<Port>& ports, const std::string& trail, SurfaceMotion& motion) {
  add_vector(ports, trail + ".position", "m", motion.position);
  add_orientation(ports, trail, motion.orientation);
  add_input(ports, trail + ".velocity", "m/s", motion.velocity);
  add_input(ports, trail + ".angular_velocity", "rad/s", motion.angular_velocity);
}

void add_body_contact(std::vector<Port>& ports, const std::string& trail,
                      const BodyContact& contact) {
  add_vector(ports, trail + ".contact.moment", "N.m", contact.moment);
  add_vector(ports, trail + ".contact.center_of_pressure", "m", contact.center_of_pressure);
  ports.push_back(readable(trail + ".contact.normal_load", "N", contact.normal_load));
  ports.push_back(readable(trail + ".contact.tangential_load", "N", contact.tangential_load));
}

/// What bodies do to the terrain and the obstacles.
void add_surface_contacts(std::vector<Port>& ports, const Experiment& experiment,
                          const WorldState& state, DerivedPorts& derived) {
  const std::size_t first = ports.size();
  auto contact = state.surface_contacts.begin();
  const auto add = [&](const std::string& name) {
    if (contact == state.surface_contacts.end()) return;
    const std::string trail = experiment.world + "." + name;
    add_vector(ports, trail + ".contact.force", "N", contact->force);
    ports.push_back(readable(trail + ".contact.count", "", contact->count));
    add_body_contact(ports, trail, contact->sums);
    ++contact;
  };
  if (experiment.terrain) add(experiment.terrain->name);
  for (const ObstacleSpec& obstacle : experiment.obstacles) add(obstacle.name);
  on_demand(ports, first, derived.surface_contacts());
}

/// What only some engines have: hips, ContactPoints, and what the contacts of a body come to.
void add_details(std::vector<Port>& ports, const Experiment& experiment, const WorldState& state,
                 DerivedPorts& derived) {
  const std::size_t first = ports.size();
  auto chain_state = state.chains.begin();
  for (const RobotSpec& robot : experiment.robots) {
    for (const ChainSpec& chain : robot.chains) {
      if (chain_state == state.chains.end()) break;
      const std::string trail = experiment.world + "." + robot.name + "." + chain.name;
      add_vector(ports, trail + ".hip_force", "N", chain_state->hip_force);
      add_vector(ports, trail + ".hip_moment", "N.m", chain_state->hip_moment);
      ++chain_state;
    }
  }
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const std::string& trail = experiment.points[i].trail;
    const PointState& point = state.points[i];
    add_vector(ports, trail + ".position", "m", point.position);
    add_vector(ports, trail + ".contact.force", "N", point.force);
    add_vector(ports, trail + ".contact.hook", "m", point.hook);
    ports.push_back(readable(trail + ".contact.depth", "m", point.depth));
    ports.push_back(readable(trail + ".contact.sliding", "", point.sliding));
    ports.push_back(readable(trail + ".contact.normal_load", "N", point.normal_load));
    ports.push_back(readable(trail + ".contact.tangential_load", "N", point.tangential_load));
  }
  auto contact = state.body_contacts.begin();
  for (const RobotSpec& robot : experiment.robots) {
    if (contact == state.body_contacts.end()) break;
    const std::string trail = experiment.world + "." + robot.name;
    add_body_contact(ports, trail + "." + (robot.base.name.empty() ? "base" : robot.base.name),
                     *contact);
    add_body_contact(ports, trail, *contact++);
    for_each_link(robot, [&](const TreeLink& at) {
      add_body_contact(ports, trail + "." + at.chain.name + "." + at.link.body.name, *contact++);
    });
  }
  on_demand(ports, first, derived.details());
}

void add_reactions(std::vector<Port>& ports, const Experiment& experiment, const WorldState& state,
                   DerivedPorts& derived) {
  const std::size_t first = ports.size();
  auto reaction = state.reactions.begin();
  for (const RobotSpec& robot : experiment.robots) {
    for_each_link(robot, [&](const TreeLink& at) {
      if (reaction == state.reactions.end()) return;
      const std::string trail =
          experiment.world + "." + robot.name + "." + at.chain.name + "." + at.link.body.name;
      add_vector(ports, trail + ".reaction_force", "N", reaction->force);
      add_vector(ports, trail + ".reaction_moment", "N.m", reaction->moment);
      ++reaction;
    });
  }
  on_demand(ports, first, derived.reactions());
}

/// Elements of short lists have letters: "gains[1]" as "gains.y", any other trail as it is.
std::string by_letter(std::string_view trail) {
  for (const auto& [index, letter] :
       {std::pair{"[0]", ".x"}, std::pair{"[1]", ".y"}, std::pair{"[2]", ".z"}}) {
    if (trail.ends_with(index)) return std::string(trail.substr(0, trail.size() - 3)) + letter;
  }
  return std::string(trail);
}

}  // namespace

std::vector<Port> list_ports(const Experiment& experiment, Engine& engine, DerivedPorts& derived) {
  const WorldState& state = engine.state();
  const std::string world = experiment.world + ".";
  std::vector<Port> ports{readable(world + "time", "s", state.time)};
  add_integrator(ports, world + "integrator.", state.integrator);
  std::size_t body = 0, joint = 0, index = 0;
  const auto add = [&](const std::string& trail, const char* position_name) {
    add_body(ports, trail, position_name, state.bodies[body], derived.body(body), derived);
  };
  for (const RobotSpec& robot : experiment.robots) {
    const std::string base = robot.base.name.empty() ? "base" : robot.base.name;
    add(world + robot.name + "." + base, "location");
    add(world + robot.name, "position");
    add_robot(ports, world + robot.name, derived.robot(index), derived.numerical_energy(index),
              derived);
    ++index;
    ++body;
    for_each_link(robot, [&](const TreeLink& at) {
      const std::string trail = world + robot.name + "." + at.chain.name + "." + at.link.body.name;
      add_joint(ports, trail, joint_type(at.link.joint).units, state.joints[joint],
                engine.inputs().joint_torques[joint], derived.joint(joint), derived.joint_bias());
      add(trail, "location");
      ++body;
      ++joint;
    });
  }
  add_input(ports, world + "gravity", "m/s^2", engine.inputs().gravity);
  if (experiment.terrain) {
    SurfaceMotion& ground = engine.inputs().ground;
    const std::string trail = world + experiment.terrain->name;
    add_vector(ports, trail + ".position", "m", ground.position);
    add_orientation(ports, trail, ground.orientation);
    add_input(ports, trail + ".velocity", "m/s", ground.belt_velocity);
    add_input(ports, trail + ".frame_velocity", "m/s", ground.velocity);
    add_input(ports, trail + ".frame_angular_velocity", "rad/s", ground.angular_velocity);
    if (!state.surface_works.empty())
      ports.push_back(readable(trail + ".work", "J", state.surface_works.front()));
  }
  for (std::size_t i = 0; i < experiment.obstacles.size(); ++i) {
    const std::string trail = world + experiment.obstacles[i].name;
    add_obstacle(ports, trail, engine.inputs().obstacles[i]);
    if (!state.surface_works.empty())
      ports.push_back(
          readable(trail + ".work", "J", state.surface_works[i + (experiment.terrain ? 1 : 0)]));
  }
  for (std::size_t i = 0; i < state.loops.size(); ++i) {
    const std::string trail = world + experiment.loops[i].name;
    ports.push_back(readable(trail + ".error", "m", state.loops[i].error));
    add_vector(ports, trail + ".force", "N", state.loops[i].force);
    add_vector(ports, trail + ".moment", "N.m", state.loops[i].moment);
  }
  add_details(ports, experiment, state, derived);
  add_surface_contacts(ports, experiment, state, derived);
  add_reactions(ports, experiment, state, derived);
  return ports;
}

std::optional<Port> look_up_port(const Experiment& experiment, const std::vector<Port>& ports,
                                 std::string_view trail) {
  const std::string world = experiment.world + ".";
  const std::string own = by_letter(trail);
  for (const std::string& wanted :
       {std::string(trail), own, world + std::string(trail), world + own}) {
    for (const Port& port : ports) {
      if (port.trail != wanted) continue;
      if (port.lazy != nullptr) port.lazy->begin();
      return port;
    }
  }
  return std::nullopt;
}

Port find_port(const Experiment& experiment, const std::vector<Port>& ports,
               std::string_view trail) {
  if (auto port = look_up_port(experiment, ports, trail)) return std::move(*port);
  const std::string world = experiment.world + ".";
  // Trails are suggested as the user writes them: with or without the world's name.
  const bool with_world = trail.starts_with(world);
  std::vector<std::string> trails;
  for (const Port& port : ports) {
    const bool inside = port.trail.starts_with(world);
    trails.push_back(inside && !with_world ? port.trail.substr(world.size()) : port.trail);
  }
  const std::string nearest = language::nearest_name(trail, trails);
  throw ExperimentError(fmt::format("there is no port `{}`{}", trail,
                                    nearest.empty()
                                        ? "; `hookpoint ports FILE` lists them"
                                        : fmt::format("; did you mean `{}`?", nearest)));
}

}  // namespace hookpoint::simulation
