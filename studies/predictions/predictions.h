// Closed forms set beside the measurements. They come from the experiment's constants alone, never
// from a run.
#pragma once

#include <optional>
#include <string_view>

#include "studies/measure/engine_table.h"
#include "studies/measure/metric.h"
#include "studies/measure/prediction.h"

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

/// The closed form of each metric that has one, for the run described by `context` (docs/metrics.md
/// lists them). But for `fell`, and the depths of a robot whose joints gravity does not load, they
/// hold for one rigid body on a plane that cannot roll and starts at rest, or on the level at a
/// speed. `peer`: of the run's engine, unless it is ours.
namespace predicted {

Prediction creep_speed(const RunContext& context, const PeerContact& peer);
Prediction creep_sideways(const RunContext& context, const PeerContact& peer);
/// Of a ball, rolling_acceleration.
Prediction slip_acceleration(const RunContext& context, const PeerContact& peer);
Prediction friction(const RunContext& context, const PeerContact& peer);
Prediction anisotropy(const RunContext& context, const PeerContact& peer);
Prediction stick_displacement(const RunContext& context, const PeerContact& peer);
Prediction stopping_distance(const RunContext& context, const PeerContact& peer);
Prediction impacts(const RunContext& context, const PeerContact& peer);
Prediction direction_error(const RunContext& context, const PeerContact& peer);

/// The angle of the driving force at which a rigid block under Coulomb's friction, that the scene's
/// own signals pull, reaches `onset_speed` after `settle` [rad]. Of a pull that grows slowly that
/// is atan(mu), mu_s or the one coefficient of the engine; less for a law or an engine that creeps
/// as fast as that within the cone (docs/metrics.md, The threshold of slip).
Prediction slip_onset(const RunContext& context, const PeerContact& peer);
/// The same less atan(mu_s) [rad].
Prediction threshold_error(const RunContext& context, const PeerContact& peer);

/// Depths of a rigid footprint on equal springs, ours or of the softness of a peer's contacts on
/// the level [m]. Measured from the start, the greatest depth of a body released over the level is
/// where its fall on spring and damper first ends. Nothing for a robot whose joints gravity turns.
Prediction penetration_max(const RunContext& context, const PeerContact& peer);
Prediction penetration_mean(const RunContext& context, const PeerContact& peer);
Prediction penetration_rms(const RunContext& context, const PeerContact& peer);

/// Of a body with one boundary point that hits a plane without gravity: our force laws by their own
/// equations, impulse laws and peers the material's restitution, peers at `matched` the
/// spring-damper that they were given.
Prediction rebound(const RunContext& context, const PeerContact& peer);
/// The weight along the normal [N].
Prediction support_force(const RunContext& context, const PeerContact& peer);

/// 1 where deltat is above the largest stable step (simulation/analysis/stability.h), else 0;
/// nothing where there is no such step (an adaptive integrator, an impulse law, a peer) and where
/// something else moves the robot.
Prediction restless(const RunContext& context, const PeerContact& peer);

/// 1 where the joint loops of a walking robot are unstable while a leg is in the air, 0 where they
/// are stable: proportional control by a Controller.JointPD whose sensors are sampled and late, of
/// joints so damped that inertia does not count, q' = K (goal - q) with K = pconstant/damping. With
/// the period T and d samples of delay it is stable iff K T < 2 sin(pi/(2 (2 d + 1))). Nothing for
/// other joint controllers, with a dconstant, without damping, or where torques come late.
Prediction fell(const RunContext& context, const PeerContact& peer);

}  // namespace predicted

/// The closed form of the metric of that name, if it has one.
Prediction predict(std::string_view metric, const RunContext& context,
                   const PeerContact& peer = {});

/// How far the contacts of a body at rest hold it downhill of where their springs are slack [m]:
/// `stick_displacement` of a start that is not in balance.
Prediction tangential_give(const RunContext& context);

/// A rigid block on a plane under Coulomb friction: displacement v t + a t^2/2 until it rests.
struct RigidSlide {
  double speed = 0.;         ///< initial [m/s]
  double acceleration = 0.;  ///< along the displacement [m/s^2]
  double displacement(double time) const;
};
/// Nothing where `predict`'s conditions do not hold.
std::optional<RigidSlide> rigid_slide(const RunContext& context);

/// Of `slip_acceleration` for a ball released on a plane, J its inertia about its centre: while
/// friction carries its part J/(J + m r^2) of the pull, g sin m r^2/(J + m r^2), 5/7 g sin of a
/// full ball; else g (sin - mu_k cos) [m/s^2].
Prediction rolling_acceleration(const RunContext& context);
/// What friction does in the run described by `context`: none unless `predict`'s conditions hold
/// and the body starts at rest.
Regime regime_of(const RunContext& context);

}  // namespace hookpoint::studies
