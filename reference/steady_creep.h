// How a body creeps down a slope on dampers that carry no more than a limit each.
#pragma once

#include <vector>

#include "reference/resting_body.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

/// Friction of a touching point that moves at v: damping v, cut where it is more than `limit`.
struct FrictionDamper {
  double along = 0., across = 0.;  ///< damping down the slope and across it [N s/m]
  double limit = 0.;               ///< [N]
};

/// Steady motion in the plane.
struct SteadyCreep {
  simulation::CreepVelocity velocity;  ///< of the body's origin
  double spin = 0.;                    ///< about the normal [rad/s]
  bool straight = true;                ///< down the fall, without a turn
  bool limited = false;                ///< a damper is at its limit
};

/// The motion at which `dampers`, one for each of the body's arms, carry its pull and leave no
/// moment about the normal (docs/reference_engines.md, Creep on dampers). No closed form where they
/// cannot carry it.
simulation::ClosedForm<SteadyCreep> steady_creep(const RestingBody& body,
                                                 const std::vector<FrictionDamper>& dampers);

/// One damper an arm, without damping as yet, each with the limit of a friction row whose load is
/// that of the body without friction: `friction` [1] times it, as dWorldStep and DART have it.
/// No closed form where these loads are not known (normal_loads).
simulation::ClosedForm<std::vector<FrictionDamper>> limits_without_friction(const RestingBody& body,
                                                                            double friction);
/// On friction rows that yield by `mixing` [m/(N s)], > 0, times their force, up to such limits.
simulation::ClosedForm<SteadyCreep> creep_by_mixing(const RestingBody& body, double friction,
                                                    double mixing);

/// The velocity, unless a turn of more than 0.2 rad within the run makes it another one.
simulation::ClosedForm<simulation::CreepVelocity> lasting(const SteadyCreep& creep,
                                                          const simulation::Experiment& experiment);

/// A touching point carries as much friction as it can: what others then do has no closed form.
inline const simulation::NoClosedForm point_at_limit{
    "a touching point slips while others hold the body"};

}  // namespace hookpoint::reference
