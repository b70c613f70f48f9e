#include "simulation/run/energy_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <unordered_set>
#include <variant>

#include "simulation/engine_interface/rotors.h"
#include "simulation/experiment/joint_forces.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

constexpr std::int64_t windows = 20, samples_a_window = 64;
static_assert(EnergyWatch::fewest_steps >= 10 * windows);
/// Of the kinetic energy: by so much the maxima of a bounded vibration differ.
constexpr double wavering = 0.05;
/// Of the energies summed: what rounding leaves.
constexpr double rounding = 1e-9;
/// Than at both of its ends a body may have been between two samples.
constexpr double faster = 3.;
/// Of a contact's depth that counts [m].
constexpr double least_jump = 1e-6;

double spring_energy(const JointProperties& joint, double position, double drive) {
  const double below = std::max(0., joint.lower_limit - position);
  const double above = std::max(0., position - joint.upper_limit);
  const double stretch = position - joint.rest_position;
  return 0.5 * (joint.stiffness * stretch * stretch +
                joint.limit_stiffness * (below * below + above * above)) -
         drive_torque(joint, drive) * position;
}

/// Whether the port of that trail is of one of the objects in `trails`.
bool is_of(const std::string& port, const std::unordered_set<std::string_view>& trails) {
  for (std::size_t dot = port.find('.'); dot != std::string::npos; dot = port.find('.', dot + 1))
    if (trails.contains(std::string_view(port).substr(0, dot))) return true;
  return false;
}

}  // namespace

bool is_passive(const Experiment& experiment) {
  for (const ForceSpec& force : experiment.forces) {
    if (force.window || !(force.torque == Vector3d{})) return false;
  }
  // What only listens drives nothing: what a component makes of it leaves by another wire.
  std::unordered_set<std::string_view> components;
  for (const ComponentSpec& component : experiment.components) components.insert(component.trail);
  return std::ranges::none_of(experiment.wires, [&](const WireSpec& wire) {
    if (wire.to.starts_with("Simulator.pull.")) return true;
    return wire.to.starts_with(experiment.world + ".") && !is_of(wire.to, components) &&
           !moves_a_surface(experiment, wire);
  });
}

EnergyWatch::EnergyWatch(const Experiment& experiment, const World& world, std::int64_t last)
    : experiment_(experiment), world_(world) {
  const std::int64_t steps = last - world.state().step;
  if (!is_passive(experiment) || !world.ground_energy() || steps < fewest_steps) return;
  surfaces_move_ = surfaces_move(experiment);
  if (surfaces_move_ && world.state().surface_works.empty()) return;
  stride_ = std::max<std::int64_t>(1, steps / (windows * samples_a_window));
  samples_.reserve(static_cast<std::size_t>(steps / stride_ + 2));
  std::size_t bodies = 0;
  for (const RobotSpec& robot : experiment.robots) {
    first_bodies_.push_back(bodies);
    bodies += body_count(robot);
    for_each_link(robot, [&](const TreeLink& at) {
      const double most = at.link.static_friction.value_or(at.link.friction);
      most_in_friction_ += 0.5 * most * at.link.friction_deflection;
    });
  }
}

void EnergyWatch::sample() {
  const WorldState& state = world_.state();
  Sample now{state.time, 0., world_.ground_energy().value_or(0.)};
  auto body = state.bodies.begin();
  std::span joints(state.joints);
  const auto add = [&](const MassSpec& mass, const BodyState& motion) {
    const Vector3d arm = rotate(motion.orientation, mass.center_of_mass);
    const Vector3d velocity = motion.velocity + cross(motion.angular_velocity, arm);
    const Vector3d w = rotate(conjugate(motion.orientation), motion.angular_velocity);
    now.kinetic += 0.5 * (mass.mass * dot(velocity, velocity) + dot(w, mass.inertia * w));
    now.energy -= mass.mass * dot(experiment_.gravity, motion.position + arm);
  };
  for (const RobotSpec& robot : experiment_.robots) {
    if (robot.mobile) add(robot.base.mass, *body);
    ++body;
    for_each_link(robot, [&](const TreeLink& at) {
      add(at.link.body.mass, *body++);
      now.energy +=
          spring_energy(joint_properties(at.link), joints[at.joint()].angle, at.link.torque);
    });
    now.kinetic += rotor_energy(robot, joints.first(joint_count(robot)));
    joints = joints.subspan(joint_count(robot));
  }
  for (const ForceSpec& force : experiment_.forces) {
    const std::size_t first = first_bodies_[static_cast<std::size_t>(force.robot)];
    const BodyState& pushed = state.bodies[first + static_cast<std::size_t>(force.body)];
    now.energy -= dot(force.force, pushed.position + rotate(pushed.orientation, force.point));
  }
  now.energy += now.kinetic;
  for (const double work : state.surface_works) now.energy -= work;
  now.jumped = jumps(samples_.empty() ? 0. : now.time - samples_.back().time);
  samples_.push_back(now);
}

