// What a peer refuses, in one voice: every gap is named, with what to change.
#pragma once

#include <string_view>

#include "simulation/engine.h"
#include "simulation/experiment.h"

namespace hookpoint::reference {

/// Throws ExperimentError when `experiment` holds what no peer of this folder runs yet: chains,
/// materials of single tiles, a mobile body without mass or, on a terrain, without shapes, two
/// coefficients of friction.
void check_supported(const simulation::Experiment& experiment, std::string_view engine);

/// The ground's material; the constants' defaults where there is no terrain.
contact::MaterialConstants<double> ground_material(const simulation::Experiment& experiment);

}  // namespace hookpoint::reference
