#include "simulation/wiring/pull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

constexpr double reach = 0.1;           ///< over which it carries a weight [m]
constexpr double damping_ratio = 0.7;   ///< of that weight's mass on the spring
constexpr double usual_gravity = 9.81;  ///< where there is none [m/s^2]
constexpr double end_of_rod = 0.25;     ///< part of a slender rod's mass that its end resists with

}  // namespace

Pull::Pull(const Experiment& experiment) {
  double heaviest = 0., lightest = std::numeric_limits<double>::infinity();
  std::size_t bodies = 0;
  for (const RobotSpec& robot : experiment.robots) {
    first_bodies_.push_back(bodies);
    double whole = 0.;
    for (const BodySpec* body : bodies_of(robot)) {
      const bool moves = robot.mobile || body != &robot.base;
      if (moves && body->mass.mass > 0.) {
        whole += body->mass.mass;
        lightest = std::min(lightest, body->mass.mass);
      }
      ++bodies;
    }
    heaviest = std::max(heaviest, whole);
  }
  first_bodies_.push_back(bodies);
  if (heaviest == 0.) return;
  const double dt = experiment.deltat, least = end_of_rod * lightest;
  const double gravity = norm(experiment.gravity) > 0. ? norm(experiment.gravity) : usual_gravity;
  stiffness_ = std::min(heaviest * gravity / reach, 0.1 * least / (dt * dt));
  damping_ = std::min(2. * damping_ratio * std::sqrt(stiffness_ * heaviest), 0.5 * least / dt);
}

void Pull::act(const WorldState& state, PullInput& input) {
  const double bodies = static_cast<double>(first_bodies_.back());
  if (!(body_ > -0.5 && body_ < bodies - 0.5)) {
    input.robot = -1;
    force_ = {};
    return;
  }
  input.index = static_cast<std::size_t>(std::lround(body_));
  const auto next = std::ranges::upper_bound(first_bodies_, input.index);
  input.robot = static_cast<int>(next - first_bodies_.begin()) - 1;
  input.body = static_cast<int>(input.index - *(next - 1));
  const BodyState& body = state.bodies[input.index];
  const Vector3d arm = rotate(body.orientation, point_);
  const Vector3d velocity = body.velocity + cross(body.angular_velocity, arm);
  force_ = stiffness_ * (target_ - (body.position + arm)) - damping_ * velocity;
  input.force = {point_, force_, {}};
}

void Pull::add_ports(std::vector<Port>& ports) {
  const auto add = [&](const std::string& name, const char* unit, double& value, bool writable,
                       const char* doc) -> Port& {
    Port& port = ports.emplace_back();
    port.trail = "Simulator.pull." + name;
    port.unit = unit;
    port.value = &value;
    port.writable = writable ? &value : nullptr;
    port.doc = doc;
    return port;
  };
  const auto add_vector = [&](const std::string& name, const char* unit, Vector3d& v, bool writable,
                              const char* doc) {
    add(name + ".x", unit, v.x, writable, doc);
    add(name + ".y", unit, v.y, writable, doc);
    add(name + ".z", unit, v.z, writable, doc);
  };
  Port& body = add("body", "", body_, true, "which body is pulled: its place among all; -1: none");
  body.minimum = -1.;
  body.maximum = static_cast<double>(first_bodies_.back()) - 1.;
  add_vector("point", "m", point_, true, "where the pull acts, body axes");
  add_vector("target", "m", target_, true, "where it pulls to, world axes");
  add("stiffness", "N/m", stiffness_, true, "of the pull's spring").minimum = 0.;
  add("damping", "N.s/m", damping_, true, "of the pull's damper").minimum = 0.;
  add_vector("force", "N", force_, false, "that the pull exerts over the next step");
}

}  // namespace hookpoint::simulation
