// `engine = dart`, in a build with DART and in one without.
#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "reference/settings.h"

#ifdef HOOKPOINT_DART_VERSION
#include "reference/dart_world.h"
#endif

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;

std::vector<EngineGap> gaps() {
  using enum EngineGap::Handling;
  std::vector<EngineGap> gaps = common_gaps();
  const auto add = [&gaps](std::string_view name, EngineGap::Handling handling,
                           const char* instead) {
    gaps.push_back({std::string(name), handling, instead});
  };
  add(feature::two_frictions, noticed,
      "this engine has one coefficient of friction, and it is the kinetic one");
  add(feature::legcone, refused, "DART has no truncated cone; use Cylinder, Sphere or Box");
  add(feature::tile_softness, noticed,
      "at `settings = matched` the constants of the terrain's own material hold on every tile");
  return gaps;
}

}  // namespace

#ifdef HOOKPOINT_DART_VERSION

simulation::EngineDescription describe_dart() {
  return {"dart", HOOKPOINT_DART_VERSION, "double", true, settings_names(), gaps()};
}

std::unique_ptr<simulation::Engine> make_dart(const simulation::Experiment& experiment) {
  const auto notices = check_supported(experiment, describe_dart());
  const DartSettings settings = dart_settings(settings_of(experiment, "dart"), experiment.deltat,
                                              ground_material(experiment));
  return make_peer_engine(experiment, make_dart_world(experiment, settings), notices);
}

#else

simulation::EngineDescription describe_dart() {
  return {"dart", "", "double", false, settings_names(), gaps()};
}

std::unique_ptr<simulation::Engine> make_dart(const simulation::Experiment&) {
  throw simulation::ExperimentError(
      "engine dart: this build has no DART; install libdart-dev and build again");
}

#endif

}  // namespace hookpoint::reference
