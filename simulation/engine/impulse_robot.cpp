#include "simulation/engine/impulse_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/impulse/gap_cubic.h"
#include "contact/impulse/landing_time.h"
#include "dts/impulse_response.h"
#include "simulation/engine/publish.h"

namespace hookpoint::simulation {
namespace {

using contact::AdvanceStatus;

constexpr double deepest_start = 1e-9;  // what rounding of a pose between steps may cost [m]
// Share of the robot's speeds that is no approach: what rounding leaves of a point that was
// stopped, or that nothing can move along its normal.
constexpr double speed_rounding = 1e-11;
constexpr int interpolations = 6;  // trials by interpolation before halving
constexpr int most_trials = 60;
constexpr int most_flights_per_impact = 10;
constexpr std::size_t stages_of_flight = 4;  // of Runge-Kutta
// Share of tr K added to K: a point of a robot with a fixed base may have directions in which
// nothing can move it, and the collision is to find that they play no part.
constexpr double yielding_share = 1e-13;

// The time in which something that moves at `speed` and gains `acceleration` covers `way`.
double time_to_cover(double way, double speed, double acceleration) {
  return 2. * way / std::max(speed + std::sqrt(speed * speed + 2. * acceleration * way), 1e-300);
}

}  // namespace

ImpulseRobot::ImpulseRobot(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
                           const contact::Terrain* ground, const WorldInputs& inputs,
                           const contact::ImpulseOptions& options)
    : ImpulsePart(experiment, index, ground),
      options_(options),
      robot_(experiment, index, inputs),
      flight_(robot_),
      points_(ground ? points_of(experiment.robots[index]) : std::vector<Point>{}),
      resolution_(points_.size(), law, options),
      change_(robot_.velocity_count()),
      q_before_(robot_.position_count()),
      v_before_(robot_.velocity_count()),
      impulses_(robot_.model().body_count()),
      impulses_before_(impulses_),
      contacts_(robot_.model().body_count()),
      contacts_before_(contacts_) {
  flight_.refresh();
  robot_.accelerate();  // what is published of the initial state
  if (law != contact::ImpulseLaw::impulse_reversal) return;
  const std::size_t most = std::min(points_.size(), most_reversed_together);
  couplings_.resize(most * most);
  velocities_.resize(most);
  work_.resize(most);
}

std::vector<ImpulseRobot::Point> ImpulseRobot::points_of(const RobotSpec& robot) {
  std::vector<Point> points;
  for (const BoundaryPoint& boundary : boundary_points(robot))
    static_cast<BoundaryPoint&>(points.emplace_back()) = boundary;
  return points;
}

void ImpulseRobot::locate(const contact::GroundQuery& ground) {
  inertias_ready_ = false;
  const auto& bodies = robot_.workspace().bodies;
  for (Point& point : points_) {
    const dts::BodyMotion<double>& body = bodies[point.body];
    point.center = body.R_WB * point.p_BP;
    point.ground = ground(body.p_WB + point.center);
    point.ground.gap -= point.radius;
    point.arm = point.center - point.radius * point.ground.normal;
  }
}

double ImpulseRobot::lowest_gap() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) lowest = std::min(lowest, point.ground.gap);
  return lowest;
}

double ImpulseRobot::greatest_speed() const {
  double fastest = 0.;
  for (const Point& point : points_) {
    const dts::BodyMotion<double>& body = robot_.workspace().bodies[point.body];
    fastest = std::max(fastest, norm(body.v_WB) + norm(body.w_WB) * norm(point.arm));
  }
  return fastest;
}

// No body turns by more than `largest_turn` or goes farther than `largest_travel`, as far as the
// accelerations at the start tell.
double ImpulseRobot::longest_flight(double left) const {
  const auto& bodies = robot_.workspace().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dts::Motion<double>& a = flight_.body_accelerations()[i];
    left =
        std::min({left, time_to_cover(options_.largest_turn, norm(bodies[i].w_WB), norm(a.angular)),
                  time_to_cover(options_.largest_travel, norm(bodies[i].v_WB), norm(a.linear))});
  }
  return left;
}

