// Closed forms set beside the measurements. They come from the experiment's constants alone, never
// from a run.
#pragma once

#include <optional>
#include <string_view>

#include "studies/metric.h"

namespace hookpoint::studies {

/// The closed form of `metric` for the run described by `context`, or nothing where there is none
/// (docs/studies.md lists them). But for `fell` they hold for one rigid body on a plane that starts
/// at rest, or on the level at a speed. `friction_mixing`: tangential speed per newton of a peer's
/// sticking contact [m/(N s)], where its constraints have one; `normal_mixing`: the normal speed
/// per newton at which it sinks for good.
std::optional<double> predict(std::string_view metric, const RunContext& context,
                              std::optional<double> friction_mixing, double normal_mixing = 0.);

/// 1 where the joint loops of a walking robot are unstable while a leg is in the air, 0 where they
/// are stable: proportional control by a Controller.JointPD whose sensors are sampled and late, of
/// joints so damped that inertia does not count, q' = K (goal - q) with K = pconstant/damping. With
/// the period T and d samples of delay it is stable iff K T < 2 sin(pi/(2 (2 d + 1))). Nothing for
/// other joint controllers, with a dconstant, without damping, or where torques come late.
std::optional<double> joint_loop_fails(const RunContext& context);

/// What friction does in the run described by `context`: none unless `predict`'s conditions hold
/// and the body starts at rest.
Regime regime_of(const RunContext& context);

}  // namespace hookpoint::studies
