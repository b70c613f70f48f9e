// A peer as one row: all that the program knows of an engine which is not ours. NAME/engine.cpp has
// the row, engines.cpp lists them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/experiment_checks.h"
#include "reference/settings.h"
#include "reference/unread_constants.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/closed_form.h"

namespace hookpoint::reference {

class PeerWorld;

/// What a grid of heights may have, where the library makes triangles of it.
struct TriangleLimit {
  std::size_t most = 0;            ///< 0: the library makes none of a grid
  double bytes_per_triangle = 0.;  ///< of memory that the library takes, measured
};

struct Peer {
  std::string_view name;     ///< as in `engine = ode`
  std::string_view library;  ///< as its authors call it: "ODE"
  std::string_view package;  ///< of Debian, which brings it
  std::string_view version;  ///< of the library linked; empty where this build has none
  /// What it does not do as ours does, beside what every peer lacks (common_gaps_and).
  std::span<const OwnGap> gaps{};
  std::span<const OwnSetting> own_settings{};
  /// Of a Material, what it makes contacts of at `settings = matched`, beside friction.
  std::span<double contact::MaterialConstants<double>::*const> matched_constants =
      spring_and_damper;
  TriangleLimit triangles{};

  /// make_engine of this row: the peer as any other engine is built. Throws
  /// simulation::ExperimentError where the build has no such library, and what make_peer_engine
  /// throws.
  std::unique_ptr<simulation::Engine> (*make)(const simulation::Experiment& experiment) = nullptr;
  /// The library's world of an experiment that needs nothing which the engine lacks. Null where
  /// this build has no such library.
  std::unique_ptr<PeerWorld> (*make_world)(const simulation::Experiment& experiment,
                                           Settings settings) = nullptr;

  /// Every constant at every setting, as reports print them.
  std::vector<SettingRow> (*settings_table)() = nullptr;
  /// Of its contact rows for an experiment (its settings, step and terrain's material). A
  /// prediction made of these holds as far as the solver converges, so not for few iterations
  /// (docs/reference_engines.md). Null for contacts that are no such rows.
  ConstraintConstants (*constraint_constants)(const simulation::Experiment& experiment) = nullptr;
  /// Velocity of the origin of one body that rests on a plane; no closed form where the experiment
  /// is not one body whose touching points are known (resting_body.h), and where the body turns, so
  /// that its speed changes.
  simulation::ClosedForm<simulation::CreepVelocity> (*creep)(
      const simulation::Experiment& experiment) = nullptr;
  /// Depth per newton of a contact at rest [m/N].
  simulation::ClosedForm<double> (*static_softness)(const simulation::Experiment& experiment) =
      nullptr;
  /// Of an engine with two coefficients of friction, the setting at which it reads the kinetic one
  /// alone; "" for none.
  std::string_view one_friction_setting{};

  /// Whether this build has the library.
  bool found() const { return make_world != nullptr; }
  /// Names that `settings =` accepts, in the order of Settings.
  std::vector<std::string> settings_names() const;
  simulation::EngineDescription describe() const;
};

/// Nothing where the peer has no such setting.
std::optional<Settings> settings_named(std::string_view name, const Peer& peer);
/// The setting of `experiment`. Throws simulation::ExperimentError that lists the names.
Settings settings_of(const simulation::Experiment& experiment, const Peer& peer);

/// Throws simulation::ExperimentError that lists the names where the experiment's is none of them.
void check_settings(const simulation::Experiment& experiment,
                    const simulation::EngineDescription& engine);

/// An engine as make_peer_engine builds it.
struct WorldSource {
  simulation::EngineDescription engine;
  std::function<std::unique_ptr<PeerWorld>(const simulation::Experiment& experiment)> make_world;
};
/// An engine around a world of `source`, with the published state of `experiment` at time 0 and the
/// `notices` already said. Throws simulation::ExperimentError with the words of what make_world
/// throws.
std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     WorldSource source,
                                                     std::vector<std::string> notices);

/// An engine around the peer's world, with the published state of `experiment` at time 0 and the
/// notices of check_supported() already said. The joints' own torques, accelerations, and the named
/// ContactPoints are its work, alike for every library. Throws simulation::ExperimentError where
/// this build has no such library, where the peer has a gap that the experiment needs or has no
/// such setting, and with the library's own words where that throws while the world is built.
std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     const Peer& peer);

/// The same as a function of the experiment alone, for the row itself.
template <const Peer& peer>
std::unique_ptr<simulation::Engine> make_engine(const simulation::Experiment& experiment) {
  return make_peer_engine(experiment, peer);
}

}  // namespace hookpoint::reference
