#include "contact/impulse/impulse_advance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/impulse/landing_time.h"

namespace hookpoint::contact {
namespace {

constexpr double deepest_start = 1e-9;  // what rounding of a pose between steps may cost [m]
constexpr int most_halvings = 60;
constexpr double never = std::numeric_limits<double>::infinity();

bool finite(const Vector3d& a) { return std::isfinite(a.x + a.y + a.z); }
bool finite(const FlightState& s) {
  return finite(s.center_of_mass) && finite(s.velocity) && finite(s.angular_momentum) &&
         std::isfinite(s.orientation.w + s.orientation.x + s.orientation.y + s.orientation.z);
}

}  // namespace

ImpulseAdvance::ImpulseAdvance(const ImpulseBody& body, ImpulseLaw law,
                               const ImpulseOptions& options)
    : inertia_(body.mass, body.inertia),
      options_(options),
      center_of_mass_(body.center_of_mass),
      points_(body.boundary_points.size()),
      resolution_(body.boundary_points.size(), law, options) {
  arms_.reserve(body.boundary_points.size());
  for (const Vector3d& point : body.boundary_points) arms_.push_back(point - body.center_of_mass);
  radii_ = body.boundary_radii;
  radii_.resize(arms_.size(), 0.);
  materials_ = body.boundary_materials;
  materials_.resize(arms_.size(), -1);
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
    Touch& point = points_[i];
    point.center = R * arms_[i];
    point.ground = ground(flight.center_of_mass + point.center, materials_[i]);
    point.ground.gap -= radii_[i];
    point.arm = point.center - radii_[i] * point.ground.normal;
  }
}

double ImpulseAdvance::lowest_gap() const {
  double lowest = never;
  for (const Touch& point : points_) lowest = std::min(lowest, point.ground.gap);
  return lowest;
}

