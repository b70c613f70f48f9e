#include "reference/dart/engine.h"

#include <array>

#include "reference/dart/creep.h"
#include "reference/dart/settings.h"
#include "reference/dart/world.h"
#include "reference/restitution_gap.h"
#include "reference/static_depth.h"

namespace hookpoint::reference {
namespace {

using enum simulation::EngineGap::Handling;

/// What DART lacks.
constexpr auto gaps = std::to_array<OwnGap>({
    {feature::loops, refused, "choose engine dts, bullet, mujoco or ode"},
    {feature::couplings, refused, "choose engine dts, bullet or mujoco"},
    single_friction_gap,
    matched_restitution_gap,
    {feature::legcone, noticed,
     "DART has no truncated cone: its samples touch, as under touch = points"},
    {feature::capsule, noticed,
     "FCL as DART has it meets no capsule: its end balls touch, as under touch = points"},
    {feature::hull, noticed,
     "FCL as DART has it meets no hull: its vertices touch, as under touch = points"},
    {feature::lying_cylinder, stated,
     "FCL puts the contact of a cylinder that lies on a box beside the line below its axis, once it is "
     "some millimetres deep: it stands on slopes"},
    {feature::tile_softness, noticed,
     "at `settings = matched` the constants of the terrain's own material hold on every tile"},
    {feature::foot_softness, noticed,
     "the engine has one softness: the terrain's own material holds under all of them"},
    {feature::rotors, refused, "joints of DART have no inertia of their own; use dts or mujoco"},
});

/// On a machine of 8 GB, beside others.
constexpr TriangleLimit most_triangles{.most = 750'000, .bytes_per_triangle = 900.};

}  // namespace

constinit const Peer dart_peer{
    .name = "dart",
    .library = "DART",
    .package = "libdart-dev",
    .version = HOOKPOINT_DART_VERSION,
    .gaps = gaps,
    .triangles = most_triangles,
    .make = make_engine<dart_peer>,
    .make_world = HOOKPOINT_DART_WORLD,
    .settings_table = dart_settings_table,
    .constraint_constants =
        [](const simulation::Experiment& experiment) {
          return dart_settings(settings_of(experiment, dart_peer), experiment.deltat,
                               ground_material(experiment))
              .constraint;
        },
    .creep = dart_creep,
    .static_softness = matched_softness,
};

}  // namespace hookpoint::reference
