// `engine = simbody`, in a build with Simbody and in one without.
#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "reference/peer_engine.h"
#include "reference/settings.h"

#ifdef HOOKPOINT_SIMBODY_VERSION
#include "reference/simbody/world.h"
#endif

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;

std::vector<EngineGap> gaps() {
  using enum EngineGap::Handling;
  return common_gaps_and(
      {{feature::height_field, refused,
        "Simbody's balls and bricks meet half-spaces only; use Terrain.Flat or Terrain.Slope"},
       {feature::restitution, noticed,
        "Simbody has no coefficient of restitution: how a body rebounds follows from its contact's "
        "dissipation"},
       {feature::legcone, refused, "Simbody has no cone; use Sphere or Box"},
       {feature::cylinder, refused, "a half-space meets no cylinder in Simbody; use Sphere or Box"},
       {feature::tile_friction, refused, "use one material"},
       {feature::tile_softness, refused, "use one material"},
       {feature::tile_restitution, refused, "use one material"}});
}

}  // namespace

#ifdef HOOKPOINT_SIMBODY_VERSION

simulation::EngineDescription describe_simbody() {
  return {"simbody", HOOKPOINT_SIMBODY_VERSION, "double", true, settings_names("simbody"), gaps()};
}

std::unique_ptr<simulation::Engine> make_simbody(const simulation::Experiment& experiment) {
  return make_peer_engine(experiment, describe_simbody(), [&] {
    return make_simbody_world(experiment, simbody_settings(settings_of(experiment, "simbody")));
  });
}

#else

simulation::EngineDescription describe_simbody() {
  return {"simbody", "", "double", false, settings_names("simbody"), gaps()};
}

std::unique_ptr<simulation::Engine> make_simbody(const simulation::Experiment&) {
  throw simulation::ExperimentError(
      "engine simbody: this build has no Simbody; install libsimbody-dev and build again");
}

#endif

}  // namespace hookpoint::reference
