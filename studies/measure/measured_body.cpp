#include "studies/measure/measured_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "language/names.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;
using simulation::ExperimentError;
using simulation::RobotSpec;

/// Calls `visit(robot, index of its base in WorldState::bodies, its index)` until one returns true.
template <class Visit>
void find_robot(const Experiment& experiment, Visit visit) {
  std::size_t base = 0;
  int index = 0;
  for (const RobotSpec& robot : experiment.robots) {
    if (visit(robot, base, index++)) return;
    base += simulation::body_count(robot);
  }
}

MeasuredBody body_unasked(const Experiment& experiment) {
  MeasuredBody found;
  bool any = false;
  find_robot(experiment, [&](const RobotSpec& robot, std::size_t base, int index) {
    any = robot.mobile;
    if (any) found = {index, base, base};
    return any;
  });
  if (any) return found;
  find_robot(experiment, [&](const RobotSpec& robot, std::size_t base, int index) {
    any = !robot.chains.empty() && !robot.chains.front().links.empty();
    if (any) found = {index, base, base + robot.chains.front().links.size()};
    return any;
  });
  if (any) return found;
  throw ExperimentError("a study needs a robot that moves: one with a mobile base or with links");
}

/// "name a link of it, such as `arm.leg1.link2`"
std::string advice_for(const RobotSpec& robot, const std::vector<std::string>& trails,
                       std::size_t base) {
  const std::size_t links = simulation::joint_count(robot);
  return links == 0 ? "and its robot has no links: nothing moves"
                    : fmt::format("name a link, such as `body = {};`", trails[base + links]);
}

}  // namespace

bool something_moves(const Experiment& experiment) {
  return std::ranges::any_of(experiment.robots, [](const RobotSpec& robot) {
    return robot.mobile || (!robot.chains.empty() && !robot.chains.front().links.empty());
  });
}

MeasuredBody measured_body(const Experiment& experiment, std::string_view trail) {
  if (trail.empty()) return body_unasked(experiment);
  const std::string world = experiment.world + ".";
  std::string_view wanted = trail;
  if (wanted.starts_with(world)) wanted.remove_prefix(world.size());
  std::vector<std::string> trails = simulation::body_trails(experiment);
  MeasuredBody found;
  bool known = false;
  find_robot(experiment, [&](const RobotSpec& robot, std::size_t base, int index) {
    const auto first = trails.begin() + static_cast<std::ptrdiff_t>(base);
    const auto end = first + static_cast<std::ptrdiff_t>(simulation::body_count(robot));
    const auto named = wanted == robot.name ? first : std::find(first, end, wanted);
    known = named != end;
    if (!known) return false;
    found = {index, base, static_cast<std::size_t>(named - trails.begin())};
    if (found.body == base && !robot.mobile)
      throw ExperimentError(
          fmt::format("`{}` is held in the world; {}", trail, advice_for(robot, trails, base)));
    return true;
  });
  if (known) return found;
  for (const RobotSpec& robot : experiment.robots) trails.push_back(robot.name);
  throw ExperimentError(
      fmt::format("no body `{}` in the scene{}", trail, language::did_you_mean(wanted, trails)));
}

}  // namespace hookpoint::studies
