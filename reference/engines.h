// The peers by name. Each factory builds a world from the same experiment as ours and gives the
// same published values.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/engine.h"

namespace hookpoint::reference {

/// ODE with dWorldStep: one matrix of all constraints, Dantzig's method (`engine = ode`).
/// Throws simulation::ExperimentError naming what the engine cannot run. World steps of different
/// objects may run in different threads at once and give the same bytes as one after the other.
std::unique_ptr<simulation::Engine> make_ode(const simulation::Experiment& experiment);
/// ODE with dWorldQuickStep: successive over-relaxation (`engine = ode_quickstep`). Steps of
/// different worlds are taken one at a time: the library draws its row order from one random stream
/// of the process.
std::unique_ptr<simulation::Engine> make_ode_quickstep(const simulation::Experiment& experiment);
/// Bullet's btDiscreteDynamicsWorld with its sequential impulse solver (`engine = bullet`).
std::unique_ptr<simulation::Engine> make_bullet(const simulation::Experiment& experiment);

/// MuJoCo (`engine = mujoco`), whose contacts are soft constraints of a convex problem. Where the
/// build has no MuJoCo its description says `found = false`, and this throws.
std::unique_ptr<simulation::Engine> make_mujoco(const simulation::Experiment& experiment);

simulation::EngineDescription describe_ode();
simulation::EngineDescription describe_ode_quickstep();
simulation::EngineDescription describe_bullet();

/// DART's World with its boxed LCP (Dantzig's method, Gauss-Seidel where that fails) and FCL
/// (`engine = dart`). Throws simulation::ExperimentError also where the build has no DART.
std::unique_ptr<simulation::Engine> make_dart(const simulation::Experiment& experiment);
simulation::EngineDescription describe_dart();

/// Simbody with its compliant contact and CPodes, an implicit integrator of steps of its own
/// (`engine = simbody`). Throws simulation::ExperimentError also where the build has no Simbody.
std::unique_ptr<simulation::Engine> make_simbody(const simulation::Experiment& experiment);
simulation::EngineDescription describe_simbody();
simulation::EngineDescription describe_mujoco();

/// A peer as a registry wants it.
struct Peer {
  std::string_view name;
  simulation::EngineDescription (*describe)();
  simulation::EngineFactory make;
};
/// Every peer of this folder, in the order of its documentation.
std::span<const Peer> known_peers();
/// Those whose library this build has; the others describe themselves as not found.
std::span<const Peer> peers();

/// One line of the table that a report prints beside a peer's results.
struct SettingRow {
  std::string quantity;     ///< name and unit
  std::string default_;     ///< value at `settings = default`
  std::string recommended;  ///< value at `settings = recommended`
  std::string matched;      ///< value at `settings = matched`
  std::string source;       ///< where the values come from
  std::string noslip{};     ///< value at MuJoCo's `settings = noslip`; empty: as recommended
};
/// Every constant of the engine called `engine` at every setting. Throws std::invalid_argument on
/// another name.
std::vector<SettingRow> settings_table(std::string_view engine);

/// The softness of an engine's contact rows, J v = ERP error / dt - CFM f for a force f. SI.
struct ConstraintConstants {
  /// ERP of the normal row: the part of the depth beyond `surface_layer` that is undone in a step.
  double normal_error_reduction = 0.;
  /// CFM of the normal row [m/(N s)].
  double normal_mixing = 0.;
  /// ERP of the friction rows; 0: they forget displacement.
  double tangential_error_reduction = 0.;
  /// CFM of a friction row [m/(N s)]: a sticking contact creeps at this times f_t.
  double tangential_mixing = 0.;
  /// Penetration that nothing pushes out [m].
  double surface_layer = 0.;
  /// A mixing of impulses that is a part of each row's own diagonal of J M^-1 J^T [1]: a sticking
  /// contact creeps at this times (J M^-1 J^T)_ii dt f_t. DART has it.
  double relative_mixing = 0.;
};
/// What the engine called `engine` uses for `experiment` (its settings, step and terrain's
/// material). A prediction made of these holds as far as the solver converges, so not for few
/// iterations (docs/reference_engines.md).
ConstraintConstants constraint_constants(std::string_view engine,
                                         const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
