#include "reference/peer.h"

#include <algorithm>

namespace hookpoint::reference {

std::vector<std::string> Peer::settings_names() const {
  std::vector<std::string> names{"default", "recommended", "matched"};
  if (!own_setting.name.empty()) names.emplace_back(own_setting.name);
  return names;
}

std::vector<std::string> Peer::one_friction_settings() const {
  if (std::ranges::find(gaps, feature::two_frictions, &OwnGap::feature) != gaps.end())
    return settings_names();
  if (one_friction_setting.empty()) return {};
  return {std::string(one_friction_setting)};
}

simulation::EngineDescription Peer::describe() const {
  // Each world checks by a static_assert that its library runs in double precision.
  return {std::string(name), std::string(version), "double",
          found(),           settings_names(),     common_gaps_and(gaps)};
}

std::optional<Settings> settings_named(std::string_view name, const Peer& peer) {
  const std::vector<std::string> known = peer.settings_names();
  const auto found = std::ranges::find(known, name);
  if (found == known.end()) return std::nullopt;
  return static_cast<Settings>(found - known.begin());
}

Settings settings_of(const simulation::Experiment& experiment, const Peer& peer) {
  if (const auto settings = settings_named(experiment.settings, peer)) return *settings;
  const std::vector<std::string> known = peer.settings_names();
  std::string choice;
  for (std::size_t i = 0; i < known.size(); ++i)
    choice += (i == 0 ? "" : i + 1 < known.size() ? ", " : " or ") + known[i];
  throw simulation::ExperimentError("engine " + std::string(peer.name) + " has no settings '" +
                                    experiment.settings + "': choose " + choice);
}

}  // namespace hookpoint::reference
