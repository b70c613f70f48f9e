#include "simulation/run/initial_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "math/orientation.h"
#include "simulation/experiment/start_problems.h"

namespace hookpoint::simulation {
namespace {

/// Numbers of a base, in order: location 3, orientation 4, velocity 3, angular velocity 3.
constexpr std::size_t orientation_place = 3, quaternion_size = 4;

/// Appends the addresses of a base's numbers.
template <class Number, class Vector, class Quaternion>
void add_base_numbers(std::vector<Number*>& numbers, Vector& location, Quaternion& orientation,
                      Vector& velocity, Vector& angular_velocity) {
  const auto add = [&](Vector& v) { numbers.insert(numbers.end(), {&v.x, &v.y, &v.z}); };
  add(location);
  numbers.insert(numbers.end(), {&orientation.w, &orientation.x, &orientation.y, &orientation.z});
  add(velocity);
  add(angular_velocity);
}

/// Where an experiment states the numbers of its initial state. `Spec`: RobotSpec, const or not.
template <class Number, class Spec>
void add_robot_numbers(std::vector<Number*>& numbers, Spec& robot) {
  add_base_numbers<Number>(numbers, robot.location, robot.orientation, robot.velocity,
                           robot.angular_velocity);
  for (auto& chain : robot.chains) {
    for (auto& link : chain.links) numbers.insert(numbers.end(), {&link.angle, &link.rate});
  }
}

/// Where an engine publishes the same numbers, in the same order.
std::vector<const double*> published_numbers(const Experiment& experiment,
                                             const WorldState& state) {
  std::vector<const double*> numbers;
  auto body = state.bodies.begin();
  auto joint = state.joints.begin();
  for (const RobotSpec& robot : experiment.robots) {
    add_base_numbers<const double>(numbers, body->position, body->orientation, body->velocity,
                                   body->angular_velocity);
    ++body;
    for (const ChainSpec& chain : robot.chains) {
      for (std::size_t i = 0; i < chain.links.size(); ++i, ++body, ++joint)
        numbers.insert(numbers.end(), {&joint->angle, &joint->rate});
    }
  }
  return numbers;
}

/// The first number of each robot.
std::vector<std::size_t> first_numbers(const Experiment& experiment) {
  std::vector<std::size_t> firsts;
  std::vector<const double*> numbers;
  for (const RobotSpec& robot : experiment.robots) {
    firsts.push_back(numbers.size());
    add_robot_numbers(numbers, robot);
  }
  return firsts;
}

/// The numbers that `written` stands for. Throws ExperimentError.
std::vector<double> numbers_of(const InitialValue& written) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(written.values, finite))
    throw ExperimentError(fmt::format("`{}` takes finite numbers", written.trail));
  if (written.numbers.size() != quaternion_size) return written.values;
  const std::optional<std::array<double, 4>> unit = orientation_of(written.values);
  if (!unit)
    throw ExperimentError(
        fmt::format("`{}` must not be the zero quaternion: it takes w, x, y, z, or roll, pitch and "
                    "yaw in rad",
                    written.trail));
  return {unit->begin(), unit->end()};
}

void check(const Experiment& experiment, const RobotSpec& robot) {
  const std::string trail = experiment.world + "." + robot.name + ".";
  const auto refuse = [&](const std::string& port, const std::string& problem) {
    if (!problem.empty()) throw ExperimentError(fmt::format("`{}{}`: {}", trail, port, problem));
  };
  const std::string base = robot.base.name.empty() ? "base" : robot.base.name;
  refuse(base + ".velocity", velocity_problem(robot));
  refuse(base + ".angular_velocity", angular_velocity_problem(robot));
  for (const ChainSpec& chain : robot.chains) {
    for (const LinkSpec& link : chain.links)
      refuse(chain.name + "." + link.body.name + ".angle", angle_problem(link));
  }
}

}  // namespace

InitialState::InitialState(const Experiment& experiment, const WorldState& published) {
  const std::vector<const double*> numbers = published_numbers(experiment, published);
  for (std::size_t i = 0; i < numbers.size(); ++i) by_address_.emplace_back(numbers[i], i);
  std::ranges::sort(by_address_);
  for (const std::size_t first : first_numbers(experiment))
    orientations_.push_back(first + orientation_place);
}

std::vector<std::size_t> InitialState::find(const std::string& trail,
                                            std::span<const Port> elements) const {
  std::vector<std::size_t> found;
  for (const Port& element : elements) {
    const auto at = std::ranges::lower_bound(by_address_, element.value, {},
                                             [](const auto& e) { return e.first; });
    if (at == by_address_.end() || at->first != element.value)
      throw ExperimentError(
          fmt::format("`{}` is not part of an initial state: location, orientation, velocity and "
                      "angular_velocity of a base are, and angle and rate of a joint",
                      trail));
    found.push_back(at->second);
  }
  const auto in_orientation = [&](std::size_t number) {
    return std::ranges::any_of(orientations_, [&](std::size_t first) {
      return number >= first && number < first + quaternion_size;
    });
  };
  if (found.size() != quaternion_size && std::ranges::any_of(found, in_orientation))
    throw ExperimentError(fmt::format(
        "`{}` is a part of an orientation: write the whole, w, x, y, z or roll, pitch, yaw",
        trail));
  return found;
}

void write_initial_state(const Experiment& own, std::span<const InitialValue> written,
                         Experiment& start) {
  std::vector<const double*> from;
  std::vector<double*> to;
  for (std::size_t i = 0; i < own.robots.size(); ++i) {
    add_robot_numbers(from, own.robots[i]);
    add_robot_numbers(to, start.robots[i]);
  }
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = *from[i];
  for (const InitialValue& value : written) {
    const std::vector<double> numbers = numbers_of(value);
    for (std::size_t i = 0; i < numbers.size(); ++i) *to[value.numbers[i]] = numbers[i];
  }
  // A start that was settled is one of its own pose alone: what is moved starts with slack springs.
  const std::vector<std::size_t> firsts = first_numbers(own);
  for (std::size_t r = 0; r < firsts.size(); ++r) {
    const std::size_t end = r + 1 < firsts.size() ? firsts[r + 1] : to.size();
    const bool moved = std::ranges::any_of(written, [&](const InitialValue& value) {
      return value.numbers.front() >= firsts[r] && value.numbers.front() < end;
    });
    start.robots[r].settled = moved ? std::nullopt : own.robots[r].settled;
  }
  for (const RobotSpec& robot : start.robots) check(start, robot);
}

}  // namespace hookpoint::simulation
