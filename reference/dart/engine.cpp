// `engine = dart`, in a build with DART and in one without.
#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "reference/peer_engine.h"
#include "reference/settings.h"

#ifdef HOOKPOINT_DART_VERSION
#include "reference/dart/world.h"
#endif

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;

std::vector<EngineGap> gaps() {
  using enum EngineGap::Handling;
  return common_gaps_and(
      {single_friction_gap,
       {feature::legcone, refused, "DART has no truncated cone; use Cylinder, Sphere or Box"},
       {feature::tile_softness, noticed,
        "at `settings = matched` the constants of the terrain's own material hold on every tile"}});
}

}  // namespace

#ifdef HOOKPOINT_DART_VERSION

simulation::EngineDescription describe_dart() {
  return {"dart", HOOKPOINT_DART_VERSION, "double", true, settings_names("dart"), gaps()};
}

std::unique_ptr<simulation::Engine> make_dart(const simulation::Experiment& experiment) {
  return make_peer_engine(experiment, describe_dart(), [&] {
    return make_dart_world(experiment,
                           dart_settings(settings_of(experiment, "dart"), experiment.deltat,
                                         ground_material(experiment)));
  });
}

#else

simulation::EngineDescription describe_dart() {
  return {"dart", "", "double", false, settings_names("dart"), gaps()};
}

std::unique_ptr<simulation::Engine> make_dart(const simulation::Experiment&) {
  throw simulation::ExperimentError(
      "engine dart: this build has no DART; install libdart-dev and build again");
}

#endif

}  // namespace hookpoint::reference
