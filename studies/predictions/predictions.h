// Closed forms set beside the measurements. They come from the experiment's constants alone, never
// from a run.
#pragma once

#include <optional>
#include <string_view>

#include "studies/engine_table.h"
#include "studies/metric.h"

namespace hookpoint::studies {

/// What the closed forms of a peer's engine say of a run, as far as its table has them.
struct PeerContact {
  std::optional<double> creep;     ///< `creep_speed` where friction holds [m/s]
  std::optional<double> softness;  ///< depth per newton at which a contact comes to rest [m/N]
  std::optional<double> creep_sideways = {};  ///< `creep_sideways` where friction holds [m/s]
};

/// Of a run of `experiment` by that engine.
PeerContact peer_contact(const EngineEntry& engine, const simulation::Experiment& experiment);

/// The closed form of `metric` for the run described by `context`, or nothing where there is none
/// (docs/studies.md lists them). But for `fell`, and the depths of a robot whose joints gravity
/// does not load, they hold for one rigid body on a plane that starts at rest, or on the level at a
/// speed. `peer`: of the run's engine, unless it is ours.
std::optional<double> predict(std::string_view metric, const RunContext& context,
                              const PeerContact& peer = {});

/// Of `penetration_max`, `penetration_mean` and `penetration_rms` [m]: a rigid footprint on equal
/// springs, ours or of the `softness` of a peer's contacts [m/N] on the level. Measured from the
/// start, the greatest depth of a body let go over the level is where its fall on spring and damper
/// first ends. Nothing for a robot whose joints gravity turns.
std::optional<double> penetration(std::string_view metric, const RunContext& context,
                                  std::optional<double> softness);

/// 1 where the joint loops of a walking robot are unstable while a leg is in the air, 0 where they
/// are stable: proportional control by a Controller.JointPD whose sensors are sampled and late, of
/// joints so damped that inertia does not count, q' = K (goal - q) with K = pconstant/damping. With
/// the period T and d samples of delay it is stable iff K T < 2 sin(pi/(2 (2 d + 1))). Nothing for
/// other joint controllers, with a dconstant, without damping, or where torques come late.
std::optional<double> joint_loop_fails(const RunContext& context);

/// Of `slip_onset`: Coulomb's atan(mu_s), less for a law that creeps faster than `onset_speed`
/// within the cone [rad]. Nothing for several bodies, without ground, and where an impulse law's
/// hops are as fast as that.
std::optional<double> slip_onset(const RunContext& context);
/// Of `threshold_error`: the same less atan(mu_s) [rad].
std::optional<double> threshold_error(const RunContext& context);

/// A rigid block on a plane under Coulomb friction: displacement v t + a t^2/2 until it rests.
struct RigidSlide {
  double speed = 0.;         ///< initial [m/s]
  double acceleration = 0.;  ///< along the displacement [m/s^2]
  double displacement(double time) const;
};
/// Nothing where `predict`'s conditions do not hold.
std::optional<RigidSlide> rigid_slide(const RunContext& context);

/// Of `slip_acceleration` for a ball let go on a plane: 5/7 g sin while friction carries 2/7 of the
/// pull, else g (sin - mu_k cos) [m/s^2].
std::optional<double> rolling_acceleration(const RunContext& context);
/// Of `rebound` for a body with one boundary point that hits a plane without gravity: our force
/// laws by their own equations, impulse laws and peers the material's restitution, peers at
/// `matched` the spring-damper that they were given.
std::optional<double> rebound(const RunContext& context);
/// Of `support_force`: the weight along the normal [N].
std::optional<double> support_force(const RunContext& context);

/// Of `restless`: 1 where deltat is above the largest stable step
/// (simulation/analysis/stability.h), else 0; nothing where there is no such step: an adaptive
/// integrator, an impulse law, a peer.
std::optional<double> restless(const RunContext& context);

/// What friction does in the run described by `context`: none unless `predict`'s conditions hold
/// and the body starts at rest.
Regime regime_of(const RunContext& context);

}  // namespace hookpoint::studies
