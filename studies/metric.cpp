// The table of metrics and what they share.
#include "studies/metric.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "simulation/ground.h"
#include "simulation/kinematics.h"
#include "simulation/rotors.h"
#include "studies/measured_body.h"

namespace hookpoint::studies {
namespace {

constexpr auto metrics = std::to_array<MetricDefinition>({
    {"creep_speed", "m/s",
     "least-squares slope of the downhill displacement over [settle, duration]", make_creep_speed,
     false, Regime::holds},
    {"creep_sideways", "m/s",
     "the same of the displacement across the fall, along normal x downhill", make_creep_sideways,
     false, Regime::holds},
    {"slip_acceleration", "m/s^2", "least-squares parabola of the same: its second derivative",
     make_slip_acceleration, false, Regime::slides},
    {"friction", "",
     "force of the ground against the motion downhill over that along its normal, from the "
     "motion: (g_t - slip_acceleration)/g_n; nothing under external forces",
     make_friction, false, Regime::slides},
    {"anisotropy", "",
     "greatest over least friction of the runs that differ in the swept direction alone, less 1",
     make_friction, false, Regime::slides, MetricScope::sweep},
    {"settle_shift", "m", "downhill displacement at `settle`", make_settle_shift},
    {"stick_displacement", "m", "mean downhill displacement of the points that touch at the end",
     make_stick_displacement, true, Regime::holds},
    {"slip_distance", "m", "longest tangential path of a boundary point while it is loaded",
     make_slip_distance, true, Regime::none, MetricScope::run, false, true},
    {"stopping_distance", "m", "displacement at the end, if the body rests then",
     make_stopping_distance},
    {"slip_onset", "rad",
     "angle of the driving force, weight and external forces, from the ground's normal when, after "
     "`settle`, the speed along the ground first exceeds 1 mm/s for 10 ms on end; nothing if it "
     "never "
     "does",
     make_slip_onset},
    {"threshold_error", "rad", "slip_onset less atan(mu_s)", make_threshold_error},
    {"direction_error", "rad", "angle between the displacement after `settle` and downhill",
     make_direction_error, false, Regime::slides},
    {"penetration_max", "m", "greatest depth of a boundary point after `settle`",
     make_penetration_max, true},
    {"penetration_mean", "m", "mean depth of the points inside the ground after `settle`",
     make_penetration_mean, true},
    {"penetration_rms", "m", "root mean square of the same depths", make_penetration_rms, true},
    {"contact_breaks", "1/s", "contacts lost per second after `settle`", make_contact_breaks},
    {"impacts", "1/s", "impulses per second after `settle` (event-driven laws)", make_impacts},
    {"support_force", "N",
     "mean force of the ground along its normal after `settle`, on all bodies", make_support_force,
     false, Regime::none, MetricScope::run, false, true},
    {"force_residual", "N",
     "mean after `settle` of what the ground's single forces owe Signorini, Coulomb and maximum "
     "dissipation: the sum of its parts _normal, _cone and _dissipation; nothing for an engine "
     "that does not tell them",
     make_force_residual, false, Regime::none, MetricScope::run, true},
    {"force_residual_normal", "N",
     "of it, normal forces that pull, that act across a gap, or while the contact opens or closes",
     make_force_residual_normal, false, Regime::none, MetricScope::run, true},
    {"force_residual_cone", "N", "of it, tangential force beyond mu times the normal force",
     make_force_residual_cone, false, Regime::none, MetricScope::run, true},
    {"force_residual_dissipation", "N",
     "of it, what friction lacks of mu times the normal force against the slip",
     make_force_residual_dissipation, false, Regime::none, MetricScope::run, true},
    {"energy_residual", "",
     "greatest difference, since the start, between the change of kinetic and gravitational energy "
     "and the work of ground, joints and external forces, per energy exchanged",
     make_energy_residual, false, Regime::none, MetricScope::run, true},
    {"joint_gap", "m", "greatest distance after `settle` of a link from where its joint lets it be",
     make_joint_gap},
    {"rebound", "",
     "greatest speed away from the ground over the greatest towards it, of the body's origin",
     make_rebound},
    {"energy_drift", "J",
     "greatest change of kinetic and gravitational energy since the start, either way",
     make_energy_drift},
    {"momentum_drift", "kg.m/s",
     "greatest distance of the momentum from that of a free flight, p0 + m g t",
     make_momentum_drift},
    {"angular_momentum_drift", "kg.m^2/s",
     "greatest change of the angular momentum about the centre of mass",
     make_angular_momentum_drift},
    {"energy_gain", "J", "greatest rise of kinetic and gravitational energy above the start's",
     make_energy_gain},
    {"unrest", "m/s",
     "greatest sqrt(2 T/m) after `settle`, T the kinetic energy of the robot, m its mass",
     make_unrest},
    {"restless", "",
     "1 if unrest is above 1 mm/s or the engine broke the run off: what should rest does not; else "
     "0",
     make_restless},
    {"stable_step", "s",
     "largest stable step of the run's integrator at its start (docs/contact.md); nothing for a "
     "peer, an impulse law or an adaptive integrator",
     make_stable_step},
    {"spin_max", "rad/s", "greatest angular speed of the body after `settle`", make_spin_max},
    {"fell", "",
     "1 if the base came lower over the ground than half its height at the start, or its z turned "
     "by more than 60 deg; else 0",
     make_fell},
    {"walked_distance", "m",
     "displacement of the base from `settle` to the end or the fall, along its x at the start",
     make_walked_distance},
    {"walking_speed", "m/s", "walked_distance over its time; nothing for a robot that fell",
     make_walking_speed},
    {"foot_slip", "",
     "path of a foot over the ground while in it, mean of the feet, per walked_distance",
     make_foot_slip, false, Regime::none, MetricScope::run, false, false, true},
    {"hook_losses", "",
     "contacts of a foot lost while its leg is to stand, per stance; nothing without a gait that "
     "tells `stance`",
     make_hook_losses, false, Regime::none, MetricScope::run, false, false, true, true},
    {"stance_slip", "m",
     "distance along the ground from where a foot first touches in a stance to where it last does, "
     "mean of the stances",
     make_stance_slip, false, Regime::none, MetricScope::run, false, false, true, true},
    {"stance_depth", "m",
     "mean depth of a foot in the ground while its leg is to stand and it touches",
     make_stance_depth, false, Regime::none, MetricScope::run, false, false, true, true},
    {"stance_lift", "m",
     "greatest height over the ground that a foot reaches between two touches of a stance, mean of "
     "the stances",
     make_stance_lift, false, Regime::none, MetricScope::run, false, false, true, true},
    {"cost_of_transport", "",
     "work of the joints' torques, taken positive whichever way it goes, per weight and "
     "walked_distance",
     make_cost_of_transport},
    {"body_height_min", "m", "least height of the base over the ground after `settle`",
     make_body_height_min},
    {"tilt_max", "rad",
     "greatest angle after `settle` of the base's z from where it was at the start", make_tilt_max},
    {"integrator_steps", "", "steps of the integrator, of an adaptive one its internal steps",
     make_integrator_steps},
    {"rejected_steps", "", "steps that an adaptive integrator took back", make_rejected_steps},
    {"evaluations", "", "evaluations of accelerations, those for Jacobians included",
     make_evaluations},
    {"jacobians", "", "Jacobian matrices by difference quotients", make_jacobians},
    {"events", "",
     "touch-downs, lift-offs, ends of slip, joint limits at which an adaptive "
     "integrator began anew",
     make_events},
    {"notices", "",
     "warnings that the engine gave, each once: 1 for ODE where its solver reported failures",
     make_notices},
    {"self_error", "m",
     "greatest distance of the body's origin from the same run nearer to its limit: an eighth of "
     "deltat, a hundredth of the tolerances",
     make_self_error},
    {"truth_error", "m",
     "greatest distance of the downhill displacement from that of a rigid block under Coulomb "
     "friction",
     make_truth_error},
    {"reference_error", "m",
     "greatest distance of the body's origin from the run of arkode with tolerances of 1e-10 and "
     "steps of 0.1 ms or less, for a peer only where there is no ground",
     make_reference_error},
    {"peer_distance", "m",
     "greatest distance of the body's origin from that of another subject at equal swept values, "
     "median of the others; the matrix of all is in peer_distance.csv and in the report",
     nullptr, false, Regime::none, MetricScope::subjects},
    {"realtime_factor", "",
     "simulated time over processor time, median of five stretches, run alone", nullptr, false,
     Regime::none, MetricScope::timing},
    {"step_time", "s", "processor time of a step, median of five stretches, run alone", nullptr,
     false, Regime::none, MetricScope::timing},
});

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

RunContext make_context(const simulation::Experiment& experiment, double settle, double duration,
                        std::string_view body) {
  RunContext context;
  context.experiment = &experiment;
  context.ground = simulation::make_ground(experiment);
  context.settle = settle;
  context.duration = duration;
  const MeasuredBody measured = measured_body(experiment, body);
  context.robot = measured.robot;
  context.body = measured.base;
  context.watched = measured.body;
  const simulation::RobotSpec& robot = context.robot_spec();
  const simulation::Pose X_WB = simulation::Pose{robot.location, robot.orientation} *
                                simulation::body_poses(robot)[measured.body - measured.base];
  context.weight = simulation::robot_mass(robot) * norm(experiment.gravity);
  context.start = X_WB.position;
  context.start_orientation = X_WB.orientation;
  context.normal =
      context.ground ? context.ground->query(context.start).normal : Vector3d{0., 0., 1.};
  context.downhill = driven_direction(context.normal, experiment.gravity, robot.velocity);
  return context;
}

double height_over_ground(const RunContext& context, const Vector3d& point) {
  return context.ground ? -context.ground->query(point).depth
                        : std::numeric_limits<double>::infinity();
}

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
  if (!with_points) return;
  std::size_t count = 0;
  simulation::for_each_body(context.robot_spec(), [&](const simulation::BodySpec& body) {
    count += body.boundary_points.size();
  });
  points_.reserve(count);
  balls_.reserve(count);
}

Observation Observer::observe(const simulation::WorldState& world,
                              const simulation::WorldInputs* inputs) {
  const simulation::BodyState& body = world.bodies[context_.watched];
  if (points_.capacity() > 0) observe_points(world);
  if (!followed_.empty()) observe_feet(world);
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

std::optional<double> static_friction(const RunContext& context) {
  if (!context.ground) return std::nullopt;
  const auto material = static_cast<std::size_t>(context.ground->query(context.start).material);
  return context.experiment->materials[material].constants.static_friction;
}

double kinetic_energy(const RunContext& context, const simulation::WorldState& world) {
  double energy = 0.;
  for_each_body(context, world,
                [&](const simulation::BodySpec& spec, const simulation::BodyState& body) {
                  const simulation::MassSpec& mass = spec.mass;
                  const Vector3d p_BC = rotate(body.orientation, mass.center_of_mass);
                  const Vector3d v_WC = body.velocity + cross(body.angular_velocity, p_BC);
                  const Vector3d w_B = rotate(conjugate(body.orientation), body.angular_velocity);
                  energy += 0.5 * mass.mass * dot(v_WC, v_WC) + 0.5 * dot(w_B, mass.inertia * w_B);
                });
  // Each robot ahead has one body more than joints.
  const std::size_t first_joint = context.body - static_cast<std::size_t>(context.robot);
  return energy + simulation::rotor_energy(context.robot_spec(),
                                           std::span(world.joints).subspan(first_joint));
}

double mechanical_energy(const RunContext& context, const simulation::WorldState& world) {
  double energy = kinetic_energy(context, world);
  for_each_body(context, world,
                [&](const simulation::BodySpec& spec, const simulation::BodyState& body) {
                  const Vector3d p_BC = rotate(body.orientation, spec.mass.center_of_mass);
                  energy -= spec.mass.mass * dot(context.experiment->gravity, body.position + p_BC);
                });
  return energy;
}

}  // namespace hookpoint::studies
