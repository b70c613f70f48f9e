#include "simulation/dts_engine/impulse_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/geometry/folds.h"
#include "contact/impulse/gap_cubic.h"
#include "contact/impulse/landing_time.h"
#include "dts/impulse_response.h"
#include "simulation/dts_engine/publish.h"
#include "simulation/dts_engine/shape_places.h"
#include "simulation/dts_engine/tile_places.h"

namespace hookpoint::simulation {
namespace {

using contact::AdvanceStatus;

constexpr double deepest_start = 1e-9;  // what rounding of a pose between steps may cost [m]
/// What a place that moves along a rim may have sunk by since, flight by flight [m].
constexpr double deepest_in_run = 1e-6;
// Share of the robot's speeds that is no approach: what rounding leaves of a point that was
// stopped, or that nothing can move along its normal.
constexpr double speed_rounding = 1e-11;
constexpr int interpolations = 6;  // trials by interpolation before halving
constexpr int most_trials = 60;
constexpr int most_flights_per_impact = 10;
/// Farthest way of a body in one flight among shapes [m]: what is nearer than two of them is looked at,
/// so that less is faster where much lies together, and more where bodies are fast.
constexpr double shapes_travel = 5e-3;
constexpr std::size_t stages_of_flight = 4;  // of Runge-Kutta
// Share of tr K added to K: a point of a robot with a fixed base may have directions in which
// nothing can move it, and the collision is to find that they play no part.
constexpr double yielding_share = 1e-13;

// The time in which something that moves at `speed` and gains `acceleration` covers `way`.
double time_to_cover(double way, double speed, double acceleration) {
  return 2. * way / std::max(speed + std::sqrt(speed * speed + 2. * acceleration * way), 1e-300);
}

std::vector<ArticulatedRobot> robots_of(const Experiment& experiment, RobotRange range,
                                        const WorldInputs& inputs) {
  std::vector<ArticulatedRobot> robots;
  robots.reserve(range.count);
  for (std::size_t i = 0; i < range.count; ++i)
    robots.emplace_back(experiment, range.first + i, inputs);
  return robots;
}

std::unique_ptr<ImpulsePlaces> places_of(const Experiment& experiment, RobotRange range,
                                         const contact::Terrain* ground,
                                         const WorldInputs& inputs) {
  if (impulses_together(experiment)) {
    // Two bodies may come towards each other.
    return std::make_unique<ShapePlaces>(experiment, ground, inputs, 2. * shapes_travel,
                                         2. * contact::edge_width);
  }
  const bool touches = ground != nullptr;
  return std::make_unique<TilePlaces>(touches ? boundary_points(experiment.robots[range.first])
                                              : std::vector<BoundaryPoint>{});
}

}  // namespace

ImpulseGroup::ImpulseGroup(const Experiment& experiment, RobotRange robots, contact::ImpulseLaw law,
                           const contact::Terrain* ground, const WorldInputs& inputs,
                           const contact::ImpulseOptions& options)
    : ImpulsePart(experiment, robots, ground),
      options_(options),
      together_(impulses_together(experiment)),
      robots_(robots_of(experiment, robots, inputs)),
      places_(places_of(experiment, robots, ground, inputs)),
      starts_(places_->room()),
      resolution_(places_->room(), law, options),
      inertias_ready_(robots_.size()) {
  if (together_) options_.largest_travel = std::min(options_.largest_travel, shapes_travel);
  std::size_t bodies = 0, positions = 0, velocities = 0;
  flights_.reserve(robots_.size());
  for (ArticulatedRobot& robot : robots_) {
    first_bodies_.push_back(bodies);
    bodies += robot.model().body_count();
    joint_count_ += robot.model().link_count();
    positions += robot.position_count();
    velocities += robot.velocity_count();
    flights_.emplace_back(robot).refresh();
    robot.accelerate();  // what is published of the initial state
  }
  change_.resize(velocities);
  q_before_.resize(positions);
  v_before_.resize(velocities);
  impulses_.resize(bodies);
  contacts_.resize(bodies);
  if (together_) surface_works_.resize(experiment.obstacles.size() + (ground != nullptr ? 1 : 0));
  impulses_before_ = impulses_;
  contacts_before_ = contacts_;
  works_before_ = surface_works_;
  if (law != contact::ImpulseLaw::impulse_reversal) return;
  const std::size_t most = std::min(places_->room(), most_reversed_together);
  couplings_.resize(most * most);
  velocities_.resize(most);
  work_.resize(most);
}

template <class Visit>
void ImpulseGroup::for_each_robot(const Visit& visit) const {
  std::size_t first_q = 0, first_v = 0;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    visit(i, first_q, first_v);
    first_q += robots_[i].position_count();
    first_v += robots_[i].velocity_count();
  }
}

