// Closed forms of how far a peer's contact gives way under a load that rests on it.
#pragma once

#include <optional>

#include "simulation/experiment.h"

namespace hookpoint::reference {

/// Depth per newton of a contact at rest [m/N]. At `matched` every peer has the material's spring,
/// 1/k; MuJoCo only while its impedance is not cut off (`mujoco_row`). ODE's dWorldStep at
/// `default`: of J v = ERP d/dt - CFM f the rest, d = CFM dt f/ERP. Nothing otherwise.
std::optional<double> static_softness(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
