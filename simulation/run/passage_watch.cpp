#include "simulation/run/passage_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "simulation/dts_engine/shape_detection.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// The middles of an object's convex shapes.
std::vector<Vector3d> middles_of(const ShapeObject& object) {
  std::vector<Vector3d> middles;
  for (const RoundFeature& round : object.rounds)
    middles.push_back(0.5 * (round.solid.from + round.solid.to));
  for (const PolyhedronFeature& polyhedron : object.polyhedra) {
    const std::vector<Vector3d>& vertices = polyhedron.solid->vertices();
    middles.push_back((1. / static_cast<double>(vertices.size())) *
                      std::accumulate(vertices.begin(), vertices.end(), Vector3d{}));
  }
  return middles;
}

bool contains(const contact::RoundSolid& solid, const Vector3d& place) {
  const double along = std::clamp(dot(place - solid.from, solid.axis), 0., solid.length());
  return norm(place - solid.from - along * solid.axis) < std::max(solid.radius, solid.far_radius);
}

bool contains(const ShapeObject& object, const Vector3d& place) {
  return std::ranges::any_of(
             object.polyhedra,
             [&](const PolyhedronFeature& of) { return of.solid->contains(place); }) ||
         std::ranges::any_of(object.rounds,
                             [&](const RoundFeature& of) { return contains(of.solid, place); });
}

}  // namespace

PassageWatch::PassageWatch(const Experiment& experiment, const World& world)
    : experiment_(experiment), world_(world) {
  if (experiment.engine != "dts" || experiment.obstacles.empty()) return;
  objects_ = shape_objects(experiment, nullptr);
  std::vector<std::size_t> first_bodies{0};
  for (const RobotSpec& robot : experiment.robots)
    first_bodies.push_back(first_bodies.back() + body_count(robot));
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const ShapeObject& object = objects_[i];
    if (object.kind == ShapeObject::Kind::body && object.movable) {
      for (const Vector3d& middle : middles_of(object))
        shapes_.push_back({i, first_bodies[object.index] + object.body, middle});
    } else if (object.kind == ShapeObject::Kind::obstacle) {
      const Vector3d size = object.bounds.high - object.bounds.low;
      const double least = std::min({size.x, size.y, size.z});
      const Vector3d across = size.x == least   ? Vector3d{1., 0., 0.}
                              : size.y == least ? Vector3d{0., 1., 0.}
                                                : Vector3d{0., 0., 1.};
      middles_.push_back({i, 0.5 * (object.bounds.low + object.bounds.high), across, least});
    }
  }
  before_.resize(shapes_.size() * middles_.size());
  look();
}

Vector3d PassageWatch::place(const Shape& shape, const Middle& middle) const {
  const ObjectMotion body = motion_of(world_.state().bodies[shape.body]);
  const ObjectMotion obstacle =
      motion_of(world_.inputs().obstacles[objects_[middle.object].index], 0.);
  return obstacle.to_object(body.to_world(shape.middle));
}

bool PassageWatch::passes(const Middle& middle, const Vector3d& from, const Vector3d& to) const {
  const double before = dot(from - middle.center, middle.across),
               now = dot(to - middle.center, middle.across);
  if ((before >= 0.) == (now >= 0.)) return false;
  return contains(objects_[middle.object], from + (before / (before - now)) * (to - from));
}

void PassageWatch::look() {
  const std::int64_t step = world_.state().step;
  if (step % interval != 0) return;
  const bool follows = step_ >= 0 && step == step_ + interval;
  step_ = step;
  std::size_t at = 0;
  for (const Shape& shape : shapes_) {
    for (const Middle& middle : middles_) {
      const Vector3d now = place(shape, middle);
      if (follows && finding_.empty() && passes(middle, before_[at], now))
        finding_ = describe(shape, middle, norm(now - before_[at]) / static_cast<double>(interval));
      before_[at++] = now;
    }
  }
}

std::string PassageWatch::describe(const Shape& shape, const Middle& middle, double way) const {
  const ShapeObject& object = objects_[shape.object];
  const RobotSpec& robot = experiment_.robots[object.index];
  return fmt::format(
      "'{}.{}' passed through Obstacle '{}', {:.3g} m thick, at {:.4g} s: it penetrates deeper than the "
      "obstacle is thick, or moves too far in a step ({:.2g} m); make the obstacle thicker or stiffer, or "
      "deltat smaller",
      robot.name, body_names(robot)[object.body],
      experiment_.obstacles[objects_[middle.object].index].name, middle.thickness,
      world_.state().time, way);
}

}  // namespace hookpoint::simulation
