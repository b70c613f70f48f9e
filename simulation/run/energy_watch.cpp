#include "simulation/run/energy_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>

#include "integrators/stepper.h"
#include "simulation/engine_interface/robot_sums.h"
#include "simulation/experiment/joint_forces.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

constexpr std::int64_t windows = 20, samples_a_window = 64;
static_assert(EnergyWatch::fewest_steps >= 10 * windows);
/// Of the energy that takes part in the motion: by so much a bounded vibration's wavers.
constexpr double wavering = 0.05;
/// Of the energies summed: what rounding leaves.
constexpr double rounding_part = 1e-9;
/// Than at both of its ends a body may have been between two samples.
constexpr double faster = 3.;
/// Of a contact's depth that counts [m].
constexpr double least_jump = 1e-6;

double spring_energy(const JointProperties& joint, double position) {
  const double below = std::max(0., joint.lower_limit - position);
  const double above = std::max(0., position - joint.upper_limit);
  const double stretch = position - joint.rest_position;
  return 0.5 * (joint.stiffness * stretch * stretch +
                joint.limit_stiffness * (below * below + above * above));
}

}  // namespace

EnergyWatch::EnergyWatch(const Experiment& experiment, World& world, std::int64_t last)
    : experiment_(experiment), world_(world) {
  const std::int64_t steps = last - world.state().step;
  ground_known_ = world.ground_energy().has_value() &&
                  !(surfaces_move(experiment) && world.state().surface_works.empty());
  measured_ = world.energy_balance().has_begun();
  if (steps < fewest_steps || experiment.robots.empty() || !(ground_known_ || measured_)) return;
  world.energy_balance().begin_drives();
  const integrators::StepperDescription* const stepper =
      integrators::find_stepper(experiment.integrator);
  new_velocities_ =
      experiment.engine == "dts" && stepper != nullptr && stepper->moves_with_new_velocity;
  stride_ = std::max<std::int64_t>(1, steps / (windows * samples_a_window));
  const auto most = static_cast<std::size_t>(steps / stride_ + 2);
  samples_.reserve(most);
  for (std::size_t i = 0; i < experiment.robots.size(); ++i) {
    moving_.emplace_back(experiment, i);
    numerical_.emplace_back().reserve(most);
    driven_before_.push_back(world.energy_balance().driven_work(i));
    for_each_link(experiment.robots[i], [&](const TreeLink& at) {
      const double friction = at.link.static_friction.value_or(at.link.friction);
      most_in_friction_ += 0.5 * friction * at.link.friction_deflection;
    });
  }
}

void EnergyWatch::sample() {
  const WorldState& state = world_.state();
  Sample now{state.time, 0., world_.ground_energy().value_or(0.)};
  std::span bodies(state.bodies);
  std::span joints(state.joints);
  for (std::size_t i = 0; i < experiment_.robots.size(); ++i) {
    const RobotSpec& robot = experiment_.robots[i];
    const RobotSums sums = robot_sums(robot, world_.inputs().gravity, bodies, joints);
    now.size += sums.kinetic_energy + std::abs(sums.potential_energy);
    now.energy += sums.kinetic_energy + sums.potential_energy;
    for_each_link(robot, [&](const TreeLink& at) {
      now.energy += spring_energy(joint_properties(at.link), joints[at.joint()].angle);
    });
    const double driven = world_.energy_balance().driven_work(i);
    now.energy -= driven;
    now.size += std::abs(driven);
    bodies = bodies.subspan(body_count(robot));
    joints = joints.subspan(joint_count(robot));
    if (measured_) numerical_[i].push_back(world_.energy_balance().numerical_energy(i));
    moving_[i].observe(state);
  }
  for (std::size_t i = 0; i < state.loops.size(); ++i) {
    const double error = state.loops[i].error;
    now.energy += 0.5 * experiment_.loops[i].stiffness.value_or(0.) * error * error;
  }
  for (const double work : state.surface_works) now.energy -= work;
  now.size += std::abs(now.energy);
  now.plain = now.energy;
  now.jumped = jumps(samples_.empty() ? 0. : now.time - samples_.back().time);
  if (!new_velocities_) {
    samples_.push_back(now);
    return;
  }
  bodies_ = state.bodies;
  joints_ = state.joints;
  unpaired_ = {now, state.step, kinetic_energy(bodies_, joints_)};
}

// v_n . M v_{n+1} = T_n + T_{n+1} less T of their difference.
void EnergyWatch::pair() {
  const WorldState& state = world_.state();
  Unpaired before = *unpaired_;
  unpaired_.reset();
  if (state.step != before.step + 1) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].velocity = state.bodies[i].velocity - bodies_[i].velocity;
    bodies_[i].angular_velocity = state.bodies[i].angular_velocity - bodies_[i].angular_velocity;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i)
    joints_[i].rate = state.joints[i].rate - joints_[i].rate;
  before.sample.energy += 0.5 * (kinetic_energy(state.bodies, state.joints) -
                                 before.kinetic_energy - kinetic_energy(bodies_, joints_));
  samples_.push_back(before.sample);
}

