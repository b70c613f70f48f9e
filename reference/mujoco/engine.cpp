#include "reference/mujoco/engine.h"

#include <array>

#include "reference/mujoco/creep.h"
#include "reference/mujoco/settings.h"
#include "reference/mujoco/world.h"

namespace hookpoint::reference {
namespace {

using enum simulation::EngineGap::Handling;

/// What MuJoCo lacks.
constexpr auto gaps = std::to_array<OwnGap>({
    single_friction_gap,
    {feature::massless, refused, "every body of MuJoCo that moves has a mass; give the link one"},
    {feature::restitution, noticed,
     "MuJoCo has no coefficient of restitution: how a body rebounds follows from its contact's "
     "damping"},
    {feature::tile_softness, noticed,
     "the ratio of tangential to normal constants (impratio) is one for a world, the ground's"},
    {feature::foot_softness, noticed,
     "the ratio of tangential to normal constants (impratio) is one for a world, the ground's"},
});

constexpr auto own_settings = std::to_array<OwnSetting>({
    {"noslip", "noslip, of mujoco alone, is recommended with the no-slip iterations of its manual"},
    {"file",
     "file, of mujoco and mujoco_3_14, has what the Materials state in their words: solref, solimp, "
     "cone, impratio"},
});

}  // namespace

constinit const Peer mujoco_peer{
    .name = "mujoco",
    .library = "MuJoCo",
    .package = "libmujoco-dev",
    .version = HOOKPOINT_MUJOCO_VERSION,
    .gaps = gaps,
    .own_settings = own_settings,
    .make = make_engine<mujoco_peer>,
    .make_world = HOOKPOINT_MUJOCO_WORLD,
    .settings_table = mujoco_settings_table,
    .creep = mujoco_creep,
    .static_softness = mujoco_softness,
};

}  // namespace hookpoint::reference
