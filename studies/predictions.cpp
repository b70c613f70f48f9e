#include "studies/predictions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/force_law.h"
#include "contact/predictions.h"

namespace hookpoint::studies {
namespace {

using Constants = contact::MaterialConstants<double>;

/// A rigid body lying on a plane, as the closed forms of docs/contact.md name its quantities.
struct BodyOnPlane {
  double mass = 0., gravity = 0.;
  double sine = 0., cosine = 1.;    ///< of the slope theta
  std::vector<Vector3d> footprint;  ///< touching points from the centre of mass, in the plane [m]
  double height = 0.;               ///< of the centre of mass above the touching points [m]
  bool single_point = false;        ///< the body has one boundary point: it cannot rock
  double speed = 0.;                ///< initial, in the plane [m/s]
  Constants material;
  std::optional<contact::ForceLaw> law;  ///< of engine dts
  bool peer = false;

  double contacts() const { return static_cast<double>(footprint.size()); }
  double tangent() const { return sine / cosine; }
  double normal_load() const { return mass * gravity * cosine / contacts(); }
  bool sticks() const { return contact::holds_on_slope(tangent(), material.static_friction); }
  double slip_acceleration() const {
    return contact::slip_acceleration(gravity, std::atan2(sine, cosine), material.kinetic_friction);
  }
  double friction_load() const {
    const double pull = mass * gravity * sine / contacts();
    return sticks() ? pull : std::min(pull, material.kinetic_friction * normal_load());
  }
};

/// The closed forms want: one rigid body that cannot roll, a plane, no other forces.
bool applies(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  return experiment.terrain && experiment.robots.size() == 1 && experiment.forces.empty() &&
         context.robot_spec().chains.empty() && norm(context.robot_spec().angular_velocity) == 0. &&
         !context.robot_spec().base.boundary_points.empty() &&
         context.robot_spec().base.boundary_radii.empty() &&
         !std::holds_alternative<contact::GridSurface>(experiment.terrain->surface);
}

BodyOnPlane body_on_plane(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  const simulation::BodySpec& base = context.robot_spec().base;
  BodyOnPlane body;
  body.mass = base.mass.mass;
  body.gravity = norm(experiment.gravity);
  body.cosine = -dot(experiment.gravity, context.normal) / body.gravity;
  body.sine = norm(tangential(experiment.gravity, context.normal)) / body.gravity;
  body.speed = norm(tangential(context.robot_spec().velocity, context.normal));
  body.single_point = base.boundary_points.size() == 1;
  body.peer = experiment.engine != "dts";
  if (!body.peer) body.law = contact::find_force_law(experiment.contact);
  const int material = context.ground->query(context.start).material;
  body.material = experiment.materials[static_cast<std::size_t>(material)].constants;
  // A peer has one coefficient of friction, the kinetic (reference/experiment_checks.h).
  if (body.peer) body.material.static_friction = body.material.kinetic_friction;

  const Quaterniond& R_WB = context.robot_spec().orientation;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : base.boundary_points)
    lowest = std::min(lowest, dot(rotate(R_WB, point), context.normal));
  for (const Vector3d& point : base.boundary_points) {
    const Vector3d from_center = rotate(R_WB, point - base.mass.center_of_mass);
    if (dot(rotate(R_WB, point), context.normal) - lowest > 1e-6) continue;
    body.footprint.push_back(tangential(from_center, context.normal));
    body.height = -dot(from_center, context.normal);
  }
  return body;
}

/// Whether depth is proportional to load: the equations of `footprint_depths` are linear then.
bool linear_normal_force(const BodyOnPlane& body) {
  const double load = body.normal_load();
  const double once = contact::static_depth(*body.law, load, body.material);
  const double twice = contact::static_depth(*body.law, 2. * load, body.material);
  return std::abs(twice - 2. * once) <= 1e-12 * once;
}

/// Depths of the touching points: a rigid footprint on equal springs k that carries N and the
/// moment of the friction F about the centre of mass, d_i = a + b x_i + c y_i with sum k d_i = N,
/// sum k d_i x_i = F h (x downhill), sum k d_i y_i = 0. Empty when a point would lift, or when the
/// springs are not linear.
std::vector<double> footprint_depths(const RunContext& context, const BodyOnPlane& body) {
  const double depth = contact::static_depth(*body.law, body.normal_load(), body.material);
  if (body.single_point) return {depth};
  if (body.footprint.size() < 3 || !linear_normal_force(body)) return {};
  const double stiffness = body.normal_load() / depth;
  const Vector3d across = cross(context.normal, context.downhill);
  Symmetric3d sums;
  for (const Vector3d& point : body.footprint) {
    const double x = dot(point, context.downhill), y = dot(point, across);
    sums += Symmetric3d{1., x * x, y * y, x, y, x * y};
  }
  const double moment = body.friction_load() * body.contacts() * body.height;
  const Vector3d plane =
      (1. / stiffness) *
      (inverse(sums) * Vector3d{body.normal_load() * body.contacts(), moment, 0.});
  std::vector<double> depths;
  for (const Vector3d& point : body.footprint) {
    depths.push_back(plane.x + plane.y * dot(point, context.downhill) +
                     plane.z * dot(point, across));
    if (!(depths.back() > 0.)) return {};
  }
  return depths;
}

std::optional<double> sticking_creep(const RunContext& context, const BodyOnPlane& body,
                                     std::optional<double> peer_creep) {
  if (body.peer) return peer_creep;
  if (body.law) return contact::creep_speed(*body.law, body.tangent(), body.material);
  if (context.experiment->contact == "impulse_reversal") return 0.;
  // Between impacts 2 u0/(g cos) apart friction is absent: mean speed g sin T/2 (docs/contact.md).
  if (body.single_point) return body.material.rebound_speed * body.tangent();
  return std::nullopt;
}

std::optional<double> creep_speed(const RunContext& context, const BodyOnPlane& body,
                                  std::optional<double> peer_creep) {
  if (body.speed > 0.) return std::nullopt;
  if (body.sticks()) return sticking_creep(context, body, peer_creep);
  // The best line through a t^2/2 on [t1, t2] has the slope a (t1 + t2)/2.
  return body.slip_acceleration() * 0.5 * (context.settle + context.duration);
}

std::optional<double> slip_acceleration(const BodyOnPlane& body) {
  if (body.speed > 0.) return std::nullopt;
  return body.sticks() ? 0. : body.slip_acceleration();
}

/// Of `friction`: Coulomb's of the slip, or what the slope asks for of a body that sticks.
std::optional<double> friction(const BodyOnPlane& body) {
  if (body.speed > 0.) return std::nullopt;
  return body.sticks() ? body.tangent() : body.material.kinetic_friction;
}

std::optional<double> penetration(std::string_view metric, const RunContext& context,
                                  const BodyOnPlane& body) {
  if (body.peer) return std::nullopt;
  if (!body.law) return 0.;
  const std::vector<double> depths = footprint_depths(context, body);
  if (depths.empty()) return std::nullopt;
  if (metric == "penetration_max") return *std::max_element(depths.begin(), depths.end());
  double sum = 0., squares = 0.;
  for (const double depth : depths) {
    sum += depth;
    squares += depth * depth;
  }
  const double count = static_cast<double>(depths.size());
  return metric == "penetration_mean" ? sum / count : std::sqrt(squares / count);
}

/// Shift of a point that carries the tangential `load` [N], where it grows in proportion: a load
/// let go at once, or a slide that ends, leaves no other closed form.
std::optional<double> elastic_shift(const BodyOnPlane& body, double load) {
  const auto shift = [&](double f) {
    return contact::stick_displacement(*body.law, f, body.normal_load(), body.material);
  };
  const std::optional<double> half = shift(0.5 * load), whole = shift(load);
  if (!half || !whole || std::abs(*whole - 2. * *half) > 1e-12 * *whole) return std::nullopt;
  return whole;
}

std::optional<double> stick_displacement(const BodyOnPlane& body) {
  const bool holds_by_spring =
      body.law && contact::creep_speed(*body.law, body.tangent(), body.material) == 0.;
  if (!body.sticks() || body.speed > 0. || !holds_by_spring) return std::nullopt;
  return elastic_shift(body, body.friction_load());
}

std::optional<double> stopping_distance(const BodyOnPlane& body) {
  if (body.speed == 0. || body.sine > 1e-9) return std::nullopt;
  const double coulomb =
      contact::braking_distance(body.speed, body.gravity, body.material.kinetic_friction);
  if (!body.law) return coulomb;
  const std::optional<double> shift =
      elastic_shift(body, body.material.kinetic_friction * body.normal_load());
  if (!shift) return std::nullopt;
  if (*shift == 0.) return coulomb;
  const double offset = contact::braking_elastic_offset(body.normal_load(), body.material);
  return coulomb - (body.material.tangential_damping > 0. ? offset : 0.5 * offset);
}

std::optional<double> impacts(const RunContext& context, const BodyOnPlane& body) {
  if (body.peer || body.law || !body.single_point || context.experiment->contact != "impulse")
    return std::nullopt;
  return body.gravity * body.cosine / (2. * body.material.rebound_speed);
}

}  // namespace