bool EnergyWatch::jumps(double interval) {
  const std::vector<BodyState>& bodies = world_.state().bodies;
  touches_before_.swap(touches_);
  touches_.assign(bodies.size(), {});
  touches_before_.resize(bodies.size());
  world_.tell_contacts(contacts_);
  for (const ContactView& contact : contacts_) {
    const BodyState& body = bodies[contact.body];
    Touch& touch = touches_[contact.body];
    touch.depth = std::max(touch.depth, contact.depth);
    touch.speed =
        std::max(touch.speed, norm(body.velocity) + norm(body.angular_velocity) *
                                                        norm(contact.point - body.position));
  }
  if (samples_.empty()) return false;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const Touch &now = touches_[i], &before = touches_before_[i];
    const double moved = faster * std::max(now.speed, before.speed) * interval;
    if (now.depth - before.depth > moved + least_jump) return true;
  }
  return false;
}

std::string EnergyWatch::finding() const {
  const auto count = static_cast<std::int64_t>(samples_.size()) / windows;
  if (count == 0) return "";
  struct Window {
    double begin = 0., end = 0., energy = -HUGE_VAL, kinetic = 0.;
  };
  std::vector<Window> all(windows);
  double scale = 0.;
  for (std::int64_t i = 0; i < windows * count; ++i) {
    const Sample& sample = samples_[static_cast<std::size_t>(i)];
    Window& window = all[static_cast<std::size_t>(i / count)];
    if (i % count == 0) window.begin = sample.time;
    window.end = sample.time;
    window.energy = std::max(window.energy, sample.energy);
    window.kinetic = std::max(window.kinetic, sample.kinetic);
    scale = std::max(scale, std::abs(sample.energy) + sample.kinetic);
  }
  const auto least = std::ranges::min_element(all, {}, &Window::energy);
  const auto most = std::ranges::max_element(least, all.end(), {}, &Window::energy);
  double kinetic = 0.;
  for (auto window = least; window != all.end(); ++window)
    kinetic = std::max(kinetic, window->kinetic);
  const double rise = most->energy - least->energy;
  if (!(rise > wavering * kinetic + rounding * scale + most_in_friction_)) return "";
  double at_edges = 0.;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &now = samples_[k], &before = samples_[k - 1];
    if (now.jumped && now.time > least->begin && before.time < most->end)
      at_edges += std::max(0., now.energy - before.energy);
  }
  const std::string found =
      fmt::format("{}{} by {:.3g} J between {:.4g} and {:.4g} s", energy_finding,
                  surfaces_move_ ? " beyond the work of what moves the ground" : "", rise,
                  least->end, most->end);
  const char* const mend =
      experiment_.touch == "points"
          ? "write touch = shapes, or give the ground finer steps and less steep tiles"
          : "give the ground damping, or less steep tiles";
  if (at_edges > 0.5 * rise)
    return fmt::format("{}: contacts crossed edges of the ground, where their depth jumps; {}",
                       found, mend);
  const bool edges =
      experiment_.terrain && std::holds_alternative<GridSpec>(experiment_.terrain->surface);
  return fmt::format(
      "{}: deltat {:.4g} s is too large for how it moves; halve it, soften the "
      "ground, or choose another integrator{}{}",
      found, experiment_.deltat,
      edges ? "; if that changes nothing, contacts crossed edges of the ground: " : "",
      edges ? mend : "");
}

}  // namespace hookpoint::simulation
