#include "contact/impulse/impulse_resolution.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::contact {
namespace {

constexpr double reversal_reach =
    4.;  // heights of a microflight, u0^2/(2 g_n), within which points are reversed together
constexpr double reversal_tolerance = 1e-6;  // of u0: the velocity that a reversal may miss
// Of the speeds of points hit together: what their common solution may leave of an approach.
constexpr double left_of_approach = 1e-9;
constexpr double equal_approach = 1e-9;  // share by which two approaches count as equal
constexpr double same_normal = 1e-12;    // largest difference of two unit normals of one face

void note_order(ImpulseTally& tally, OrderCause cause) {
  if (tally.order_matters == OrderCause::none) tally.order_matters = cause;
}

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
    case AdvanceStatus::came_inside:
      return "it came inside what it touches without an impact: make deltat smaller, or choose "
             "contact = impulse_reversal or a force law";
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
      hit_(point_count),
      face_(point_count),
      corners_(point_count + 1),
      taken_(point_count),
      together_(std::min(point_count, most_hit_together)),
      colliding_(together_.most()) {
  approaching_.reserve(point_count);
}

void ImpulseResolution::begin_step() { std::fill(hit_.begin(), hit_.end(), char{0}); }

int ImpulseResolution::contacts() const {
  return static_cast<int>(std::count(hit_.begin(), hit_.end(), char{1}));
}

// Speed with which a touching point approaches; 0 where it does not.
double ImpulseResolution::approach(const StruckRobot& robot, std::size_t point) const {
  const GroundPoint& ground = robot.ground(point);
  if (ground.gap > options_.tolerance) return 0.;
  const double rate = -dot(ground.normal, robot.velocity(point));
  return rate > least_approach_ ? rate : 0.;
}

void ImpulseResolution::find_approaching(const StruckRobot& robot) {
  approaching_.clear();
  for (std::size_t i = 0; i < robot.point_count(); ++i)
    if (approach(robot, i) > 0.) approaching_.push_back(i);
}

// Of the approaching points of one face, its corners.
void ImpulseResolution::keep_corners(const StruckRobot& robot) {
  for (const std::size_t i : approaching_) taken_[i] = 0;
  std::size_t kept = 0;
  const std::size_t count = approaching_.size();
  for (std::size_t first = 0; first < count; ++first) {
    const std::size_t i = approaching_[first];
    if (taken_[i]) continue;
    const GroundPoint& ground = robot.ground(i);
    const Vector3d& n = ground.normal;
    const Vector3d along = std::abs(n.x) < 0.6 ? Vector3d{1., 0., 0.} : Vector3d{0., 1., 0.};
    const Vector3d e1 = cross(n, along), e2 = cross(n, e1);
    std::size_t size = 0;
    for (std::size_t k = first; k < count; ++k) {
      const std::size_t j = approaching_[k];
      const GroundPoint& other = robot.ground(j);
      if (taken_[j] || other.material != ground.material || !robot.same_bodies(i, j) ||
          norm(other.normal - n) > same_normal)
        continue;
      taken_[j] = 1;
      const Vector3d arm = robot.place(j) - robot.place(i);
      face_[size++] = {dot(e1, arm), dot(e2, arm), j};
    }
    const std::size_t corners = keep_extreme(std::span(face_).first(size), corners_);
    for (std::size_t k = 0; k < corners; ++k) taken_[face_[k].number] = 2;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (taken_[approaching_[k]] == 2) approaching_[kept++] = approaching_[k];
  approaching_.resize(kept);
}

// Those of approaching_ that act on its first, directly or through others: moved out of it.
std::span<std::size_t> ImpulseResolution::take_group(StruckRobot& robot) {
  std::size_t size = 1;
  for (std::size_t from = 0; from < size; ++from) {
    for (std::size_t k = size; k < approaching_.size(); ++k) {
      if (robot.coupling(approaching_[from], approaching_[k]) == Matrix3d{}) continue;
      std::swap(approaching_[size], approaching_[k]);
      ++size;
    }
  }
  return std::span(approaching_).first(size);
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

// Of equals the first.
std::size_t ImpulseResolution::fastest_of(const StruckRobot& robot,
                                          std::span<const std::size_t> group) const {
  std::size_t fastest = group[0];
  for (const std::size_t i : group) {
    const double faster = approach(robot, i) - approach(robot, fastest);
    if (faster > 0. || (faster == 0. && i < fastest)) fastest = i;
  }
  return fastest;
}

// Whether a microcollision of `fastest` comes before that of a point as fast, on which it acts, because of
// their numbers alone.
void ImpulseResolution::look_for_ties(StruckRobot& robot, std::size_t fastest,
                                      ImpulseTally& tally) const {
  if (tally.order_matters != OrderCause::none) return;
  const double equal = (1. - equal_approach) * approach(robot, fastest);
  for (const std::size_t i : approaching_) {
    if (i == fastest || approach(robot, i) < equal) continue;
    if (robot.coupling(fastest, i) == Matrix3d{}) continue;
    note_order(tally, OrderCause::microcollisions);
    return;
  }
}

AdvanceStatus ImpulseResolution::hit_alone(StruckRobot& robot, std::size_t point,
                                           ImpulseTally& tally) {
  const GroundPoint& ground = robot.ground(point);
  const Collision collision = impulse(robot.collision_matrix(point), robot.velocity(point),
                                      ground.normal, *ground.material);
  if (!collision.solved) return AdvanceStatus::unsolved_collision;
  strike(robot, point, collision.impulse, tally);
  return AdvanceStatus::ok;
}

bool ImpulseResolution::hit_together(StruckRobot& robot, std::span<const std::size_t> group,
                                     ImpulseTally& tally) {
  if (group.size() > together_.most()) return false;
  const std::span<CollidingPoint> points = std::span(colliding_).first(group.size());
  double speed = 0.;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const GroundPoint& ground = robot.ground(group[k]);
    const auto& material = *ground.material;
    points[k] = {robot.velocity(group[k]), ground.normal,          material.kinetic_friction,
                 material.restitution,     material.rebound_speed, {}};
    speed = std::max(speed, norm(points[k].u));
  }
  tally.work += static_cast<double>(group.size() * group.size());
  const auto coupling = [&](std::size_t i, std::size_t j) {
    return i == j ? general(robot.collision_matrix(group[i])) : robot.coupling(group[i], group[j]);
  };
  if (!together_.resolve(points, coupling)) return false;
  for (std::size_t k = 0; k < group.size(); ++k) strike(robot, group[k], points[k].impulse, tally);
  least_approach_ = std::max(least_approach_, left_of_approach * speed);
  return true;
}

// Moves those of the group that lie on the bodies of its fastest point (of equals the first) to its front:
// how many they are. Others that approach as fast wait because of their numbers alone, which is noted.
std::size_t ImpulseResolution::fastest_face(const StruckRobot& robot, std::span<std::size_t> group,
                                            ImpulseTally& tally) const {
  const std::size_t fastest = fastest_of(robot, group);
  const double equal = (1. - equal_approach) * approach(robot, fastest);
  std::size_t size = 0, waiting = 0;
  for (std::size_t k = 0; k < group.size(); ++k) {
    if (robot.same_bodies(fastest, group[k]))
      std::swap(group[size++], group[k]);
    else if (approach(robot, group[k]) >= equal)
      ++waiting;
  }
  if (waiting > 0) note_order(tally, OrderCause::different_bodies);
  return size;
}

// All that approach now. Groups do not act on each other; of a group the fastest face is hit.
AdvanceStatus ImpulseResolution::hit_faces(StruckRobot& robot, ImpulseTally& tally) {
  keep_corners(robot);
  while (!approaching_.empty()) {
    const std::span<std::size_t> group = take_group(robot);
    const std::span<std::size_t> face = group.first(fastest_face(robot, group, tally));
    if (face.size() == 1 || !hit_together(robot, face, tally)) {
      if (face.size() > 1)
        note_order(tally, face.size() > together_.most() ? OrderCause::many_corners
                                                         : OrderCause::unsolved);
      const AdvanceStatus status = hit_alone(robot, fastest_of(robot, face), tally);
      if (status != AdvanceStatus::ok) return status;
    }
    approaching_.erase(approaching_.begin(),
                       approaching_.begin() + static_cast<std::ptrdiff_t>(group.size()));
  }
  return AdvanceStatus::ok;
}

AdvanceStatus ImpulseResolution::resolve(StruckRobot& robot, ImpulseTally& tally) {
  std::fill(hit_now_.begin(), hit_now_.end(), char{0});
  least_approach_ = robot.rounding();
  bool reverses = law_ == ImpulseLaw::impulse_reversal;
  for (find_approaching(robot); !approaching_.empty(); find_approaching(robot)) {
    const std::size_t fastest = fastest_of(robot, approaching_);
    if (!reverses || !reverse(robot, fastest, tally)) {
      const double u0 = robot.ground(fastest).material->rebound_speed;
      const bool lands = approach(robot, fastest) > microcollision_limit * u0;
      if (!lands) look_for_ties(robot, fastest, tally);
      const AdvanceStatus status =
          lands ? hit_faces(robot, tally) : hit_alone(robot, fastest, tally);
      if (status != AdvanceStatus::ok) return status;
    }
    reverses = false;
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
