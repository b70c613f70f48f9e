#include "reference/ode/engine.h"

#include <array>

#include "reference/ode/creep.h"
#include "reference/ode/settings.h"
#include "reference/ode/world.h"
#include "reference/restitution_gap.h"
#include "reference/static_depth.h"

namespace hookpoint::reference {
namespace {

using enum simulation::EngineGap::Handling;

/// What ODE lacks.
constexpr auto gaps = std::to_array<OwnGap>({
    single_friction_gap,
    matched_restitution_gap,
    {feature::legcone, refused, "ODE has no cone; use Cylinder, Sphere or Box"},
    {feature::massless, refused, "every body of ODE has a mass; give the link one"},
    {feature::no_inertia, refused,
     "every body of ODE has an inertia; give it a shape or an inertia"},
    {feature::rotors, refused, "joints of ODE have no inertia of their own; use dts or mujoco"},
});

}  // namespace

constinit const Peer ode_peer{
    .name = "ode",
    .library = "ODE",
    .package = "libode-dev",
    .version = HOOKPOINT_ODE_VERSION,
    .gaps = gaps,
    .make = make_engine<ode_peer>,
    .make_world =
        [](const simulation::Experiment& experiment, Settings settings) {
          return make_ode_world(experiment, settings, OdeSolver::step);
        },
    .settings_table = [] { return ode_settings_table(OdeSolver::step); },
    .constraint_constants =
        [](const simulation::Experiment& experiment) {
          return ode_constraint_constants(experiment, settings_of(experiment, ode_peer),
                                          OdeSolver::step);
        },
    .creep = ode_creep,
    .static_softness = ode_softness,
};

// Its iterations end before they have converged: no closed form of its creep.
constinit const Peer ode_quickstep_peer{
    .name = "ode_quickstep",
    .library = "ODE",
    .package = "libode-dev",
    .version = HOOKPOINT_ODE_VERSION,
    .gaps = gaps,
    .make = make_engine<ode_quickstep_peer>,
    .make_world =
        [](const simulation::Experiment& experiment, Settings settings) {
          return make_ode_world(experiment, settings, OdeSolver::quickstep);
        },
    .settings_table = [] { return ode_settings_table(OdeSolver::quickstep); },
    .constraint_constants =
        [](const simulation::Experiment& experiment) {
          return ode_constraint_constants(experiment, settings_of(experiment, ode_quickstep_peer),
                                          OdeSolver::quickstep);
        },
    .static_softness = matched_softness,
};

}  // namespace hookpoint::reference
