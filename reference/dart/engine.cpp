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
    single_friction_gap,
    matched_restitution_gap,
    {feature::legcone, refused, "DART has no truncated cone; use Cylinder, Sphere or Box"},
    {feature::tile_softness, noticed,
     "at `settings = matched` the constants of the terrain's own material hold on every tile"},
    {feature::rotors, refused, "joints of DART have no inertia of their own; use dts or mujoco"},
});

}  // namespace

constinit const Peer dart_peer{
    .name = "dart",
    .library = "DART",
    .package = "libdart-dev",
    .version = HOOKPOINT_DART_VERSION,
    .gaps = gaps,
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
