// An experiment that a program steps.
#pragma once

#include <memory>

#include "reference/peer_engine.h"
#include "reference/process/pool.h"

namespace hookpoint::reference {

/// Throws ProgramError, and simulation::ExperimentError where the program refuses the experiment.
std::unique_ptr<PeerWorld> make_program_world(const simulation::Experiment& experiment,
                                              std::shared_ptr<ProgramPool> pool);

}  // namespace hookpoint::reference
