#include "contact/impulse_advance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hookpoint::contact {
namespace {

constexpr double kDeepestStart = 1e-9;  // what rounding of a pose between steps may cost [m]
constexpr int kMostHalvings = 60;
constexpr double kReach =
    4.;  // heights of a microflight, u0^2/(2 g_n), within which points are reversed together
constexpr double kReversed = 1e-6;  // of u0: the velocity that a reversal may miss
constexpr double kNever = std::numeric_limits<double>::infinity();

bool finite(const Vector3d& a) { return std::isfinite(a.x + a.y + a.z); }
bool finite(const FlightState& s) {
  return finite(s.center_of_mass) && finite(s.velocity) && finite(s.angular_momentum) &&
         std::isfinite(s.orientation.w + s.orientation.x + s.orientation.y + s.orientation.z);
}

// The time at which gap + rate t + acceleration t^2/2 comes down to zero: a point that touches and
// leaves is awaited where it comes back, also if rounding left it a little inside. A point at rest
// on the plane falls a hair, `sink`, to be hit there.
double landing_time(double gap, double rate, double acceleration, double sink) {
  double discriminant = rate * rate - 2. * acceleration * gap;
  if (gap <= 0.) {
    if (acceleration >= 0.) return kNever;
    if (rate <= 0.) return std::sqrt(2. * sink / -acceleration);
    if (discriminant < 0.) discriminant = rate * rate;
    return (rate + std::sqrt(discriminant)) / -acceleration;
  }
  if (discriminant < 0.) return kNever;
  const double root = std::sqrt(discriminant);
  if (rate < 0.) return 2. * gap / (root - rate);
  return acceleration < 0. ? (rate + root) / -acceleration : kNever;
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
    case AdvanceStatus::too_many_impacts:
      return "impacts follow one another without end: raise rebound_speed, lower restitution or "
             "shorten deltat";
    case AdvanceStatus::unsolved_collision:
      return "a collision has no solution: check the body's mass and inertia";
  }
  return "";
}

ImpulseAdvance::ImpulseAdvance(const ImpulseBody& body, ImpulseLaw law,
                               const ImpulseOptions& options)
    : inertia_(body.mass, body.inertia),
      law_(law),
      options_(options),
      center_of_mass_(body.center_of_mass),
      points_(body.boundary_points.size()),
      near_(body.boundary_points.size()),
      near_index_(body.boundary_points.size()),
      hit_now_(body.boundary_points.size()),
      hit_(body.boundary_points.size()) {
  arms_.reserve(body.boundary_points.size());
  for (const Vector3d& point : body.boundary_points) arms_.push_back(point - body.center_of_mass);
}

FlightState ImpulseAdvance::flight_from(const ImpulseState& state) const {
  const Quaterniond q = normalized(state.orientation);
  const Vector3d c = rotate(q, center_of_mass_);
  const Vector3d w_B = rotate(conjugate(q), state.angular_velocity);
  return {state.position + c, q, state.velocity + cross(state.angular_velocity, c),
          rotate(q, inertia_.inertia * w_B)};
}

ImpulseState ImpulseAdvance::state_from(const FlightState& flight) const {
  const Vector3d c = rotate(flight.orientation, center_of_mass_);
  const Vector3d w = contact::angular_velocity(inertia_, flight);
  return {flight.center_of_mass - c, flight.orientation, flight.velocity - cross(w, c), w};
}

void ImpulseAdvance::locate(const FlightState& flight, const GroundQuery& ground) {
  const Matrix3d R = rotation_matrix(flight.orientation);
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    points_[i].arm = R * arms_[i];
    points_[i].ground = ground(flight.center_of_mass + points_[i].arm);
  }
}

double ImpulseAdvance::lowest_gap() const {
  double lowest = kNever;
  for (const Touch& point : points_) lowest = std::min(lowest, point.ground.gap);
  return lowest;
}

