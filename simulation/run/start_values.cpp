#include "simulation/run/start_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/run/initial_state.h"
#include "simulation/wiring/port_search.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

constexpr std::string_view prefix = "start:";

std::vector<double> numbers(const Vector3d& v) { return {v.x, v.y, v.z}; }
std::vector<double> numbers(const Quaterniond& q) { return {q.w, q.x, q.y, q.z}; }

}  // namespace

Change change_of(const StartValue& value) {
  std::string text;
  for (const double number : value.values)
    text += (text.empty() ? "" : ",") + text::shortest(number);
  return {0, 0., std::string(prefix) + value.trail, text};
}

std::optional<StartValue> start_value_of(const Change& change) {
  if (!change.trail.starts_with(prefix)) return std::nullopt;
  StartValue value{change.trail.substr(prefix.size()), {}};
  for (std::size_t begin = 0; begin <= change.value.size();) {
    const std::size_t end = std::min(change.value.find(',', begin), change.value.size());
    const std::optional<double> number = plain_number(change.value.substr(begin, end - begin));
    if (!number)
      throw ChangesError(fmt::format("`{}` takes numbers, with commas between, not `{}`",
                                     change.trail, change.value));
    value.values.push_back(*number);
    begin = end + 1;
  }
  return value;
}

std::vector<StartValue> present_pose(const Experiment& experiment, const WorldState& state) {
  std::vector<StartValue> values;
  const auto add = [&](const std::string& trail, std::vector<double> now,
                       const std::vector<double>& own) {
    if (now != own) values.push_back({trail, std::move(now)});
  };
  auto body = state.bodies.begin();
  auto joint = state.joints.begin();
  for (const RobotSpec& robot : experiment.robots) {
    std::vector<std::string> trails = body_names(robot);
    for (std::string& trail : trails)
      trail = experiment.world + "." + robot.name + "." + trail + ".";
    if (robot.mobile) {
      const std::string& base = trails.front();
      add(base + "location", numbers(body->position), numbers(robot.location));
      add(base + "orientation", numbers(body->orientation), numbers(robot.orientation));
      add(base + "velocity", numbers(Vector3d{}), numbers(robot.velocity));
      add(base + "angular_velocity", numbers(Vector3d{}), numbers(robot.angular_velocity));
    }
    for_each_link(robot, [&](const TreeLink& at) {
      const std::string& trail = trails[1 + at.joint()];
      add(trail + "angle", {joint->angle}, {at.link.angle});
      add(trail + "rate", {0.}, {at.link.rate});
      ++joint;
    });
    body += static_cast<std::ptrdiff_t>(trails.size());
  }
  return values;
}

std::vector<StartValue> merged(std::vector<StartValue> values, std::span<const StartValue> more) {
  for (const StartValue& value : more) {
    const auto same = std::ranges::find(values, value.trail, &StartValue::trail);
    if (same == values.end())
      values.push_back(value);
    else
      *same = value;
  }
  return values;
}

Experiment started(const Experiment& experiment, World& world, std::span<const StartValue> values) {
  const InitialState initial(experiment, world.state());
  const std::vector<Port> ports = world.ports();
  std::vector<InitialValue> written;
  for (const StartValue& value : values) {
    const std::vector<Port> elements = find_ports(experiment, ports, value.trail);
    InitialValue& next = written.emplace_back(
        InitialValue{value.trail, initial.find(value.trail, elements), value.values});
    const std::size_t count = next.numbers.size(), given = value.values.size();
    if (given != count && !(count == 4 && given == 3))
      throw ExperimentError(fmt::format("`{}` takes {} number{}, not {}", value.trail, count,
                                        count == 1 ? "" : "s", given));
  }
  Experiment start = experiment;
  write_initial_state(experiment, written, start);
  return start;
}

}  // namespace hookpoint::simulation
