// A world's state as bytes that know what they are of: what evolves, bit for bit, with a hash of
// the experiment and a checksum.
#pragma once

#include <string>
#include <string_view>

#include "simulation/run/world.h"

namespace hookpoint::simulation {

class StateBytes {
 public:
  /// `text`: the experiment as printed. Hashes the files that it reads. Throws output::FileError,
  /// and ExperimentError for an engine that cannot be saved.
  StateBytes(const std::string& text, const Experiment& experiment, const World& world);

  /// Of `world`, one of that experiment. O(state).
  std::string of(const World& world) const;
  /// Puts `world`, one of that experiment, to the state that `bytes` hold; it continues bit for bit
  /// as the one that was saved. Throws ExperimentError, with the world as it was, where they are no
  /// state, damaged, or of another experiment.
  void restore(std::string_view bytes, World& world) const;

 private:
  std::string identity_;  ///< of the experiment and of what its numbers are
};

}  // namespace hookpoint::simulation
