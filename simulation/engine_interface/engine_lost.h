// An engine that is a program and has ended, or does not answer.
#pragma once

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// There is no world of the experiment, for a reason that says nothing of the experiment: another try
/// may do.
struct EngineLost : ExperimentError {
  using ExperimentError::ExperimentError;
};

}  // namespace hookpoint::simulation
