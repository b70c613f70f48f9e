// An engine that is a program, beside the rows of linked libraries (peer.h).
#pragma once

#include <memory>

#include "reference/process/definition.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

class ProgramPool;

/// Copies share the processes: one serves many runs, one after the other. Thread-safe.
class ProgramEngine {
 public:
  explicit ProgramEngine(ProgramDefinition definition);

  /// From the program's hello message; the first call starts the program (50-300 ms), later ones copy.
  /// Where it may not or does not start, `found` is false and `missing` the reason.
  simulation::EngineDescription describe() const;
  /// Throws simulation::ExperimentError where the program or the protocol cannot run the experiment.
  std::unique_ptr<simulation::Engine> make(const simulation::Experiment& experiment) const;
  const ProgramDefinition& definition() const;

 private:
  std::shared_ptr<ProgramPool> pool_;
};

}  // namespace hookpoint::reference