std::optional<double> predict(std::string_view metric, const RunContext& context,
                              std::optional<double> peer_creep) {
  if (metric == "fell") return joint_loop_fails(context);
  if (metric == "restless") return restless(context);
  if (metric == "slip_onset") return slip_onset(context);
  if (metric == "threshold_error") return threshold_error(context);
  if (metric == "rebound") return rebound(context);
  if (metric == "support_force") return support_force(context);
  if (!applies(context))
    return metric == "slip_acceleration" ? rolling_acceleration(context) : std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (metric == "creep_speed") return creep_speed(context, body, peer_creep);
  if (metric == "slip_acceleration") return slip_acceleration(body);
  if (metric == "friction") return friction(body);
  if (metric == "anisotropy" && body.speed == 0.) return 0.;
  if (metric == "stick_displacement") return stick_displacement(body);
  if (metric == "stopping_distance") return stopping_distance(body);
  if (metric == "impacts") return impacts(context, body);
  if (metric == "direction_error" && !body.sticks() && body.speed == 0.) return 0.;
  if (metric.substr(0, 11) == "penetration") return penetration(metric, context, body);
  return std::nullopt;
}

double RigidSlide::displacement(double time) const {
  const bool rests = speed > 0. && acceleration < 0. && time > -speed / acceleration;
  const double moving = rests ? -speed / acceleration : time;
  return (speed + 0.5 * acceleration * moving) * moving;
}

std::optional<RigidSlide> rigid_slide(const RunContext& context) {
  if (!applies(context)) return std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed == 0.) return RigidSlide{0., body.sticks() ? 0. : body.slip_acceleration()};
  if (body.sine > 1e-9) return std::nullopt;
  return RigidSlide{body.speed, -body.material.kinetic_friction * body.gravity};
}

Regime regime_of(const RunContext& context) {
  if (!applies(context)) return Regime::none;
  const BodyOnPlane body = body_on_plane(context);
  if (body.speed > 0.) return Regime::none;
  return body.sticks() ? Regime::holds : Regime::slides;
}

}  // namespace hookpoint::studies
