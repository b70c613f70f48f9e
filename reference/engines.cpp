#include "reference/engines.h"

#include <array>
#include <stdexcept>

#include "reference/bullet_world.h"
#include "reference/experiment_checks.h"
#include "reference/ode_world.h"
#include "reference/settings.h"

namespace hookpoint::reference {
namespace {

constexpr std::array<Peer, 3> all_peers{{
    {"ode", describe_ode, make_ode},
    {"ode_quickstep", describe_ode_quickstep, make_ode_quickstep},
    {"bullet", describe_bullet, make_bullet},
}};

std::unique_ptr<simulation::Engine> make(std::string_view engine,
                                         const simulation::Experiment& experiment,
                                         OdeSolver solver) {
  check_supported(experiment, engine);
  const OdeSettings settings = ode_settings(settings_of(experiment, engine), solver,
                                            experiment.deltat, ground_material(experiment));
  return make_peer_engine(experiment, make_ode_world(experiment, settings, solver, engine));
}

}  // namespace

std::span<const Peer> peers() { return all_peers; }

std::unique_ptr<simulation::Engine> make_ode(const simulation::Experiment& experiment) {
  return make("ode", experiment, OdeSolver::step);
}

std::unique_ptr<simulation::Engine> make_ode_quickstep(const simulation::Experiment& experiment) {
  return make("ode_quickstep", experiment, OdeSolver::quickstep);
}

std::unique_ptr<simulation::Engine> make_bullet(const simulation::Experiment& experiment) {
  check_supported(experiment, "bullet");
  const BulletSettings settings = bullet_settings(settings_of(experiment, "bullet"),
                                                  experiment.deltat, ground_material(experiment));
  return make_peer_engine(experiment, make_bullet_world(experiment, settings));
}

simulation::EngineDescription describe_ode() {
  return {"ode", HOOKPOINT_ODE_VERSION, "double", true, settings_names()};
}
simulation::EngineDescription describe_ode_quickstep() {
  return {"ode_quickstep", HOOKPOINT_ODE_VERSION, "double", true, settings_names()};
}
simulation::EngineDescription describe_bullet() {
  return {"bullet", HOOKPOINT_BULLET_VERSION, "double", true, settings_names()};
}

ConstraintConstants constraint_constants(std::string_view engine,
                                         const simulation::Experiment& experiment) {
  const Settings settings = settings_of(experiment, engine);
  const auto material = ground_material(experiment);
  if (engine == "bullet") return bullet_settings(settings, experiment.deltat, material).constraint;
  if (engine == "ode")
    return ode_settings(settings, OdeSolver::step, experiment.deltat, material).constraint;
  if (engine == "ode_quickstep")
    return ode_settings(settings, OdeSolver::quickstep, experiment.deltat, material).constraint;
  throw std::invalid_argument("no peer called '" + std::string(engine) + "'");
}

}  // namespace hookpoint::reference
