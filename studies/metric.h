// What is measured: one definition a metric, the same code for every engine, from the published
// poses and velocities only. A metric sees every step once and keeps a fixed amount of memory,
// however long the run.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact/terrain/rolling.h"
#include "contact/terrain/terrain.h"
#include "simulation/engine.h"
#include "simulation/experiment.h"
#include "simulation/robot_tree.h"
#include "studies/regime.h"

namespace hookpoint::studies {

/// What of a run is known before it starts: the body measured (studies/measured_body.h), the ground
/// under its start and the direction in which it is driven.
struct RunContext {
  const simulation::Experiment* experiment = nullptr;
  std::optional<contact::Terrain> ground;
  int robot = 0;            ///< index of the robot measured
  std::size_t body = 0;     ///< index of its base in WorldState::bodies, where its links follow
  std::size_t watched = 0;  ///< index there of the body that Observation::body is: base or link
  double settle = 0.;       ///< [s]
  double duration = 0.;     ///< [s]
  Vector3d start;           ///< p_WB at time 0 of the body that is watched [m]
  Quaterniond start_orientation;  ///< R_WB at time 0 of the same
  Vector3d normal;                ///< of the ground under the start, unit
  Vector3d downhill;   ///< unit, in the ground's plane: steepest descent; on the level, along the
                       ///< base's initial velocity
  double weight = 0.;  ///< m |g| [N], of the whole robot
  /// Of an engine with one coefficient of friction, the kinetic one (EngineEntry::one_friction).
  bool one_friction = false;
  simulation::EngineFactory make =
      nullptr;  ///< of the run's engine, where a metric may run another

  const simulation::RobotSpec& robot_spec() const {
    return experiment->robots[static_cast<std::size_t>(robot)];
  }
};

/// `body`: the trail of the body measured, as studies/measured_body.h takes it. Throws
/// simulation::ExperimentError when there is none or it cannot move.
RunContext make_context(const simulation::Experiment& experiment, double settle, double duration,
                        std::string_view body = {});

/// A boundary point of the measured robot: its base's first, then its links', chain by chain.
struct PointObservation {
  Vector3d position;  ///< world [m]; of a ball, where it meets the ground, less what rolling made
                      ///< of that since the start: it moves by slip
  double depth = 0.;  ///< along the ground's normal, > 0 inside [m]; minus infinity without ground
};

/// The foot of a chain of the measured robot: of the boundary points of its last link the one that
/// is deepest in the ground, or nearest to it.
struct FootObservation {
  std::size_t chain = 0;  ///< among the robot's
  std::size_t point = 0;  ///< among the link's
  double depth = 0.;      ///< along the ground's normal, > 0 inside [m]
  Vector3d position;      ///< where it meets the ground, or would, world [m]
  Vector3d normal;        ///< of the ground there
  Vector3d slip;     ///< of the material there along the ground since the step before [m]; 0 if
                     ///< another point was deepest then
  int contacts = 0;  ///< of the link: boundary points that carried ground force
};

/// One step as metrics see it.
struct Observation {
  const simulation::WorldState& world;
  const simulation::BodyState& body;
  double displacement = 0.;  ///< of the body's origin since the start, downhill [m]
  double height = 0.;  ///< of the body's origin over the ground, along its normal [m]; infinite
                       ///< without ground
  std::span<const PointObservation> points;         ///< empty unless a metric asked for them
  const simulation::WorldInputs* inputs = nullptr;  ///< of the step to come, where they are known
  std::span<const FootObservation> feet{};  ///< empty unless a metric asked, or without ground
  /// One a chain, above 0.5 while its leg is to stand; empty unless a metric asked and a gait
  /// tells.
  std::span<const double* const> stance{};
};

/// Along the ground's normal [m]; infinite without ground.
double height_over_ground(const RunContext& context, const Vector3d& point);

/// Whether `settle` has come. Half a step before counts: times are multiples of the step, rounded.
inline bool settled(const RunContext& context, const Observation& observation) {
  return observation.world.time >= context.settle - 0.5 * context.experiment->deltat;
}

/// A ball at the last observation, and how far it has rolled.
struct RolledBall {
  contact::BallFrame frame;
  Vector3d rolled;  ///< [m]
};

/// A foot as an Observer follows it.
struct FollowedFoot {
  std::size_t chain = 0;  ///< among the robot's
  std::size_t body = 0;   ///< of its link in WorldState::bodies
  const simulation::BodySpec* spec = nullptr;
  contact::BallFrame frame{};  ///< how its deepest point stood at the last observation
};

/// Makes observations of a run; its buffers are sized once.
class Observer {
 public:
  Observer(const RunContext& context, bool with_points, bool with_feet = false);
  /// Valid until the next call.
  Observation observe(const simulation::WorldState& world,
                      const simulation::WorldInputs* inputs = nullptr);

