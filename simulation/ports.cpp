#include "simulation/ports.h"

#include <fmt/format.h>

#include "language/document.h"

namespace hookpoint::simulation {
namespace {

void add_vector(std::vector<Port>& ports, const std::string& trail, const char* unit,
                const Vector3d& v) {
  ports.push_back({trail + ".x", unit, &v.x});
  ports.push_back({trail + ".y", unit, &v.y});
  ports.push_back({trail + ".z", unit, &v.z});
}

/// A body's motion under `trail`, its position under the name `position_name`.
void add_body(std::vector<Port>& ports, const std::string& trail, const char* position_name,
              const BodyState& body) {
  add_vector(ports, trail + "." + position_name, "m", body.position);
  ports.push_back({trail + ".orientation.w", "", &body.orientation.w});
  ports.push_back({trail + ".orientation.x", "", &body.orientation.x});
  ports.push_back({trail + ".orientation.y", "", &body.orientation.y});
  ports.push_back({trail + ".orientation.z", "", &body.orientation.z});
  add_vector(ports, trail + ".velocity", "m/s", body.velocity);
  add_vector(ports, trail + ".angular_velocity", "rad/s", body.angular_velocity);
  add_vector(ports, trail + ".contact.force", "N", body.contact_force);
}

void add_joint(std::vector<Port>& ports, const std::string& trail, JointKind kind,
               const JointState& joint) {
  const bool turns = kind == JointKind::revolute;
  ports.push_back({trail + ".angle", turns ? "rad" : "m", &joint.angle});
  ports.push_back({trail + ".rate", turns ? "rad/s" : "m/s", &joint.rate});
  ports.push_back({trail + ".acceleration", turns ? "rad/s^2" : "m/s^2", &joint.acceleration});
  ports.push_back({trail + ".torque", turns ? "N.m" : "N", &joint.torque});
}

}  // namespace

std::vector<Port> list_ports(const Experiment& experiment, const WorldState& state) {
  std::vector<Port> ports{{"time", "s", &state.time}};
  std::size_t body = 0, joint = 0;
  for (const RobotSpec& robot : experiment.robots) {
    add_body(ports, robot.name + ".base", "location", state.bodies[body]);
    add_body(ports, robot.name, "position", state.bodies[body]);
    ++body;
    for (const ChainSpec& chain : robot.chains) {
      for (const LinkSpec& link : chain.links) {
        const std::string trail = robot.name + "." + chain.name + "." + link.body.name;
        add_joint(ports, trail, link.joint, state.joints[joint++]);
        add_body(ports, trail, "location", state.bodies[body++]);
      }
    }
  }
  return ports;
}

Port find_port(const Experiment& experiment, const std::vector<Port>& ports,
               std::string_view trail) {
  std::string_view wanted = trail;
  if (wanted.substr(0, experiment.world.size() + 1) == experiment.world + ".")
    wanted.remove_prefix(experiment.world.size() + 1);
  std::vector<std::string> trails;
  for (const Port& port : ports) {
    if (port.trail == wanted) return port;
    trails.push_back(port.trail);
  }
  const std::string nearest = language::nearest_name(wanted, trails);
  throw ExperimentError(fmt::format("there is no port `{}`{}", trail,
                                    nearest.empty()
                                        ? "; `hookpoint describe` lists the ports of each class"
                                        : fmt::format("; did you mean `{}`?", nearest)));
}

}  // namespace hookpoint::simulation