void ImpulseGroup::locate(const contact::GroundQuery& ground, double elapsed) {
  std::ranges::fill(inertias_ready_, char{0});
  places_->locate(robots_, ground, elapsed);
}

double ImpulseGroup::lowest_gap() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const ImpulsePlace& place : places_->places()) lowest = std::min(lowest, place.ground.gap);
  return lowest;
}

double ImpulseGroup::greatest_speed() const {
  double fastest = 0.;
  for (const ImpulsePlace& place : places_->places()) {
    if (std::isinf(place.ground.gap)) continue;
    for (const PlaceSide& side : place.bodies()) {
      const dts::BodyMotion<double>& body = robots_[side.robot].workspace().bodies[side.body];
      fastest = std::max(fastest, norm(body.v_WB) + norm(body.w_WB) * norm(side.arm));
    }
  }
  return fastest;
}

// No body turns by more than `largest_turn` or goes farther than `largest_travel`, as far as the
// accelerations at the start tell.
double ImpulseGroup::longest_flight(double left) const {
  left = std::min(left, places_->longest_flight(options_.largest_turn, options_.largest_travel));
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    const auto& bodies = robots_[robot].workspace().bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const dts::Motion<double>& a = flights_[robot].body_accelerations()[i];
      left = std::min(
          {left, time_to_cover(options_.largest_turn, norm(bodies[i].w_WB), norm(a.angular)),
           time_to_cover(options_.largest_travel, norm(bodies[i].v_WB), norm(a.linear))});
    }
  }
  return left;
}

// When the first place lands, at most `longest`, by the quadratic of its gap; remembers where the
// places start.
double ImpulseGroup::safe_time(double longest) {
  double safe = longest;
  const std::span<const ImpulsePlace> places = places_->places();
  started_ = places.size();
  for (std::size_t i = 0; i < started_; ++i) {
    starts_[i].gap = places[i].ground.gap;
    if (std::isinf(starts_[i].gap)) continue;
    const Vector3d& n = places[i].ground.normal;
    starts_[i].rate = dot(n, velocity(i));
    const double acceleration = dot(n, flight_acceleration(i));
    safe = std::min(safe, contact::landing_time(starts_[i].gap, starts_[i].rate, acceleration,
                                                0.5 * options_.tolerance));
  }
  return safe;
}

// The first landing of a place that has come below `floor` in the flight of `duration`; `duration` if
// none has. One that was far away at the start lands somewhere on the way.
double ImpulseGroup::landing(double duration, double floor) const {
  double first = duration;
  const std::span<const ImpulsePlace> places = places_->places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const contact::GroundPoint& now = places[i].ground;
    if (std::isinf(now.gap)) continue;
    if (i >= started_ || std::isinf(starts_[i].gap)) {
      if (now.gap < floor) first = std::min(first, 0.5 * duration);
      continue;
    }
    const double rate = dot(now.normal, velocity(i));
    const bool dips = starts_[i].rate < 0. && rate > 0.;
    if (now.gap >= floor && !dips) continue;
    const contact::GapCubic gap({starts_[i].gap, starts_[i].rate}, {now.gap, rate}, duration);
    first = std::min(first, gap.landing(floor));
  }
  return first;
}

integrators::Status ImpulseGroup::begin_flight() {
  for (RobotFlight& flight : flights_)
    if (const auto status = flight.begin(); status != integrators::Status::ok) return status;
  return integrators::Status::ok;
}

integrators::Status ImpulseGroup::fly(double duration) {
  for (RobotFlight& flight : flights_)
    if (const auto status = flight.fly(duration); status != integrators::Status::ok) return status;
  return integrators::Status::ok;
}

