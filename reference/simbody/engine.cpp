#include "reference/simbody/engine.h"

#include <array>

#include "reference/simbody/creep.h"
#include "reference/simbody/settings.h"
#include "reference/simbody/world.h"
#include "reference/static_depth.h"

namespace hookpoint::reference {
namespace {

using enum simulation::EngineGap::Handling;

/// What Simbody lacks.
constexpr auto gaps = std::to_array<OwnGap>({
    {feature::loops, refused, "choose engine dts, bullet, mujoco or ode"},
    {feature::couplings, refused, "choose engine dts, bullet or mujoco"},
    {feature::height_field, refused,
     "Simbody's balls and bricks meet half-spaces only; use Terrain.Flat or Terrain.Slope"},
    {feature::obstacles, refused,
     "Simbody's balls and bricks meet half-spaces only; choose engine dts, ode, bullet, mujoco or dart"},
    {feature::belt, refused,
     "a half-space of Simbody's stands still; choose engine dts, ode, bullet, mujoco or dart"},
    {feature::restitution, noticed,
     "Simbody has no coefficient of restitution: how a body rebounds follows from its contact's "
     "dissipation"},
    {feature::legcone, noticed, "Simbody has no cone: its samples touch, as under touch = points"},
    {feature::capsule, noticed,
     "a half-space meets no capsule in Simbody: its end balls touch, as under touch = points"},
    {feature::hull, noticed,
     "Simbody has no convex hull: its vertices touch, as under touch = points"},
    {feature::cylinder, noticed,
     "a half-space meets no cylinder in Simbody: the samples of its rims touch, as under touch = "
     "points"},
    {feature::tile_friction, refused, "use one material"},
    {feature::tile_softness, refused, "use one material"},
    {feature::tile_restitution, refused, "use one material"},
    {feature::rotors, refused, "joints of Simbody have no inertia of their own; use dts or mujoco"},
});

/// At `settings = matched` friction is a damper without a spring.
constexpr std::array matched_constants{&contact::MaterialConstants<double>::normal_stiffness,
                                       &contact::MaterialConstants<double>::normal_damping,
                                       &contact::MaterialConstants<double>::tangential_damping};

}  // namespace

constinit const Peer simbody_peer{
    .name = "simbody",
    .library = "Simbody",
    .package = "libsimbody-dev",
    .version = HOOKPOINT_SIMBODY_VERSION,
    .gaps = gaps,
    .matched_constants = matched_constants,
    .make = make_engine<simbody_peer>,
    .make_world = HOOKPOINT_SIMBODY_WORLD,
    .settings_table = simbody_settings_table,
    .creep = simbody_creep,
    .static_softness = matched_softness,
    .one_friction_setting = "matched",
};

}  // namespace hookpoint::reference
