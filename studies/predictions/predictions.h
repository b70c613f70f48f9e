// Closed forms set beside the measurements. They come from the experiment's constants alone, never
// from a run.
#pragma once

#include <optional>
#include <string_view>

#include "studies/engine_table.h"
#include "studies/metric.h"
#include "studies/predictions/prediction.h"

namespace hookpoint::studies {

/// What the closed forms of an engine other than ours say of a run.
struct PeerContact {
  /// Where friction holds.
  simulation::ClosedForm<simulation::CreepVelocity> creep =
      NoClosedForm{"the engine has none of its creep"};
  /// Depth per newton at which a contact comes to rest [m/N].
  simulation::ClosedForm<double> softness = NoClosedForm{"the engine has none of its depths"};
  /// The first of another experiment; null where the engine has none.
  simulation::ClosedForm<simulation::CreepVelocity> (*creep_of)(const simulation::Experiment&) =
      nullptr;
};

/// Of a run of `experiment` by that engine.
PeerContact peer_contact(const EngineEntry& engine, const simulation::Experiment& experiment);

/// The closed form of `metric` for the run described by `context` (docs/studies.md lists them). But
/// for `fell`, and the depths of a robot whose joints gravity does not load, they hold for one
/// rigid body on a plane that cannot roll and starts at rest, or on the level at a speed. `peer`:
/// of the run's engine, unless it is ours.
Prediction predict(std::string_view metric, const RunContext& context,
                   const PeerContact& peer = {});

/// Whether there are runs in which `metric` has a closed form.
bool may_be_predicted(std::string_view metric);

/// Of `penetration_max`, `penetration_mean` and `penetration_rms` [m]: a rigid footprint on equal
/// springs, ours or of the `softness` of a peer's contacts [m/N] on the level. Measured from the
/// start, the greatest depth of a body let go over the level is where its fall on spring and damper
/// first ends. Nothing for a robot whose joints gravity turns.
Prediction penetration(std::string_view metric, const RunContext& context,
                       const simulation::ClosedForm<double>& softness);

/// 1 where the joint loops of a walking robot are unstable while a leg is in the air, 0 where they
/// are stable: proportional control by a Controller.JointPD whose sensors are sampled and late, of
/// joints so damped that inertia does not count, q' = K (goal - q) with K = pconstant/damping. With
/// the period T and d samples of delay it is stable iff K T < 2 sin(pi/(2 (2 d + 1))). Nothing for
/// other joint controllers, with a dconstant, without damping, or where torques come late.
Prediction joint_loop_fails(const RunContext& context);

/// Of `slip_onset` [rad]: the angle of the driving force at which a rigid block under Coulomb's
/// friction, that the scene's own signals pull, reaches `onset_speed` after `settle`. Of a pull
/// that grows slowly that is atan(mu), mu_s or the one coefficient of the engine; less for a law or
/// an engine that creeps as fast as that within the cone (docs/studies.md, The threshold of slip).
Prediction slip_onset(const RunContext& context, const PeerContact& peer = {});
/// Of `threshold_error`: the same less atan(mu_s) [rad].
Prediction threshold_error(const RunContext& context, const PeerContact& peer = {});

/// A rigid block on a plane under Coulomb friction: displacement v t + a t^2/2 until it rests.
struct RigidSlide {
  double speed = 0.;         ///< initial [m/s]
  double acceleration = 0.;  ///< along the displacement [m/s^2]
  double displacement(double time) const;
};
/// Nothing where `predict`'s conditions do not hold.
std::optional<RigidSlide> rigid_slide(const RunContext& context);

/// Of `slip_acceleration` for a ball let go on a plane, J its inertia about its centre: while
/// friction carries its part J/(J + m r^2) of the pull, g sin m r^2/(J + m r^2), 5/7 g sin of a
/// full ball; else g (sin - mu_k cos) [m/s^2].
Prediction rolling_acceleration(const RunContext& context);
/// Of `rebound` for a body with one boundary point that hits a plane without gravity: our force
/// laws by their own equations, impulse laws and peers the material's restitution, peers at
/// `matched` the spring-damper that they were given.
Prediction rebound(const RunContext& context);
/// Of `support_force`: the weight along the normal [N].
Prediction support_force(const RunContext& context);

/// Of `restless`: 1 where deltat is above the largest stable step
/// (simulation/analysis/stability.h), else 0; nothing where there is no such step (an adaptive
/// integrator, an impulse law, a peer) and where something else moves the robot.
Prediction restless(const RunContext& context);

/// What friction does in the run described by `context`: none unless `predict`'s conditions hold
/// and the body starts at rest.
Regime regime_of(const RunContext& context);

}  // namespace hookpoint::studies