 private:
  void observe_points(const simulation::WorldState& world);
  void observe_feet(const simulation::WorldState& world);
  /// The next point: a ball of `radius` about p_WP on a body that is turned by R_WB.
  void observe_point(const Vector3d& p_WP, const Quaterniond& R_WB, double radius);

  const RunContext& context_;
  std::vector<PointObservation> points_;  // reserved for all points; no room when nobody asks
  std::vector<RolledBall> balls_;         // one a point, once they were seen
  std::vector<FollowedFoot> followed_;    // one a foot that is asked for
  std::vector<FootObservation> feet_;     // of these, once they were seen
};

class Metric {
 public:
  virtual ~Metric() = default;
  /// Called once for the initial state and once after each step.
  virtual void observe(const Observation& observation) = 0;
  /// Nothing when it does not apply.
  virtual std::optional<double> value() const = 0;
  /// Of a run that the engine broke off; nothing but for a metric of just that.
  virtual std::optional<double> value_of_broken_run() const { return std::nullopt; }
  /// Why a run that finished has none, where there is more to say than that it does not apply.
  virtual std::string why_not() const { return ""; }
};

/// Which runs a metric's value is of.
enum class MetricScope {
  run,       ///< one
  sweep,     ///< those that differ in one swept value alone; a Metric gives each run's part
  subjects,  ///< those of all subjects at equal swept values; made of their paths
  timing     ///< one, that is run again alone
};

struct UserMetric;

struct MetricDefinition {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  /// Null where no Metric looks at the run: of the scopes subjects and timing.
  std::unique_ptr<Metric> (*make)(const RunContext&) = nullptr;
  bool needs_points = false;
  Regime regime = Regime::none;  ///< the only one in which it says something; none: any
  MetricScope scope = MetricScope::run;
  bool needs_forces = false;         ///< WorldState::ground_forces
  bool needs_contact_force = false;  ///< that of bodies
  bool needs_feet = false;           ///< Observation::feet
  bool needs_stance = false;         ///< of the gait
  const UserMetric* user = nullptr;  ///< whose definition it is; null of the table's
  bool timing() const { return scope == MetricScope::timing; }
};

/// Every metric, in the order of the manual.
std::span<const MetricDefinition> metric_table();
const MetricDefinition* find_metric(std::string_view name);

/// A quantity that a Plot may draw over time.
struct SignalDefinition {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  double (*value)(const RunContext&, const Observation&);
  bool since_settle = false;  ///< value and time are counted from `settle`
};
std::span<const SignalDefinition> signal_table();
const SignalDefinition* find_signal(std::string_view name);

/// Calls `visit(body, state)` for the base and the links of the measured robot, chain by chain.
template <class Visit>
void for_each_body(const RunContext& context, const simulation::WorldState& world, Visit visit) {
  std::size_t index = context.body;
  simulation::for_each_body(context.robot_spec(), [&](const simulation::BodySpec& body) {
    visit(body, world.bodies[index++]);
  });
}

/// Speed along the ground from which a body counts as slipping, and below which as at rest [m/s].
inline constexpr double onset_speed = 1e-3;
/// How long it goes on so where a slip begins [s].
inline constexpr double slip_lasts = 0.01;

/// A peer keeps a resting body within its own margin of the surface, so a touching point may lie
/// that far above it [m].
inline constexpr double touching_gap = 1e-4;

/// Calls `visit(force, body, arm)` for each single force of the ground on the measured robot; the
/// arm is from the body's origin to where it acts, world axes [m].
template <class Visit>
void for_each_ground_force(const RunContext& context, const simulation::WorldState& world,
                           Visit visit) {
  const std::size_t end = context.body + simulation::body_count(context.robot_spec());
  for (const simulation::GroundForce& force : world.ground_forces) {
    if (force.body < context.body || force.body >= end) continue;
    const simulation::BodyState& body = world.bodies[force.body];
    visit(force, body, rotate(body.orientation, force.point));
  }
}

/// Static friction of the ground under the start; none without ground.
std::optional<double> static_friction(const RunContext& context);

/// Kinetic energy of the bodies of the measured robot [J].
double kinetic_energy(const RunContext& context, const simulation::WorldState& world);
/// Kinetic and gravitational energy of the bodies of the measured robot [J].
double mechanical_energy(const RunContext& context, const simulation::WorldState& world);

// The factories, each in the file of its family.
std::unique_ptr<Metric> make_creep_speed(const RunContext&);
std::unique_ptr<Metric> make_creep_sideways(const RunContext&);
std::unique_ptr<Metric> make_slip_acceleration(const RunContext&);
std::unique_ptr<Metric> make_friction(const RunContext&);
std::unique_ptr<Metric> make_settle_shift(const RunContext&);
std::unique_ptr<Metric> make_stopping_distance(const RunContext&);
std::unique_ptr<Metric> make_direction_error(const RunContext&);
std::unique_ptr<Metric> make_energy_gain(const RunContext&);
std::unique_ptr<Metric> make_slip_onset(const RunContext&);
std::unique_ptr<Metric> make_threshold_error(const RunContext&);
std::unique_ptr<Metric> make_spin_max(const RunContext&);
std::unique_ptr<Metric> make_stick_displacement(const RunContext&);
std::unique_ptr<Metric> make_slip_distance(const RunContext&);
std::unique_ptr<Metric> make_penetration_max(const RunContext&);
std::unique_ptr<Metric> make_penetration_mean(const RunContext&);
std::unique_ptr<Metric> make_penetration_rms(const RunContext&);
std::unique_ptr<Metric> make_contact_breaks(const RunContext&);
std::unique_ptr<Metric> make_impacts(const RunContext&);
std::unique_ptr<Metric> make_unrest(const RunContext&);
std::unique_ptr<Metric> make_restless(const RunContext&);
std::unique_ptr<Metric> make_stable_step(const RunContext&);
std::unique_ptr<Metric> make_fell(const RunContext&);
std::unique_ptr<Metric> make_walked_distance(const RunContext&);
std::unique_ptr<Metric> make_walking_speed(const RunContext&);
std::unique_ptr<Metric> make_foot_slip(const RunContext&);
std::unique_ptr<Metric> make_hook_losses(const RunContext&);
std::unique_ptr<Metric> make_stance_slip(const RunContext&);
std::unique_ptr<Metric> make_stance_depth(const RunContext&);
std::unique_ptr<Metric> make_stance_lift(const RunContext&);
std::unique_ptr<Metric> make_cost_of_transport(const RunContext&);
std::unique_ptr<Metric> make_body_height_min(const RunContext&);
std::unique_ptr<Metric> make_tilt_max(const RunContext&);
std::unique_ptr<Metric> make_integrator_steps(const RunContext&);
std::unique_ptr<Metric> make_rejected_steps(const RunContext&);
std::unique_ptr<Metric> make_evaluations(const RunContext&);
std::unique_ptr<Metric> make_jacobians(const RunContext&);
std::unique_ptr<Metric> make_events(const RunContext&);
std::unique_ptr<Metric> make_notices(const RunContext&);
std::unique_ptr<Metric> make_self_error(const RunContext&);
std::unique_ptr<Metric> make_reference_error(const RunContext&);
std::unique_ptr<Metric> make_truth_error(const RunContext&);
std::unique_ptr<Metric> make_energy_drift(const RunContext&);
std::unique_ptr<Metric> make_momentum_drift(const RunContext&);
std::unique_ptr<Metric> make_angular_momentum_drift(const RunContext&);
std::unique_ptr<Metric> make_rebound(const RunContext&);
std::unique_ptr<Metric> make_support_force(const RunContext&);
std::unique_ptr<Metric> make_force_residual(const RunContext&);
std::unique_ptr<Metric> make_force_residual_normal(const RunContext&);
std::unique_ptr<Metric> make_force_residual_cone(const RunContext&);
std::unique_ptr<Metric> make_force_residual_dissipation(const RunContext&);
std::unique_ptr<Metric> make_energy_residual(const RunContext&);
std::unique_ptr<Metric> make_joint_gap(const RunContext&);

}  // namespace hookpoint::studies
