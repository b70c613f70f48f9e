// Inertias of robots' files that no distribution of mass has, and the nearest ones that some has.
#pragma once

#include <string>
#include <vector>

#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

/// Checks the inertia of `link`, whose mass is known, or repairs it (docs/urdf.md#inertias); what was
/// changed goes to `repaired`. Result: "" or what is wrong with it.
std::string settle_inertia(UrdfInertia choice, UrdfLink& link, std::vector<std::string>& repaired);

/// The inertia of a ball of water of that mass [kg], one moment about each axis [kg m^2].
double compact_inertia(double mass);

}  // namespace hookpoint::simulation