// When the first point lands, at most `longest`, by the quadratic of its gap; remembers where the
// points start.
double ImpulseRobot::safe_time(double longest) {
  double safe = longest;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    const Vector3d& n = point.ground.normal;
    point.start_gap = point.ground.gap;
    point.start_rate = dot(n, velocity(i));
    const double acceleration = dot(n, flight_acceleration(i));
    safe = std::min(safe, contact::landing_time(point.start_gap, point.start_rate, acceleration,
                                                0.5 * options_.tolerance));
  }
  return safe;
}

// The first landing of a point that has come below `floor` in the flight of `duration`; `duration`
// if none has.
double ImpulseRobot::landing(double duration, double floor) const {
  double first = duration;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    const double rate = dot(point.ground.normal, velocity(i));
    const bool dips = point.start_rate < 0. && rate > 0.;
    if (point.ground.gap >= floor && !dips) continue;
    const contact::GapCubic gap({point.start_gap, point.start_rate}, {point.ground.gap, rate},
                                duration);
    first = std::min(first, gap.landing(floor));
  }
  return first;
}

// One flight of at most `longest`, ended at the first impact. What the quadratic promises is tried,
// and believed only if no point is below the ground at its end and none has been on its way;
// otherwise the landing between is interpolated, and if that does not converge (another tile came
// under a point) the flight is halved.
AdvanceStatus ImpulseRobot::fly_above(const contact::GroundQuery& ground, double longest,
                                      double* duration, contact::ImpulseTally& tally) {
  const double floor = std::min(0., lowest_gap()) - options_.tolerance;
  *duration = safe_time(longest);
  const double work = static_cast<double>(stages_of_flight * body_count() + points_.size());
  for (int trial = 0; trial < most_trials; ++trial) {
    tally.work += work;
    if (flight_.fly(*duration) != integrators::Status::ok) return AdvanceStatus::not_finite;
    locate(ground);
    const double first = landing(*duration, floor);
    if (first >= *duration) {
      // A landing that the interpolation cannot place is one all the same.
      if (lowest_gap() >= floor) return AdvanceStatus::ok;
      *duration *= 0.5;
    } else {
      *duration = trial < interpolations && first > 0. ? first : 0.5 * *duration;
    }
  }
  flight_.go_back();
  locate(ground);
  *duration = 0.;
  return lowest_gap() < -deepest_start ? AdvanceStatus::inside_ground : AdvanceStatus::ok;
}

AdvanceStatus ImpulseRobot::run(const contact::GroundQuery& ground, contact::ImpulseTally& tally) {
  locate(ground);
  if (lowest_gap() < -deepest_start) return AdvanceStatus::inside_ground;
  double left = experiment_.deltat;
  const std::int64_t most_flights =
      most_flights_per_impact * static_cast<std::int64_t>(options_.most_impacts);
  for (std::int64_t flights = 0; left > 0.; ++flights) {
    if (flights > most_flights || is_over(tally, options_)) return AdvanceStatus::too_many_impacts;
    rounding_ = speed_rounding * greatest_speed();
    const AdvanceStatus collided = resolution_.resolve(*this, tally);
    if (collided != AdvanceStatus::ok) return collided;
    if (flight_.begin() != integrators::Status::ok) return AdvanceStatus::not_finite;
    double duration = 0.;
    const AdvanceStatus flown = fly_above(ground, longest_flight(left), &duration, tally);
    if (flown != AdvanceStatus::ok) return flown;
    left -= duration;
  }
  tally.deepest = std::max(tally.deepest, -lowest_gap());
  return AdvanceStatus::ok;
}

contact::ImpulseTally ImpulseRobot::advance(const contact::GroundQuery& ground) {
  contact::ImpulseTally tally;
  flight_.read();
  std::copy(flight_.positions().begin(), flight_.positions().end(), q_before_.begin());
  std::copy(flight_.velocities().begin(), flight_.velocities().end(), v_before_.begin());
  robot_.joints().keep();
  flight_.refresh();  // under the present inputs
  impulses_before_.swap(impulses_);
  contacts_before_.swap(contacts_);
  std::fill(impulses_.begin(), impulses_.end(), Vector3d{});
  std::fill(contacts_.begin(), contacts_.end(), 0);
  resolution_.begin_step();
  tally.status = run(ground, tally);
  if (tally.status != AdvanceStatus::ok) {
    go_back();
    return tally;
  }
  tally.contacts = resolution_.contacts();
  for (std::size_t i = 0; i < points_.size(); ++i) contacts_[points_[i].body] += resolution_.hit(i);
  return tally;
}

