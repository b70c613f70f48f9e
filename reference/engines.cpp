#include "reference/engines.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/bullet/engine.h"
#include "reference/dart/engine.h"
#include "reference/mujoco/engine.h"
#include "reference/ode/engine.h"
#include "reference/simbody/engine.h"

namespace hookpoint::reference {

std::span<const Peer> known_peers() {
  static const std::array all{
      ode_peer,            // one matrix of all constraints, Dantzig's method
      ode_quickstep_peer,  // the same, iterated
      bullet_peer,         // sequential impulses
      mujoco_peer,         // soft constraints, a convex problem
      dart_peer,           // a boxed linear complementarity problem
      simbody_peer,        // compliant contact, an integrator of its own
  };
  return all;
}

std::span<const Peer> peers() {
  static const std::vector<Peer> found = [] {
    std::vector<Peer> result;
    std::ranges::copy_if(known_peers(), std::back_inserter(result), &Peer::found);
    return result;
  }();
  return found;
}

const Peer& peer_named(std::string_view name) {
  const auto found = std::ranges::find(known_peers(), name, &Peer::name);
  if (found != known_peers().end()) return *found;
  throw std::invalid_argument("no peer called '" + std::string(name) + "'");
}

simulation::PeerChoices peer_choices() {
  simulation::PeerChoices choices;
  for (const Peer& peer : known_peers()) {
    choices.engines.emplace_back(peer.name);
    for (const OwnSetting& own : peer.own_settings)
      choices.settings.push_back({std::string(own.name), std::string(own.doc)});
  }
  return choices;
}

}  // namespace hookpoint::reference