double EnergyWatch::kinetic_energy(std::span<const BodyState> bodies,
                                   std::span<const JointState> joints) const {
  double sum = 0.;
  for (const RobotSpec& robot : experiment_.robots) {
    sum += robot_sums(robot, {}, bodies, joints).kinetic_energy;
    bodies = bodies.subspan(body_count(robot));
    joints = joints.subspan(joint_count(robot));
  }
  return sum;
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

// The last takes what the division leaves.
std::size_t EnergyWatch::end_of(std::size_t window) const {
  return window + 1 == windows ? samples_.size() : (window + 1) * (samples_.size() / windows);
}

/// From the least of the windows to the greatest after it; `window(first, last)` is the account over
/// some samples.
template <class Window>
EnergyWatch::Rise EnergyWatch::greatest_rise(const Window& window) const {
  const std::size_t count = samples_.size() / windows;
  if (count == 0) return {};
  std::array<double, windows> account{};
  for (std::size_t i = 0; i < windows; ++i) account[i] = window(i * count, end_of(i));
  const auto least = std::ranges::min_element(account);
  const auto most = std::ranges::max_element(least, account.end());
  const auto begin = [&](const auto& at) {
    return static_cast<std::size_t>(at - account.begin()) * count;
  };
  const auto end = [&](const auto& at) {
    return samples_[end_of(static_cast<std::size_t>(at - account.begin())) - 1].time;
  };
  return {*most - *least, end(least), end(most), samples_[begin(least)].time};
}

// Greatest values: between them the energy of a vibration wavers.
EnergyWatch::Rise EnergyWatch::rise_of_all() const {
  if (!ground_known_) return {};
  const Rise rise = greatest_rise([&](std::size_t first, std::size_t last) {
    const auto row = std::span(samples_).subspan(first, last - first);
    return std::ranges::max_element(row, {}, &Sample::energy)->energy;
  });
  const Rise lasting = lasting_rise();
  return lasting.energy > rise.energy ? lasting : rise;
}

EnergyWatch::Rise EnergyWatch::lasting_rise() const {
  const std::size_t count = samples_.size() / windows;
  Rise rise;
  if (count == 0) return rise;
  const auto window = [&](std::size_t i) {
    return std::span(samples_).subspan(i * count, end_of(i) - i * count);
  };
  std::size_t lowest = 0;
  double low = HUGE_VAL, size = 0.;
  for (std::size_t i = 0; i < windows; ++i) {
    const auto [least, most] = std::ranges::minmax_element(window(i), {}, &Sample::plain);
    if (least->plain - low > wavering * size && most->plain - low > rise.energy)
      rise = {most->plain - low, window(lowest).back().time, window(i).back().time,
              window(lowest).front().time};
    if (most->plain >= low) continue;
    low = most->plain;
    lowest = i;
    size = std::ranges::max_element(window(i), {}, &Sample::size)->size;
  }
  return rise;
}

// Means: while something hits the ground the numerical energy wavers, and comes back.
EnergyWatch::Rise EnergyWatch::rise_of(std::size_t robot) const {
  return greatest_rise([&](std::size_t first, std::size_t last) {
    double sum = 0.;
    for (std::size_t i = first; i < last; ++i) sum += numerical_[robot][i];
    return sum / static_cast<double>(last - first);
  });
}

double EnergyWatch::part_of(std::size_t robot) const {
  return moving_[robot].value() +
         std::abs(world_.energy_balance().driven_work(robot) - driven_before_[robot]);
}

double EnergyWatch::rounding() const {
  double size = 0.;
  for (const Sample& sample : samples_) size = std::max(size, sample.size);
  return rounding_part * size;
}

bool EnergyWatch::blames_edges(const Rise& rise) const {
  double at_edges = 0.;
  for (std::size_t k = 1; k < samples_.size(); ++k) {
    const Sample &now = samples_[k], &before = samples_[k - 1];
    if (now.jumped && now.time > rise.begin && before.time < rise.to)
      at_edges += std::max(0., now.energy - before.energy);
  }
  return at_edges > 0.5 * rise.energy;
}

std::string EnergyWatch::finding() const {
  double moving = 0.;
  for (std::size_t i = 0; i < moving_.size(); ++i) moving += part_of(i);
  Rise rise = rise_of_all();
  const bool all = rise.energy > wavering * moving + rounding() + most_in_friction_;
  std::string whose;
  if (!all) {
    for (std::size_t i = 0; measured_ && i < moving_.size(); ++i) {
      rise = rise_of(i);
      moving = part_of(i);
      if (rise.energy > wavering * moving + rounding()) {
        whose = fmt::format("robot '{}': ", experiment_.robots[i].name);
        break;
      }
    }
    if (whose.empty()) return "";
    if (moving_.size() == 1) whose.clear();
  }
  const std::string found = fmt::format(
      "{}, by {}{:.3g} J ({:.2g} % of what takes part in its motion) between {:.4g} and "
      "{:.4g} s",
      energy_finding, whose, rise.energy, 100. * rise.energy / moving, rise.from, rise.to);
  const bool on_ground = experiment_.terrain || !experiment_.obstacles.empty();
  const char* const mend =
      experiment_.touch == "points"
          ? "write touch = shapes, or give the ground finer steps and less steep tiles"
          : "give the ground damping, or less steep tiles";
  if (all && blames_edges(rise))
    return fmt::format("{}: contacts crossed edges of the ground, where their depth jumps; {}",
                       found, mend);
  const bool edges =
      all && experiment_.terrain && std::holds_alternative<GridSpec>(experiment_.terrain->surface);
  return fmt::format(
      "{}: deltat {:.4g} s is too large for how it moves; halve it, soften {}, or choose another "
      "integrator{}{}",
      found, experiment_.deltat, on_ground ? "the ground" : "springs and stops",
      edges ? "; if that changes nothing, contacts crossed edges of the ground: " : "",
      edges ? mend : "");
}

}  // namespace hookpoint::simulation
