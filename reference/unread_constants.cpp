#include "reference/unread_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "contact/laws/surface_forces.h"
#include "reference/peer.h"
#include "simulation/experiment/material_fields.h"

namespace hookpoint::reference {
namespace {

using Constants = contact::MaterialConstants<double>;
using Constant = double Constants::*;

bool has_a_gap_of_its_own(Constant constant) {
  constexpr std::array told{&Constants::static_friction, &Constants::kinetic_friction,
                            &Constants::restitution};
  return std::ranges::count(told, constant) > 0 ||
         std::ranges::count(contact::surface_constants, constant) > 0;
}

}  // namespace

std::vector<std::string> notices_of_unread_constants(const simulation::Experiment& experiment,
                                                     const Peer& peer) {
  const bool matched = settings_of(experiment, peer) == Settings::matched;
  std::vector<std::string> notices;
  for (const simulation::MaterialSpec& material : experiment.materials) {
    std::vector<Constant> unread, read_when_matched;
    for (const Constant constant : material.meant) {
      if (has_a_gap_of_its_own(constant)) continue;
      const bool soft = std::ranges::count(peer.matched_constants, constant) > 0;
      if (soft && matched) continue;
      unread.push_back(constant);
      if (soft) read_when_matched.push_back(constant);
    }
    if (unread.empty()) continue;
    notices.push_back(fmt::format(
        "engine {}: {} of material '{}' {} not read at `settings = {}`{}", peer.name,
        simulation::quoted_fields(unread), material.name, unread.size() == 1 ? "is" : "are",
        experiment.settings,
        read_when_matched.empty()
            ? ""
            : "; `settings = matched` reads " + simulation::quoted_fields(read_when_matched)));
  }
  return notices;
}

}  // namespace hookpoint::reference
