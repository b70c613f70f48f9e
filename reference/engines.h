// The peers by name.
#pragma once

#include <span>
#include <string_view>

#include "reference/peer.h"
#include "simulation/scene/peer_choices.h"

namespace hookpoint::reference {

/// Every peer of this folder, in the order of its documentation.
std::span<const Peer> known_peers();
/// Those whose library this build has; the others describe themselves as not found.
std::span<const Peer> peers();
/// The peer of that name. Throws std::invalid_argument on another one.
const Peer& peer_named(std::string_view name);

/// What a World may say of them all.
simulation::PeerChoices peer_choices();

}  // namespace hookpoint::reference
