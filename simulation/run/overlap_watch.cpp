#include "simulation/run/overlap_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// What touches by its law sinks in; less than that is nothing to speak of [m].
constexpr double least_overlap = 1e-4;

}  // namespace

OverlapWatch::OverlapWatch(const Experiment& experiment, const World& world)
    : experiment_(experiment), world_(world), others_touch_(experiment.touch == "shapes") {
  std::size_t bodies = 0;
  bool several_links = false;
  for (const RobotSpec& robot : experiment.robots) {
    first_bodies_.push_back(bodies);
    bodies += body_count(robot);
    several_links = several_links || (body_count(robot) > 2 && !robot.self_contact);
  }
  const bool several_robots = experiment.robots.size() > 1 && !others_touch_;
  if (experiment.engine != "dts" || !(several_robots || several_links)) return;
  stride_ = std::max<std::int64_t>(1, std::llround(interval / experiment.deltat));
  detection_.emplace(experiment, nullptr, 0., MemorylessDetection::Options{.self = true});
  look();
}

void OverlapWatch::look() {
  const bool start = !std::exchange(started_, true);
  const WorldState& state = world_.state();
  const auto motion = [&](const ShapeObject& object) {
    return motion_of(state.bodies[first_bodies_[object.index] + object.body]);
  };
  for (const ShapeContact& contact : detection_->detect(world_.inputs(), motion)) {
    if (contact.depth < least_overlap) continue;
    const auto a = static_cast<std::size_t>(contact.key.a);
    const auto b = static_cast<std::size_t>(contact.key.b);
    const ShapeObject &one = detection_->objects()[a], &other = detection_->objects()[b];
    const bool bodies =
        one.kind == ShapeObject::Kind::body && other.kind == ShapeObject::Kind::body;
    if (!bodies) continue;
    if (one.index == other.index ? experiment_.robots[one.index].self_contact : others_touch_)
      continue;
    const auto [at, added] = overlaps_.try_emplace(std::minmax(a, b), Overlap{0., state.time});
    // Own parts that overlap as they are built mean nothing.
    if (added && start && one.index == other.index) at->second.depth = HUGE_VAL;
    at->second.depth = std::max(at->second.depth, contact.depth);
  }
}

std::string OverlapWatch::name_of(std::size_t object) const {
  const ShapeObject& of = detection_->objects()[object];
  const RobotSpec& robot = experiment_.robots[of.index];
  return robot.name + "." + body_names(robot)[of.body];
}

std::string OverlapWatch::finding() const {
  const std::pair<const Pair, Overlap>* first = nullptr;
  std::size_t count = 0;
  for (const auto& overlap : overlaps_) {
    if (std::isinf(overlap.second.depth)) continue;
    ++count;
    if (first == nullptr || overlap.second.since < first->second.since) first = &overlap;
  }
  if (first == nullptr) return "";
  const std::size_t robot = detection_->objects()[first->first.first].index;
  const bool own = robot == detection_->objects()[first->first.second].index;
  const std::string mend =
      own ? "give Robot " + experiment_.robots[robot].name + " self_contact = true"
          : "write touch = shapes in the World";
  return fmt::format(
      "'{}' and '{}' overlap by {:.2g} m from {:.4g} s on{}, and nothing makes them "
      "touch: {}",
      name_of(first->first.first), name_of(first->first.second), first->second.depth,
      first->second.since, count > 1 ? fmt::format(" ({} pairs in all)", count) : "", mend);
}

}  // namespace hookpoint::simulation
