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
    {feature::couplings, refused,
     "ODE's joints follow no other; choose engine dts, bullet or mujoco"},
    single_friction_gap,
    matched_restitution_gap,
    {feature::legcone, noticed, "ODE has no cone: its samples touch, as under touch = points"},
    {feature::hull, noticed,
     "ODE's convex geometry meets no triangles and no cylinder: its vertices touch, as under touch "
     "= points"},
    {feature::massless, refused, "every body of ODE has a mass; give the link one"},
    {feature::no_inertia, refused,
     "every body of ODE has an inertia; give it a shape or an inertia"},
    {feature::rotors, refused, "joints of ODE have no inertia of their own; use dts or mujoco"},
});

/// On a machine of 8 GB, beside others.
constexpr TriangleLimit most_triangles{.most = 4'000'000, .bytes_per_triangle = 250.};

}  // namespace

constinit const Peer ode_peer{
    .name = "ode",
    .library = "ODE",
    .package = "libode-dev",
    .version = HOOKPOINT_ODE_VERSION,
    .gaps = gaps,
    .triangles = most_triangles,
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

constinit const Peer ode_quickstep_peer{
    .name = "ode_quickstep",
    .library = "ODE",
    .package = "libode-dev",
    .version = HOOKPOINT_ODE_VERSION,
    .gaps = gaps,
    .triangles = most_triangles,
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
    .creep =
        [](const simulation::Experiment&) -> simulation::ClosedForm<simulation::CreepVelocity> {
      return simulation::NoClosedForm{"the iterations of ODE's QuickStep end before they converge"};
    },
    .static_softness = matched_softness,
};

}  // namespace hookpoint::reference
