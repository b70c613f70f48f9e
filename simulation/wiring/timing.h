// Rates and delays of an experiment as the exact fractions that lines and schedules count in.
#pragma once

#include "control/core/transmission_line.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// When the component updates. Throws std::invalid_argument or std::overflow_error.
control::Schedule update_schedule(const ComponentSpec& component, double deltat);

/// The line of `wire`, whose target holds `initial` until the first sample arrives. Its noise is
/// keyed by the experiment's seed and the wire's two trails: other wires do not enter. Throws
/// std::invalid_argument or std::overflow_error.
control::TransmissionLine transmission_line(const WireSpec& wire, const Experiment& experiment,
                                            double initial);

}  // namespace hookpoint::simulation
