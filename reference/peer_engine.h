// The step of every peer: advance the library's world, read it, refuse what is not finite, publish.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/engine.h"

namespace hookpoint::reference {

/// One library's world. Body i is the base of robot i.
class PeerWorld {
 public:
  virtual ~PeerWorld() = default;
  /// Advances by one step under `forces`, one a ForceSpec of the experiment. Empty on success, else
  /// the library's trouble in a few words.
  virtual std::string advance(const std::vector<simulation::ForceInput>& forces) = 0;
  /// What the user should know of the step just taken, else empty. Said once.
  virtual std::string notice() { return {}; }
  /// Writes the motion and last contact force of every body; fixed bodies are left as they are.
  /// After a failure too: what is not finite then tells which body it was.
  virtual void read(std::vector<simulation::BodyState>& bodies) const = 0;
};

/// An engine around `world`, with the published state of `experiment` at time 0.
std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     std::unique_ptr<PeerWorld> world);

}  // namespace hookpoint::reference