// One flight of at most `longest`, ended at the first impact. What the quadratic promises is tried,
// and believed only if no place is closed at its end and none has been on its way; otherwise the
// landing between is interpolated, and if that does not converge (another surface came under a point)
// the flight is halved.
AdvanceStatus ImpulseGroup::fly_above(const contact::GroundQuery& ground, double elapsed,
                                      double longest, double* duration,
                                      contact::ImpulseTally& tally) {
  const double floor = std::min(0., lowest_gap()) - options_.tolerance;
  *duration = safe_time(longest);
  const double work = static_cast<double>(stages_of_flight * body_count() + point_count());
  for (int trial = 0; trial < most_trials; ++trial) {
    tally.work += work;
    if (fly(*duration) != integrators::Status::ok) return AdvanceStatus::not_finite;
    locate(ground, elapsed + *duration);
    const double first = landing(*duration, floor);
    if (first >= *duration) {
      // A landing that the interpolation cannot place is one all the same.
      if (lowest_gap() >= floor) return AdvanceStatus::ok;
      *duration *= 0.5;
    } else {
      *duration = trial < interpolations && first > 0. ? first : 0.5 * *duration;
    }
  }
  for (RobotFlight& flight : flights_) flight.go_back();
  locate(ground, elapsed);
  *duration = 0.;
  return inside();
}

// Whether something is deeper inside than rounding leaves it.
AdvanceStatus ImpulseGroup::inside() const {
  const double deepest = in_run() ? deepest_in_run : deepest_start;
  for (const ImpulsePlace& place : places_->places()) {
    if (place.ground.gap < -deepest - places_->margin())
      return place.surface < 0 ? AdvanceStatus::inside_body : AdvanceStatus::inside_ground;
  }
  return AdvanceStatus::ok;
}

AdvanceStatus ImpulseGroup::run(const contact::GroundQuery& ground, contact::ImpulseTally& tally) {
  locate(ground, 0.);
  if (const AdvanceStatus status = inside(); status != AdvanceStatus::ok) return status;
  double left = experiment_.deltat;
  const std::int64_t most_flights =
      most_flights_per_impact * static_cast<std::int64_t>(options_.most_impacts);
  for (std::int64_t flights = 0; left > 0.; ++flights) {
    if (flights > most_flights || is_over(tally, options_)) return AdvanceStatus::too_many_impacts;
    rounding_ = speed_rounding * greatest_speed();
    const AdvanceStatus collided = resolution_.resolve(*this, tally);
    if (collided != AdvanceStatus::ok) return collided;
    if (begin_flight() != integrators::Status::ok) return AdvanceStatus::not_finite;
    for (std::size_t i = 0; i < meters_.size(); ++i) meters_[i].begin(robots_[i]);
    double duration = 0.;
    const AdvanceStatus flown =
        fly_above(ground, experiment_.deltat - left, longest_flight(left), &duration, tally);
    if (flown != AdvanceStatus::ok) return flown;
    for (std::size_t i = 0; i < meters_.size(); ++i) meters_[i].end(robots_[i]);
    left -= duration;
  }
  tally.deepest = std::max(tally.deepest, -lowest_gap());
  return AdvanceStatus::ok;
}

void ImpulseGroup::keep_motion() {
  for_each_robot([&](std::size_t i, std::size_t first_q, std::size_t first_v) {
    RobotFlight& flight = flights_[i];
    flight.read();
    std::ranges::copy(flight.positions(), std::span(q_before_).subspan(first_q).begin());
    std::ranges::copy(flight.velocities(), std::span(v_before_).subspan(first_v).begin());
    robots_[i].joints().keep();
    flight.refresh();  // under the present inputs
  });
}

contact::ImpulseTally ImpulseGroup::advance(const contact::GroundQuery& ground) {
  contact::ImpulseTally tally;
  keep_motion();
  impulses_before_.swap(impulses_);
  contacts_before_.swap(contacts_);
  std::fill(impulses_.begin(), impulses_.end(), Vector3d{});
  std::fill(contacts_.begin(), contacts_.end(), 0);
  works_before_ = surface_works_;
  for (WorkMeter& meter : meters_) meter.begin_step();
  places_->begin_step();
  resolution_.begin_step();
  tally.status = run(ground, tally);
  if (tally.status != AdvanceStatus::ok) {
    go_back();
    return tally;
  }
  tally.contacts = resolution_.contacts();
  for (std::size_t i = 0; i < point_count(); ++i) {
    if (!resolution_.hit(i)) continue;
    const ImpulsePlace& place = places_->places()[i];
    for (const PlaceSide& side : place.bodies()) ++contacts_[body_number(side)];
    if (!together_ || place.surface != 0) continue;
    const PlaceSide& side = place.sides[0];
    if (const auto beside = places_->beside_ground(body_point(side).p_WP))
      look_for_edge(robots_[side.robot].index(), *beside);
  }
  return tally;
}

