#include "contact/impulse/impulse_resolution.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {
namespace {

constexpr double reversal_reach =
    4.;  // heights of a microflight, u0^2/(2 g_n), within which points are reversed together
constexpr double reversal_tolerance = 1e-6;  // of u0: the velocity that a reversal may miss

}  // namespace

const char* advice(AdvanceStatus status) {
  switch (status) {
    case AdvanceStatus::ok:
      return "";
    case AdvanceStatus::not_finite:
      return "a number is not finite: check masses, forces and the initial state";
    case AdvanceStatus::inside_ground:
      return "the body starts inside the ground: place it above, or use rest_on";
    case AdvanceStatus::inside_body:
      return "two bodies start inside each other: place them apart, or let them not touch "
             "(contact = false on a Shape)";
    case AdvanceStatus::too_many_impacts:
      return "impacts follow one another without end: raise rebound_speed, lower restitution, "
             "shorten deltat, or give the robot fewer boundary_points";
    case AdvanceStatus::unsolved_collision:
      return "a collision has no solution: check the body's mass and inertia";
  }
  return "";
}

ImpulseResolution::ImpulseResolution(std::size_t point_count, ImpulseLaw law,
                                     const ImpulseOptions& options)
    : law_(law),
      options_(options),
      near_(point_count),
      near_index_(point_count),
      hit_now_(point_count),
      hit_(point_count) {}

void ImpulseResolution::begin_step() { std::fill(hit_.begin(), hit_.end(), char{0}); }

int ImpulseResolution::contacts() const {
  return static_cast<int>(std::count(hit_.begin(), hit_.end(), char{1}));
}

int ImpulseResolution::fastest_approach(const StruckRobot& robot) const {
  int fastest = -1;
  double lowest = -robot.rounding();
  for (std::size_t i = 0; i < robot.point_count(); ++i) {
    const GroundPoint& ground = robot.ground(i);
    if (ground.gap > options_.tolerance) continue;
    const double rate = dot(ground.normal, robot.velocity(i));
    if (rate < lowest) {
      lowest = rate;
      fastest = static_cast<int>(i);
    }
  }
  return fastest;
}

void ImpulseResolution::strike(StruckRobot& robot, std::size_t point, const Vector3d& impulse,
                               ImpulseTally& tally) {
  robot.strike(point, impulse);
  ++tally.impacts;
  tally.work += static_cast<double>(robot.point_count() + robot.body_count());
  hit_now_[point] = 1;
}

// A microcollision of the point `hit` and of all others that are about as near: whether they could
// be reversed together.
bool ImpulseResolution::reverse(StruckRobot& robot, std::size_t hit, ImpulseTally& tally) {
  const double u0 = robot.ground(hit).material->rebound_speed;
  if (!(u0 > 0.)) return false;
  const double fall = robot.begin_reversal(hit);
  if (!(fall > 0.)) return false;
  const double reach = reversal_reach * u0 * u0 / (2. * fall);
  std::size_t count = 0;
  for (std::size_t i = 0; i < robot.point_count(); ++i) {
    const GroundPoint& ground = robot.ground(i);
    if (ground.gap > reach) continue;
    if (std::abs(dot(robot.velocity(i), ground.normal)) > microcollision_limit * u0) return false;
    near_[count] = {{},
                    ground.normal,
                    ground.material->kinetic_friction,
                    (u0 / fall) * robot.flight_acceleration(i),
                    robot.collision_matrix(i),
                    {}};
    near_index_[count++] = i;
  }
  tally.work += static_cast<double>(count * count);
  const std::span<ReversalPoint> group(near_.data(), count);
  if (!robot.find_reversal(group, std::span(near_index_).first(count), reversal_tolerance * u0))
    return false;
  for (std::size_t k = 0; k < count; ++k) {
    if (dot(group[k].impulse, group[k].normal) > 0.)
      strike(robot, near_index_[k], group[k].impulse, tally);
  }
  return true;
}

AdvanceStatus ImpulseResolution::resolve(StruckRobot& robot, ImpulseTally& tally) {
  std::fill(hit_now_.begin(), hit_now_.end(), char{0});
  bool together = law_ == ImpulseLaw::impulse_reversal;
  for (int i = fastest_approach(robot); i >= 0; i = fastest_approach(robot)) {
    const std::size_t point = static_cast<std::size_t>(i);
    if (!together || !reverse(robot, point, tally)) {
      const GroundPoint& ground = robot.ground(point);
      const Collision collision = impulse(robot.collision_matrix(point), robot.velocity(point),
                                          ground.normal, *ground.material);
      if (!collision.solved) return AdvanceStatus::unsolved_collision;
      strike(robot, point, collision.impulse, tally);
    }
    together = false;
    if (is_over(tally, options_)) return AdvanceStatus::too_many_impacts;
  }
  for (std::size_t i = 0; i < hit_now_.size(); ++i) {
    if (!hit_now_[i]) continue;
    hit_[i] = 1;
    ++tally.lift_offs;
    tally.deepest = std::max(tally.deepest, -robot.ground(i).gap);
  }
  return AdvanceStatus::ok;
}

}  // namespace hookpoint::contact
