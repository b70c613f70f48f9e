#include "reference/peer.h"

#include <algorithm>

#include "simulation/experiment/material_fields.h"

namespace hookpoint::reference {

std::vector<std::string> Peer::settings_names() const {
  std::vector<std::string> names{"default", "recommended", "matched"};
  for (const OwnSetting& own : own_settings) names.emplace_back(own.name);
  return names;
}

simulation::EngineDescription Peer::describe() const {
  // Each world checks by a static_assert that its library runs in double precision.
  simulation::EngineDescription engine{std::string(name), std::string(version), "double", found(),
                                       settings_names(),  common_gaps_and(gaps)};
  if (has_gap(engine, feature::two_frictions)) engine.one_friction = engine.settings;
  if (!one_friction_setting.empty()) engine.one_friction.emplace_back(one_friction_setting);
  for (const std::string& settings : engine.settings) {
    std::vector<std::string>& reads = engine.reads[settings];
    if (settings_named(settings, *this) != Settings::matched) continue;
    for (const auto constant : matched_constants)
      reads.emplace_back(simulation::field_of(constant).name);
  }
  return engine;
}

std::optional<Settings> settings_named(std::string_view name, const Peer& peer) {
  const std::vector<std::string> known = peer.settings_names();
  const auto found = std::ranges::find(known, name);
  if (found == known.end()) return std::nullopt;
  return static_cast<Settings>(found - known.begin());
}

Settings settings_of(const simulation::Experiment& experiment, const Peer& peer) {
  check_settings(experiment, peer.describe());
  return *settings_named(experiment.settings, peer);
}

void check_settings(const simulation::Experiment& experiment,
                    const simulation::EngineDescription& engine) {
  const std::vector<std::string>& known = engine.settings;
  if (std::ranges::find(known, experiment.settings) != known.end()) return;
  std::string choice;
  for (std::size_t i = 0; i < known.size(); ++i)
    choice += (i == 0 ? "" : i + 1 < known.size() ? ", " : " or ") + known[i];
  throw simulation::ExperimentError("engine " + engine.name + " has no settings '" +
                                    experiment.settings + "': choose " + choice);
}

}  // namespace hookpoint::reference