void ImpulseGroup::measure_work() {
  for (std::size_t i = meters_.size(); i < robots_.size(); ++i)
    meters_.emplace_back(robots_[i], WorkMeter::Quadrature::ends);
}

void ImpulseGroup::go_back() {
  for_each_robot([&](std::size_t i, std::size_t first_q, std::size_t first_v) {
    ArticulatedRobot& robot = robots_[i];
    robot.joints().undo();
    flights_[i].go_to(std::span(q_before_).subspan(first_q, robot.position_count()),
                      std::span(v_before_).subspan(first_v, robot.velocity_count()));
  });
  impulses_ = impulses_before_;
  contacts_ = contacts_before_;
  surface_works_ = works_before_;
}

const std::string& ImpulseGroup::failed_robot() const {
  const auto lowest = std::ranges::min_element(
      places_->places(), {}, [](const ImpulsePlace& place) { return place.ground.gap; });
  if (lowest == places_->places().end()) return ImpulsePart::failed_robot();
  return robots_[lowest->sides[0].robot].spec().name;
}

void ImpulseGroup::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  std::size_t joint = 0;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const dts::Model<double>& model = robots_[i].model();
    publish_motion(robots_[i], bodies.subspan(first_bodies_[i], model.body_count()));
    publish_joints(robots_[i], joints.subspan(joint, model.link_count()));
    joint += model.link_count();
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].contact_force = (1. / experiment_.deltat) * impulses_[i];
    bodies[i].contacts = contacts_[i];
  }
}

// Under `touch = shapes` the places that were hit in the last step.
void ImpulseGroup::add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                                std::vector<ContactView>& contacts) const {
  if (!together_) return ImpulsePart::add_contacts(first_body, bodies, contacts);
  for (std::size_t i = 0; i < point_count(); ++i) {
    if (!resolution_.hit(i)) continue;
    const ImpulsePlace& place = places_->places()[i];
    for (const PlaceSide& side : place.bodies()) {
      const std::size_t body = body_number(side);
      const Vector3d at = bodies[body].position + side.arm;
      const Vector3d share = (1. / std::max(1, contacts_[body])) * bodies[body].contact_force;
      contacts.push_back({first_body + body, at, share, at, -place.ground.gap, -1.});
    }
  }
}

// What evolves: the parts of `exchange`, then the signs of the links' quaternions.

std::size_t ImpulseGroup::state_size() const { return count_of(*this) + joint_count(); }

std::string ImpulseGroup::state_layout() const {
  return fmt::format("{} quaternion_sign[{}]", layout_of(*this), joint_count());
}

void ImpulseGroup::save(std::span<double> numbers, std::span<const BodyState> bodies) const {
  save_to(numbers, *this);
  std::span<double> signs = numbers.last(joint_count());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const dts::Model<double>& model = robots_[i].model();
    save_signs(robots_[i], bodies.subspan(first_bodies_[i], model.body_count()),
               signs.first(model.link_count()));
    signs = signs.subspan(model.link_count());
  }
}

void ImpulseGroup::restore(std::span<const double> numbers, std::span<BodyState> bodies) {
  restore_from(numbers, *this);
  std::span<const double> signs = numbers.last(joint_count());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const dts::Model<double>& model = robots_[i].model();
    flights_[i].refresh();
    restore_signs(robots_[i], signs.first(model.link_count()),
                  bodies.subspan(first_bodies_[i], model.body_count()));
    signs = signs.subspan(model.link_count());
  }
}

// What the collisions ask, answered by the recursion of forward dynamics with impulses in place of
// forces.

// After forward_kinematics of a new configuration the workspace has articulated inertias of an
// older one.
void ImpulseGroup::ready_inertias(std::size_t robot) {
  if (inertias_ready_[robot]) return;
  dts::articulated_inertias(robots_[robot].model(), robots_[robot].workspace());
  inertias_ready_[robot] = 1;
}

dts::BodyPoint<double> ImpulseGroup::body_point(const PlaceSide& side) const {
  return {side.body, robots_[side.robot].workspace().bodies[side.body].p_WB + side.arm};
}

Vector3d ImpulseGroup::velocity(std::size_t point) const {
  const ImpulsePlace& place = places_->places()[point];
  Vector3d u = place.surface_velocity;
  for (const PlaceSide& side : place.bodies()) u += side.sign * velocity_of(side);
  return u;
}

