// The table of metrics and what they share.
#include "studies/metric.h"

#include <array>
#include <cmath>
#include <limits>

#include "simulation/ground.h"

namespace hookpoint::studies {
namespace {

constexpr std::array<MetricDefinition, 15> metrics{{
    {"creep_speed", "m/s",
     "least-squares slope of the downhill displacement over [settle, duration]", make_creep_speed,
     false, Regime::holds},
    {"slip_acceleration", "m/s^2", "least-squares parabola of the same: its second derivative",
     make_slip_acceleration, false, Regime::slides},
    {"settle_shift", "m", "downhill displacement at `settle`", make_settle_shift},
    {"stick_displacement", "m", "mean downhill displacement of the points that touch at the end",
     make_stick_displacement, true, Regime::holds},
    {"slip_distance", "m", "longest tangential path of a boundary point while it is loaded",
     make_slip_distance, true},
    {"stopping_distance", "m", "displacement at the end, if the body rests then",
     make_stopping_distance},
    {"direction_error", "rad", "angle between the displacement after `settle` and downhill",
     make_direction_error, false, Regime::slides},
    {"penetration_max", "m", "greatest depth of a boundary point after `settle`",
     make_penetration_max, true},
    {"penetration_mean", "m", "mean depth of the points inside the ground after `settle`",
     make_penetration_mean, true},
    {"penetration_rms", "m", "root mean square of the same depths", make_penetration_rms, true},
    {"contact_breaks", "1/s", "contacts lost per second after `settle`", make_contact_breaks},
    {"impacts", "1/s", "impulses per second after `settle` (event-driven laws)", make_impacts},
    {"energy_gain", "J", "greatest rise of kinetic and gravitational energy above the start's",
     make_energy_gain},
    {"realtime_factor", "", "simulated time over wall time, median of five stretches, run alone"},
    {"step_time", "s", "wall time of a step, median of five stretches, run alone"},
}};

double deepest(const RunContext&, const Observation& observation) {
  double depth = 0.;
  for (const PointObservation& point : observation.points) depth = std::max(depth, point.depth);
  return depth;
}

constexpr std::array<SignalDefinition, 5> signals{{
    {"displacement", "m", "downhill displacement of the body's origin",
     [](const RunContext&, const Observation& o) { return o.displacement; }},
    {"drift", "m", "downhill displacement of the body's origin since `settle`",
     [](const RunContext&, const Observation& o) { return o.displacement; }, true},
    {"speed", "m/s", "downhill velocity of the body's origin",
     [](const RunContext& c, const Observation& o) { return dot(o.body.velocity, c.downhill); }},
    {"penetration", "m", "depth of the deepest boundary point", deepest},
    {"energy", "J", "kinetic and gravitational energy",
     [](const RunContext& c, const Observation& o) { return mechanical_energy(c, o.world); }},
}};

/// Downhill at the start: gravity's part in the plane; on the level the initial velocity's; else x.
Vector3d driven_direction(const Vector3d& normal, const Vector3d& gravity,
                          const Vector3d& velocity) {
  const Vector3d pull = tangential(gravity, normal);
  if (norm(pull) > 1e-9 * norm(gravity)) return (1. / norm(pull)) * pull;
  const Vector3d along = tangential(velocity, normal);
  if (norm(along) > 0.) return (1. / norm(along)) * along;
  const Vector3d x = tangential(Vector3d{1., 0., 0.}, normal);
  return (1. / norm(x)) * x;
}

}  // namespace

std::span<const MetricDefinition> metric_table() { return metrics; }

const MetricDefinition* find_metric(std::string_view name) {
  for (const MetricDefinition& metric : metrics)
    if (metric.name == name) return &metric;
  return nullptr;
}

std::span<const SignalDefinition> signal_table() { return signals; }

const SignalDefinition* find_signal(std::string_view name) {
  for (const SignalDefinition& signal : signals)
    if (signal.name == name) return &signal;
  return nullptr;
}

RunContext make_context(const simulation::Experiment& experiment, double settle, double duration) {
  RunContext context;
  context.experiment = &experiment;
  context.ground = simulation::make_ground(experiment);
  context.settle = settle;
  context.duration = duration;
  std::size_t body = 0;
  bool found = false;
  for (std::size_t i = 0; i < experiment.robots.size() && !found; ++i) {
    const simulation::RobotSpec& robot = experiment.robots[i];
    context.robot = static_cast<int>(i);
    context.body = body;
    found = robot.mobile;
    ++body;
    for (const simulation::ChainSpec& chain : robot.chains) body += chain.links.size();
  }
  if (!found)
    throw simulation::ExperimentError("a study needs a robot with a mobile base: there is none");
  const simulation::RobotSpec& robot = context.robot_spec();
  double mass = robot.base.mass.mass;
  for (const simulation::ChainSpec& chain : robot.chains)
    for (const simulation::LinkSpec& link : chain.links) mass += link.body.mass.mass;
  context.weight = mass * norm(experiment.gravity);
  context.start = robot.location;
  context.normal =
      context.ground ? context.ground->query(robot.location).normal : Vector3d{0., 0., 1.};
  context.downhill = driven_direction(context.normal, experiment.gravity, robot.velocity);
  return context;
}

Observer::Observer(const RunContext& context, bool with_points) : context_(context) {
  if (with_points) points_.resize(context.robot_spec().base.boundary_points.size());
}

Observation Observer::observe(const simulation::WorldState& world) {
  const simulation::BodyState& body = world.bodies[context_.body];
  const Matrix3d R_WB = rotation_matrix(body.orientation);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector3d p_WP = body.position + R_WB * context_.robot_spec().base.boundary_points[i];
    points_[i] = {p_WP, context_.ground ? context_.ground->query(p_WP).depth
                                        : -std::numeric_limits<double>::infinity()};
  }
  return {world, body, dot(body.position - context_.start, context_.downhill), points_};
}

double mechanical_energy(const RunContext& context, const simulation::WorldState& world) {
  double energy = 0.;
  const auto add = [&](const simulation::MassSpec& mass, const simulation::BodyState& body) {
    const Vector3d p_BC = rotate(body.orientation, mass.center_of_mass);
    const Vector3d v_WC = body.velocity + cross(body.angular_velocity, p_BC);
    const Vector3d w_B = rotate(conjugate(body.orientation), body.angular_velocity);
    energy += 0.5 * mass.mass * dot(v_WC, v_WC) + 0.5 * dot(w_B, mass.inertia * w_B) -
              mass.mass * dot(context.experiment->gravity, body.position + p_BC);
  };
  std::size_t body = context.body;
  add(context.robot_spec().base.mass, world.bodies[body]);
  for (const simulation::ChainSpec& chain : context.robot_spec().chains)
    for (const simulation::LinkSpec& link : chain.links) add(link.body.mass, world.bodies[++body]);
  return energy;
}

}  // namespace hookpoint::studies
