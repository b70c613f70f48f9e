#include "studies/measure/observer.h"

#include <algorithm>
#include <limits>

namespace hookpoint::studies {

Observer::Observer(const RunContext& context, bool with_points, bool with_feet)
    : context_(context) {
  if (with_feet && context.ground) {
    const auto& chains = context.robot_spec().chains;
    simulation::for_each_link(context.robot_spec(), [&](const simulation::TreeLink& at) {
      const auto chain = static_cast<std::size_t>(&at.chain - chains.data());
      const bool ends = at.is_last() && !simulation::carries_chains(context.robot_spec(), at.body);
      if (ends && !at.link.body.boundary_points.empty())
        followed_.push_back({chain, context.body + at.body, &at.link.body, {}});
    });
    feet_.reserve(followed_.size());
  }
  const bool looks = with_points || !followed_.empty();
  if (looks && TouchingShapes::matter(context)) shapes_.emplace(context);
  if (!with_points) return;
  std::size_t count = 0;
  simulation::for_each_body(context.robot_spec(), [&](const simulation::BodySpec& body) {
    first_points_.push_back(count);
    count += body.boundary_points.size();
  });
  points_.reserve(count);
  balls_.reserve(count);
}

Observation Observer::observe(const simulation::WorldState& world,
                              const simulation::WorldInputs* inputs) {
  static const simulation::BodyState none;
  const simulation::BodyState& body = world.bodies.empty() ? none : world.bodies[context_.watched];
  if (points_.capacity() > 0) observe_points(world);
  if (!followed_.empty()) observe_feet(world);
  if (shapes_ && inputs != nullptr) observe_shapes(world, *inputs);
  shown_ = world.time;
  return {world,
          body,
          dot(body.position - context_.start, context_.downhill),
          height_over_ground(context_, body.position),
          points_,
          inputs,
          feet_};
}

void Observer::observe_feet(const simulation::WorldState& world) {
  const bool seen = !feet_.empty();
  if (!seen) feet_.resize(followed_.size());
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    FollowedFoot& foot = followed_[i];
    const simulation::BodyState& body = world.bodies[foot.body];
    const FootObservation before = feet_[i];
    if (!seen) foot.before = body;
    FootObservation now;
    now.depth = -std::numeric_limits<double>::infinity();
    for (std::size_t point = 0; point < foot.spec->boundary_points.size(); ++point) {
      const Vector3d p_WP =
          body.position + rotate(body.orientation, foot.spec->boundary_points[point]);
      const double radius = foot.spec->boundary_radius(point);
      const contact::TilePoint tile = context_.ground->query(p_WP);
      if (!(tile.depth + radius > now.depth)) continue;
      now.depth = tile.depth + radius;
      now.point = point;
      now.position = p_WP - radius * tile.normal;
      now.normal = tile.normal;
    }
    now.chain = foot.chain;
    now.contacts = body.contacts;
    const contact::BallFrame frame{body.orientation, now.normal};
    if (seen && before.point == now.point) {
      const Vector3d moved =
          now.position - before.position -
          contact::rolling_displacement(foot.frame, frame, foot.spec->boundary_radius(now.point));
      now.slip = tangential(moved, now.normal);
    }
    foot.frame = frame;
    feet_[i] = now;
  }
}

void Observer::observe_shapes(const simulation::WorldState& world,
                              const simulation::WorldInputs& inputs) {
  for (PointObservation& point : points_) point.depth = std::min(point.depth, 0.);
  for (FootObservation& foot : feet_) foot.depth = std::min(foot.depth, 0.);
  for (const TouchingShapes::Place& place : shapes_->look(world, inputs)) {
    if (place.point && !points_.empty()) {
      PointObservation& point = points_[first_points_[place.body - context_.body] + *place.point];
      point.depth = std::max(point.depth, place.depth);
    }
    const auto at = std::ranges::find(followed_, place.body, &FollowedFoot::body);
    if (at == followed_.end()) continue;
    FootObservation& foot = feet_[static_cast<std::size_t>(at - followed_.begin())];
    if (!(place.depth > foot.depth)) continue;
    foot.depth = place.depth;
    foot.point = place.point.value_or(0);
    foot.position = place.position;
    foot.normal = place.normal;
    // Where the body had its material that touches now, and how far what it touches has come since.
    const simulation::BodyState& body = world.bodies[place.body];
    const simulation::BodyState& before = at->before;
    const Vector3d p_B = rotate(conjugate(body.orientation), place.position - body.position);
    const Vector3d moved = place.position - (before.position + rotate(before.orientation, p_B));
    foot.slip = tangential(moved - (world.time - shown_) * place.velocity, place.normal);
  }
  for (FollowedFoot& foot : followed_) foot.before = world.bodies[foot.body];
}

void Observer::observe_points(const simulation::WorldState& world) {
  points_.clear();
  for_each_body(context_, world,
                [this](const simulation::BodySpec& spec, const simulation::BodyState& body) {
                  const Matrix3d R_WB = rotation_matrix(body.orientation);
                  for (std::size_t i = 0; i < spec.boundary_points.size(); ++i)
                    observe_point(body.position + R_WB * spec.boundary_points[i], body.orientation,
                                  spec.boundary_radius(i));
                });
}

void Observer::observe_point(const Vector3d& p_WP, const Quaterniond& R_WB, double radius) {
  if (!context_.ground) {
    points_.push_back({p_WP, -std::numeric_limits<double>::infinity()});
    return;
  }
  const contact::TilePoint tile = context_.ground->query(p_WP);
  const contact::BallFrame frame{R_WB, tile.normal};
  const std::size_t index = points_.size();
  if (index == balls_.size()) balls_.push_back({frame, {}});
  RolledBall& ball = balls_[index];
  if (radius > 0.) ball.rolled += contact::rolling_displacement(ball.frame, frame, radius);
  ball.frame = frame;
  points_.push_back({p_WP - radius * tile.normal - ball.rolled, tile.depth + radius});
}

}  // namespace hookpoint::studies