// A time, at most `longest`, before which no point can reach its tile's plane: the gap's quadratic
// less the most that its third derivative can take away, gap + rate t + (acceleration - jerk t/3)
// t^2/2.
double ImpulseAdvance::safe_time(const FlightState& flight, const FlightLoad& load,
                                 double longest) const {
  const double unit_jerk = motion_bound(inertia_, flight, load, longest).jerk;
  const Vector3d w = contact::angular_velocity(inertia_, flight);
  const Quaterniond& q = flight.orientation;
  const Vector3d turning = load.torque - cross(w, flight.angular_momentum);
  const Vector3d alpha = rotate(q, inertia_.inverse_times(rotate(conjugate(q), turning)));
  const double sink = 0.5 * options_.tolerance;
  double safe = longest;
  for (const Touch& point : points_) {
    const Vector3d& n = point.ground.normal;
    const Vector3d spin = cross(w, point.center);
    const double rate = dot(n, flight.velocity + spin);
    const double acceleration =
        dot(n, load.acceleration + cross(alpha, point.center) + cross(w, spin));
    const double jerk = unit_jerk * norm(point.center);
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
  for (int halving = 0; halving < most_halvings; ++halving) {
    const FlightState next = fly(inertia_, flight, load, *duration);
    locate(next, ground);
    if (lowest_gap() >= floor) return next;
    *duration *= 0.5;
  }
  *duration = 0.;
  return flight;
}

// The body as its collisions see it: rigid, its centre of mass in flight.
class ImpulseAdvance::Struck final : public StruckRobot {
 public:
  Struck(const ImpulseAdvance& body, FlightState& flight, const FlightLoad& load,
         AdvanceResult& result)
      : body_(body),
        flight_(flight),
        load_(load),
        result_(result),
        w_(contact::angular_velocity(body.inertia_, flight)) {}

  std::size_t point_count() const override { return body_.points_.size(); }
  const GroundPoint& ground(std::size_t point) const override {
    return body_.points_[point].ground;
  }
  Vector3d velocity(std::size_t point) const override {
    return flight_.velocity + cross(w_, body_.points_[point].arm);
  }

  Symmetric3d collision_matrix(std::size_t point) override {
    return symmetric_part(coupling(point, point));
  }
  // K_ij = 1/m - [r_i] I^-1 [r_j], as a sum over the principal axes a of (a x r_i)(a x r_j)^T/I_a: for
  // a point on an axis with a tiny moment the difference of great numbers would leave but rounding.
  Matrix3d coupling(std::size_t i, std::size_t j) override {
    const FlightInertia& body = body_.inertia_;
    const Matrix3d R_WP = rotation_matrix(flight_.orientation) * body.R_BP;
    const Vector3d a = transpose_times(R_WP, body_.points_[i].arm);
    const Vector3d b = transpose_times(R_WP, body_.points_[j].arm);
    const double per_x = 1. / body.moments.x, per_y = 1. / body.moments.y,
                 per_z = 1. / body.moments.z, translation = 1. / body.mass;
    const Matrix3d K{translation + per_y * a.z * b.z + per_z * a.y * b.y,
                     -per_z * a.y * b.x,
                     -per_y * a.z * b.x,
                     -per_z * a.x * b.y,
                     translation + per_x * a.z * b.z + per_z * a.x * b.x,
                     -per_x * a.z * b.y,
                     -per_y * a.x * b.z,
                     -per_x * a.y * b.z,
                     translation + per_x * a.y * b.y + per_y * a.x * b.x};
    return R_WP * K * transpose(R_WP);
  }

  bool same_bodies(std::size_t /*i*/, std::size_t /*j*/) const override { return true; }
  Vector3d place(std::size_t point) const override { return body_.points_[point].arm; }

  void strike(std::size_t point, const Vector3d& impulse) override {
    const Vector3d moment = cross(body_.points_[point].arm, impulse);
    const Vector3d before = velocity(point);
    flight_.velocity += (1. / body_.inertia_.mass) * impulse;
    flight_.angular_momentum += moment;
    result_.impulse += impulse;
    result_.angular_impulse += moment;
    w_ = contact::angular_velocity(body_.inertia_, flight_);
    result_.impulse_work += 0.5 * dot(impulse, before + velocity(point));
  }

  double begin_reversal(std::size_t struck) override {
    inverse_inertia_ = rotate(rotation_matrix(flight_.orientation), body_.inertia_.inverse_inertia);
    alpha_ = inverse_inertia_ * (load_.torque - cross(w_, flight_.angular_momentum));
    return -dot(load_.acceleration, ground(struck).normal);
  }
  Vector3d flight_acceleration(std::size_t point) const override {
    return load_.acceleration + cross(alpha_, body_.points_[point].arm);
  }
  bool find_reversal(std::span<ReversalPoint> points, std::span<const std::size_t> index,
                     double tolerance) override {
    for (std::size_t k = 0; k < points.size(); ++k) points[k].arm = body_.points_[index[k]].arm;
    return reverse_together(points, body_.inertia_.mass, inverse_inertia_, {flight_.velocity, w_},
                            tolerance);
  }

 private:
  const ImpulseAdvance& body_;
  FlightState& flight_;
  const FlightLoad& load_;
  AdvanceResult& result_;
  Vector3d w_;
  // At the collision that is to be reversed.
  Symmetric3d inverse_inertia_;
  Vector3d alpha_;
};

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
  resolution_.begin_step();
  locate(flight, ground);
  if (lowest_gap() < -deepest_start) return failed(AdvanceStatus::inside_ground);

  double left = dt;
  const std::int64_t most_flights = 10 * static_cast<std::int64_t>(options_.most_impacts);
  for (std::int64_t flights = 0; left > 0.; ++flights) {
    if (flights > most_flights || is_over(result, options_))
      return failed(AdvanceStatus::too_many_impacts);
    result.work += static_cast<double>(points_.size() + 1);
    Struck struck(*this, flight, flight_load, result);
    const AdvanceStatus collided = resolution_.resolve(struck, result);
    if (collided != AdvanceStatus::ok) return failed(collided);
    const double turn = motion_bound(inertia_, flight, flight_load, left).angular_speed;
    const double travel = norm(flight.velocity) + left * norm(flight_load.acceleration);
    const double longest = std::min({left, options_.largest_turn / std::max(turn, 1e-300),
                                     options_.largest_travel / std::max(travel, 1e-300)});
    double duration = 0.;
    flight = fly_above(flight, flight_load, ground, longest, &duration);
    if (!finite(flight)) return failed(AdvanceStatus::not_finite);
    if (duration <= 0. && lowest_gap() < -deepest_start)
      return failed(AdvanceStatus::inside_ground);
    left -= duration;
  }
  result.deepest = std::max(result.deepest, -lowest_gap());
  result.contacts = resolution_.contacts();
  state = state_from(flight);
  return result;
}

}  // namespace hookpoint::contact
