#include "reference/engines.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "reference/bullet/world.h"
#include "reference/experiment_checks.h"
#include "reference/ode/world.h"
#include "reference/settings.h"

namespace hookpoint::reference {
namespace {

constexpr std::array all_peers = std::to_array<Peer>({
    {"ode", describe_ode, make_ode},
    {"ode_quickstep", describe_ode_quickstep, make_ode_quickstep},
    {"bullet", describe_bullet, make_bullet},
    {"mujoco", describe_mujoco, make_mujoco},
    {"dart", describe_dart, make_dart},
    {"simbody", describe_simbody, make_simbody},
});

using simulation::EngineGap;

/// What both libraries lack.
std::vector<EngineGap> ode_gaps() {
  using enum EngineGap::Handling;
  return common_gaps_and(
      {single_friction_gap,
       {feature::legcone, refused, "ODE has no cone; use Cylinder, Sphere or Box"},
       {feature::massless, refused, "every body of ODE has a mass; give the link one"},
       {feature::no_inertia, refused,
        "every body of ODE has an inertia; give it a shape or an inertia"}});
}

std::vector<EngineGap> bullet_gaps() { return common_gaps_and({single_friction_gap}); }

std::unique_ptr<simulation::Engine> make(std::string_view engine,
                                         const simulation::Experiment& experiment,
                                         OdeSolver solver) {
  const auto description = solver == OdeSolver::step ? describe_ode() : describe_ode_quickstep();
  return make_peer_engine(experiment, description, [&] {
    return make_ode_world(experiment, settings_of(experiment, engine), solver, engine);
  });
}

}  // namespace

std::span<const Peer> known_peers() { return all_peers; }

std::span<const Peer> peers() {
  static const std::vector<Peer> found = [] {
    std::vector<Peer> result;
    std::ranges::copy_if(all_peers, std::back_inserter(result),
                         [](const Peer& peer) { return peer.describe().found; });
    return result;
  }();
  return found;
}

std::unique_ptr<simulation::Engine> make_ode(const simulation::Experiment& experiment) {
  return make("ode", experiment, OdeSolver::step);
}

std::unique_ptr<simulation::Engine> make_ode_quickstep(const simulation::Experiment& experiment) {
  return make("ode_quickstep", experiment, OdeSolver::quickstep);
}

std::unique_ptr<simulation::Engine> make_bullet(const simulation::Experiment& experiment) {
  return make_peer_engine(experiment, describe_bullet(), [&] {
    return make_bullet_world(experiment,
                             bullet_settings(settings_of(experiment, "bullet"), experiment.deltat,
                                             ground_material(experiment)));
  });
}

simulation::EngineDescription describe_ode() {
  return {"ode", HOOKPOINT_ODE_VERSION, "double", true, settings_names("ode"), ode_gaps()};
}
simulation::EngineDescription describe_ode_quickstep() {
  return {"ode_quickstep", HOOKPOINT_ODE_VERSION, "double", true, settings_names("ode_quickstep"),
          ode_gaps()};
}
simulation::EngineDescription describe_bullet() {
  return {"bullet", HOOKPOINT_BULLET_VERSION, "double",
          true,     settings_names("bullet"), bullet_gaps()};
}

namespace {

ConstraintConstants ode_constants(const simulation::Experiment& experiment, Settings settings,
                                  OdeSolver solver) {
  ConstraintConstants constants =
      ode_settings(settings, solver, experiment.deltat, ground_material(experiment)).constraint;
  if (experiment.constraint_mixing && settings != Settings::matched)
    constants.normal_mixing = constants.tangential_mixing = *experiment.constraint_mixing;
  return constants;
}

}  // namespace

ConstraintConstants constraint_constants(std::string_view engine,
                                         const simulation::Experiment& experiment) {
  const Settings settings = settings_of(experiment, engine);
  const auto material = ground_material(experiment);
  if (engine == "bullet") return bullet_settings(settings, experiment.deltat, material).constraint;
  if (engine == "dart") return dart_settings(settings, experiment.deltat, material).constraint;
  if (engine == "ode") return ode_constants(experiment, settings, OdeSolver::step);
  if (engine == "ode_quickstep") return ode_constants(experiment, settings, OdeSolver::quickstep);
  throw std::invalid_argument("no peer called '" + std::string(engine) + "'");
}

}  // namespace hookpoint::reference