// A time, at most `longest`, before which no point can reach its tile's plane: the gap's quadratic
// less the most that its third derivative can take away, gap + rate t + (acceleration - jerk t/3)
// t^2/2.
double ImpulseAdvance::safe_time(const FlightState& flight, const FlightLoad& load,
                                 double longest) const {
  const double speed = angular_speed_bound(inertia_, flight, load, longest);
  const double unit_jerk = jerk_bound(inertia_, load, speed);
  const Vector3d w = contact::angular_velocity(inertia_, flight);
  const Quaterniond& q = flight.orientation;
  const Vector3d turning = load.torque - cross(w, flight.angular_momentum);
  const Vector3d alpha = rotate(q, inertia_.inverse_inertia * rotate(conjugate(q), turning));
  const double sink = 0.5 * options_.tolerance;
  double safe = longest;
  for (const Touch& point : points_) {
    const Vector3d& n = point.ground.normal;
    const Vector3d spin = cross(w, point.arm);
    const double rate = dot(n, flight.velocity + spin);
    const double acceleration =
        dot(n, load.acceleration + cross(alpha, point.arm) + cross(w, spin));
    const double jerk = unit_jerk * norm(point.arm);
    const double gap = point.ground.gap;
    // The bound holds up to the time it is made for; made for the time it gave, it gives a later
    // one, up to which it holds only if made for that: two rounds from above leave nothing to gain.
    double made_for = safe;
    double landing = landing_time(gap, rate, acceleration - jerk * made_for / 3., sink);
    for (int round = 0; round < 2 && landing < made_for; ++round) {
      const double later = landing_time(gap, rate, acceleration - jerk * landing / 3., sink);
      made_for = std::min(made_for, later);
      landing = landing_time(gap, rate, acceleration - jerk * made_for / 3., sink);
    }
    safe = std::min(safe, landing);
  }
  return safe;
}

// One flight of at most `longest`, ended at the first impact; `points_` are then those of the new
// state.
FlightState ImpulseAdvance::fly_above(const FlightState& flight, const FlightLoad& load,
                                      const GroundQuery& ground, double longest, double* duration) {
  const double floor = std::min(0., lowest_gap()) - options_.tolerance;
  *duration = safe_time(flight, load, longest);
  // A point that came over another tile may be inside that one: fly only part of the way, and be
  // awaited there.
  for (int halving = 0; halving < kMostHalvings; ++halving) {
    const FlightState next = fly(inertia_, flight, load, *duration);
    locate(next, ground);
    if (lowest_gap() >= floor) return next;
    *duration *= 0.5;
  }
  *duration = 0.;
  return flight;
}

Symmetric3d ImpulseAdvance::collision_matrix(const FlightState& flight, const Vector3d& r) const {
  // K = 1/m - [r] I^-1 [r].
  const Matrix3d R = rotation_matrix(flight.orientation);
  const Matrix3d lever = cross_matrix(r);
  const Matrix3d turning = lever * general(rotate(R, inertia_.inverse_inertia)) * lever;
  const double translation = 1. / inertia_.mass;
  return Symmetric3d{translation, translation, translation, 0., 0., 0.} - symmetric_part(turning);
}

int ImpulseAdvance::fastest_approach(const FlightState& flight, const Vector3d& w) const {
  int fastest = -1;
  double lowest = 0.;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].ground.gap > options_.tolerance) continue;
    const double rate = dot(points_[i].ground.normal, flight.velocity + cross(w, points_[i].arm));
    if (rate < lowest) {
      lowest = rate;
      fastest = static_cast<int>(i);
    }
  }
  return fastest;
}

void ImpulseAdvance::apply(std::size_t point, const Vector3d& impulse, FlightState& flight,
                           AdvanceResult& result) {
  const Vector3d moment = cross(points_[point].arm, impulse);
  flight.velocity += (1. / inertia_.mass) * impulse;
  flight.angular_momentum += moment;
  result.impulse += impulse;
  result.angular_impulse += moment;
  ++result.impacts;
  hit_now_[point] = 1;
}