void ImpulseRobot::go_back() {
  robot_.joints().undo();
  flight_.go_to(q_before_, v_before_);
  impulses_ = impulses_before_;
  contacts_ = contacts_before_;
}

void ImpulseRobot::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  publish_motion(robot_, bodies);
  publish_joints(robot_, joints);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].contact_force = (1. / experiment_.deltat) * impulses_[i];
    bodies[i].contacts = contacts_[i];
  }
}

// What evolves: the parts of `exchange`, then the signs of the links' quaternions.

std::size_t ImpulseRobot::state_size() const { return count_of(*this) + joint_count(); }

std::string ImpulseRobot::state_layout() const {
  return fmt::format("{} quaternion_sign[{}]", layout_of(*this), joint_count());
}

void ImpulseRobot::save(std::span<double> numbers, std::span<const BodyState> bodies) const {
  save_to(numbers, *this);
  save_signs(robot_, bodies, numbers.last(joint_count()));
}

void ImpulseRobot::restore(std::span<const double> numbers, std::span<BodyState> bodies) {
  restore_from(numbers, *this);
  flight_.refresh();
  restore_signs(robot_, numbers.last(joint_count()), bodies);
}

// What the collisions ask, answered by the recursion of forward dynamics with impulses in place of
// forces.

// After forward_kinematics of a new configuration the workspace has articulated inertias of an
// older one.
void ImpulseRobot::ready_inertias() {
  if (inertias_ready_) return;
  dts::articulated_inertias(robot_.model(), robot_.workspace());
  inertias_ready_ = true;
}

dts::BodyPoint<double> ImpulseRobot::body_point(std::size_t point) const {
  const Point& at = points_[point];
  return {at.body, robot_.workspace().bodies[at.body].p_WB + at.arm};
}

Vector3d ImpulseRobot::velocity(std::size_t point) const {
  const dts::BodyMotion<double>& body = robot_.workspace().bodies[points_[point].body];
  return body.v_WB + cross(body.w_WB, points_[point].arm);
}

Vector3d ImpulseRobot::flight_acceleration(std::size_t point) const {
  const Point& at = points_[point];
  const dts::Motion<double>& a = flight_.body_accelerations()[at.body];
  const Vector3d& w = robot_.workspace().bodies[at.body].w_WB;
  // Of a ball's place of contact only the material turns; the place stays under the centre.
  return a.linear + cross(a.angular, at.arm) + cross(w, cross(w, at.center));
}

Symmetric3d ImpulseRobot::collision_matrix(std::size_t point) {
  ready_inertias();
  Symmetric3d K =
      symmetric_part(dts::collision_matrix(robot_.model(), robot_.workspace(), body_point(point)));
  const double yielding = yielding_share * (K.xx + K.yy + K.zz);
  K.xx += yielding;
  K.yy += yielding;
  K.zz += yielding;
  return K;
}

void ImpulseRobot::strike(std::size_t point, const Vector3d& impulse) {
  ready_inertias();
  dts::velocity_change<double>(robot_.model(), robot_.workspace(), body_point(point), impulse,
                               change_);
  flight_.jump(change_);
  impulses_[points_[point].body] += impulse;
}

double ImpulseRobot::begin_reversal(std::size_t struck) {
  flight_.begin();
  inertias_ready_ = true;
  return -dot(flight_acceleration(struck), points_[struck].ground.normal);
}

bool ImpulseRobot::find_reversal(std::span<contact::ReversalPoint> points,
                                 std::span<const std::size_t> index, double tolerance) {
  const std::size_t count = points.size();
  if (count > work_.size()) return false;
  ready_inertias();
  for (std::size_t i = 0; i < count; ++i) {
    velocities_[i] = velocity(index[i]);
    for (std::size_t j = i; j < count; ++j) {
      const Matrix3d K = dts::impulse_response(robot_.model(), robot_.workspace(),
                                               body_point(index[j]), body_point(index[i]));
      couplings_[i * count + j] = K;
      couplings_[j * count + i] = transpose(K);
    }
  }
  return contact::reverse_together(points, std::span(couplings_).first(count * count),
                                   std::span(velocities_).first(count),
                                   std::span(work_).first(count), tolerance);
}

}  // namespace hookpoint::simulation