Vector3d ImpulseGroup::velocity_of(const PlaceSide& side) const {
  const dts::BodyMotion<double>& body = robots_[side.robot].workspace().bodies[side.body];
  return body.v_WB + cross(body.w_WB, side.arm);
}

Vector3d ImpulseGroup::flight_acceleration(std::size_t point) const {
  Vector3d sum;
  for (const PlaceSide& side : places_->places()[point].bodies()) {
    const dts::Motion<double>& a = flights_[side.robot].body_accelerations()[side.body];
    const Vector3d& w = robots_[side.robot].workspace().bodies[side.body].w_WB;
    // Of a ball's place of contact only the material turns; the place stays under the centre.
    sum += side.sign * (a.linear + cross(a.angular, side.arm) + cross(w, cross(w, side.center)));
  }
  return sum;
}

// sum over the sides s of i and t of j, on one robot: +- J_s M^-1 J_t^T.
Matrix3d ImpulseGroup::coupling(std::size_t i, std::size_t j) {
  Matrix3d sum;
  for (const PlaceSide& of_i : places_->places()[i].bodies()) {
    for (const PlaceSide& of_j : places_->places()[j].bodies()) {
      if (of_i.robot != of_j.robot) continue;
      ready_inertias(of_i.robot);
      ArticulatedRobot& robot = robots_[of_i.robot];
      const Matrix3d response = dts::impulse_response(robot.model(), robot.workspace(),
                                                      body_point(of_j), body_point(of_i));
      sum = sum + of_i.sign * of_j.sign * response;
    }
  }
  return sum;
}

bool ImpulseGroup::same_bodies(std::size_t i, std::size_t j) const {
  const ImpulsePlace& a = places_->places()[i];
  const ImpulsePlace& b = places_->places()[j];
  const auto same = [](const PlaceSide& s, const PlaceSide& t) {
    return s.robot == t.robot && s.body == t.body && s.sign == t.sign;
  };
  return a.surface == b.surface && std::ranges::equal(a.bodies(), b.bodies(), same);
}

Vector3d ImpulseGroup::place(std::size_t point) const {
  return body_point(places_->places()[point].sides[0]).p_WP;
}

Symmetric3d ImpulseGroup::collision_matrix(std::size_t point) {
  Symmetric3d K = symmetric_part(coupling(point, point));
  const double yielding = yielding_share * (K.xx + K.yy + K.zz);
  K.xx += yielding;
  K.yy += yielding;
  K.zz += yielding;
  return K;
}

void ImpulseGroup::strike(std::size_t point, const Vector3d& impulse) {
  const ImpulsePlace& place = places_->places()[point];
  for (const PlaceSide& side : place.bodies()) {
    ready_inertias(side.robot);
    ArticulatedRobot& robot = robots_[side.robot];
    const Vector3d on_body = side.sign * impulse;
    const std::span<double> change = std::span(change_).first(robot.velocity_count());
    dts::velocity_change<double>(robot.model(), robot.workspace(), body_point(side), on_body,
                                 change);
    const Vector3d before = velocity_of(side);
    flights_[side.robot].jump(change);
    if (!meters_.empty())
      meters_[side.robot].strike(0.5 * dot(on_body, before + velocity_of(side)));
    impulses_[body_number(side)] += on_body;
  }
  if (place.surface >= 0 && !surface_works_.empty())
    surface_works_[static_cast<std::size_t>(place.surface)] -= dot(impulse, place.surface_velocity);
}

double ImpulseGroup::begin_reversal(std::size_t struck) {
  begin_flight();
  std::ranges::fill(inertias_ready_, char{1});
  return -dot(flight_acceleration(struck), places_->places()[struck].ground.normal);
}

bool ImpulseGroup::find_reversal(std::span<contact::ReversalPoint> points,
                                 std::span<const std::size_t> index, double tolerance) {
  const std::size_t count = points.size();
  if (count > work_.size()) return false;
  for (std::size_t i = 0; i < count; ++i) {
    velocities_[i] = velocity(index[i]);
    for (std::size_t j = i; j < count; ++j) {
      const Matrix3d K = coupling(index[i], index[j]);
      couplings_[i * count + j] = K;
      couplings_[j * count + i] = transpose(K);
    }
  }
  return contact::reverse_together(points, std::span(couplings_).first(count * count),
                                   std::span(velocities_).first(count),
                                   std::span(work_).first(count), tolerance);
}

}  // namespace hookpoint::simulation