// A microcollision of the point `hit` and of all others that are about as near: whether they could
// be reversed together.
bool ImpulseAdvance::reverse(FlightState& flight, const FlightLoad& load, const Vector3d& w,
                             int hit, AdvanceResult& result) {
  const GroundPoint& struck = points_[static_cast<std::size_t>(hit)].ground;
  const double u0 = struck.material->rebound_speed;
  const double fall = -dot(load.acceleration, struck.normal);
  if (!(fall > 0.) || !(u0 > 0.)) return false;
  const Symmetric3d inverse_inertia =
      rotate(rotation_matrix(flight.orientation), inertia_.inverse_inertia);
  const Vector3d alpha = inverse_inertia * (load.torque - cross(w, flight.angular_momentum));
  const double reach = kReach * u0 * u0 / (2. * fall);
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& [arm, ground] = points_[i];
    if (ground.gap > reach) continue;
    const Vector3d u = flight.velocity + cross(w, arm);
    if (std::abs(dot(u, ground.normal)) > kMicrocollision * u0) return false;
    const Vector3d gain = (u0 / fall) * (load.acceleration + cross(alpha, arm));
    near_[count] = {
        arm, ground.normal, ground.material->kinetic_friction, gain, collision_matrix(flight, arm),
        {}};
    near_index_[count++] = i;
  }
  Twist twist{flight.velocity, w};
  const std::span<ReversalPoint> group(near_.data(), count);
  if (!reverse_together(group, inertia_.mass, inverse_inertia, kReversed * u0, twist)) return false;
  for (std::size_t k = 0; k < count; ++k) {
    if (dot(group[k].impulse, group[k].normal) > 0.) {
      apply(near_index_[k], group[k].impulse, flight, result);
    }
  }
  return true;
}

AdvanceStatus ImpulseAdvance::collide(FlightState& flight, const FlightLoad& load,
                                      AdvanceResult& result) {
  std::fill(hit_now_.begin(), hit_now_.end(), char{0});
  Vector3d w = contact::angular_velocity(inertia_, flight);
  bool together = law_ == ImpulseLaw::impulse_reversal;
  for (int i = fastest_approach(flight, w); i >= 0; i = fastest_approach(flight, w)) {
    if (!together || !reverse(flight, load, w, i, result)) {
      const std::size_t point = static_cast<std::size_t>(i);
      const auto& [arm, ground] = points_[point];
      const Collision collision =
          impulse(collision_matrix(flight, arm), flight.velocity + cross(w, arm), ground.normal,
                  *ground.material);
      if (!collision.solved) return AdvanceStatus::unsolved_collision;
      apply(point, collision.impulse, flight, result);
    }
    together = false;
    if (result.impacts > options_.most_impacts) return AdvanceStatus::too_many_impacts;
    w = contact::angular_velocity(inertia_, flight);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!hit_now_[i]) continue;
    hit_[i] = 1;
    ++result.lift_offs;
    result.deepest = std::max(result.deepest, -points_[i].ground.gap);
  }
  return AdvanceStatus::ok;
}

AdvanceResult ImpulseAdvance::advance(ImpulseState& state, double dt, const ImpulseLoad& load,
                                      const GroundQuery& ground) {
  AdvanceResult result;
  const FlightLoad flight_load{load.gravity + (1. / inertia_.mass) * load.force, load.torque};
  FlightState flight = flight_from(state);
  const auto failed = [&](AdvanceStatus status) {
    result.status = status;
    return result;
  };
  if (!finite(flight) || !finite(flight_load.acceleration) || !finite(load.torque) || !(dt >= 0.)) {
    return failed(AdvanceStatus::not_finite);
  }
  std::fill(hit_.begin(), hit_.end(), char{0});
  locate(flight, ground);
  if (lowest_gap() < -kDeepestStart) return failed(AdvanceStatus::inside_ground);

  double left = dt;
  const std::int64_t most_flights = 10 * static_cast<std::int64_t>(options_.most_impacts);
  for (std::int64_t flights = 0; left > 0.; ++flights) {
    if (flights > most_flights) return failed(AdvanceStatus::too_many_impacts);
    const AdvanceStatus collided = collide(flight, flight_load, result);
    if (collided != AdvanceStatus::ok) return failed(collided);
    const double turn = angular_speed_bound(inertia_, flight, flight_load, left);
    const double travel = norm(flight.velocity) + left * norm(flight_load.acceleration);
    const double longest = std::min({left, options_.largest_turn / std::max(turn, 1e-300),
                                     options_.largest_travel / std::max(travel, 1e-300)});
    double duration = 0.;
    flight = fly_above(flight, flight_load, ground, longest, &duration);
    if (!finite(flight)) return failed(AdvanceStatus::not_finite);
    if (duration <= 0. && lowest_gap() < -kDeepestStart)
      return failed(AdvanceStatus::inside_ground);
    left -= duration;
  }
  result.deepest = std::max(result.deepest, -lowest_gap());
  result.contacts = static_cast<int>(std::count(hit_.begin(), hit_.end(), char{1}));
  state = state_from(flight);
  return result;
}

}  // namespace hookpoint::contact
