#include "reference/bullet/engine.h"

#include <array>

#include "reference/bullet/settings.h"
#include "reference/bullet/world.h"
#include "reference/static_depth.h"

namespace hookpoint::reference {
namespace {

using enum simulation::EngineGap::Handling;

/// What Bullet lacks.
constexpr auto gaps = std::to_array<OwnGap>({
    single_friction_gap,
    {feature::restitution, noticed,
     "Bullet slows a body down before it lands, and lets it rebound only where one step takes it "
     "across the distance at which a contact is found, 20 mm for a shape and 0.2 mm for a point; "
     "at "
     "`settings = matched` the material's damping alone decides"},
    {feature::rotors, refused, "joints of Bullet have no inertia of their own; use dts or mujoco"},
    {feature::planar, refused,
     "Bullet's planar joint moves along axes that turn with the body; choose dts, dart, mujoco, "
     "ode "
     "or simbody"},
});

}  // namespace

constinit const Peer bullet_peer{
    .name = "bullet",
    .library = "Bullet",
    .package = "libbullet-dev",
    .version = HOOKPOINT_BULLET_VERSION,
    .gaps = gaps,
    .make = make_engine<bullet_peer>,
    .make_world = HOOKPOINT_BULLET_WORLD,
    .settings_table = bullet_settings_table,
    .constraint_constants =
        [](const simulation::Experiment& experiment) {
          return bullet_settings(settings_of(experiment, bullet_peer), experiment.deltat,
                                 ground_material(experiment))
              .constraint;
        },
    .static_softness = matched_softness,
};

}  // namespace hookpoint::reference
