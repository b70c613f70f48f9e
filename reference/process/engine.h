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

  /// As the program says it, which is started for that once. One that may not be started, or does
  /// not start, is not found, and `missing` says why.
  simulation::EngineDescription describe() const;
  /// Throws simulation::ExperimentError with what the program, or the protocol, lacks.
  std::unique_ptr<simulation::Engine> make(const simulation::Experiment& experiment) const;
  const ProgramDefinition& definition() const;

 private:
  std::shared_ptr<ProgramPool> pool_;
};

}  // namespace hookpoint::reference
