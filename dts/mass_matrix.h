// The mass matrix M of M v' + h = tau, by composite rigid bodies (Featherstone 2008, table 6.2).
// Coordinates of v: w_WB (3) [rad/s] and v_WB of the base origin (3) [m/s] of a mobile base, world
// axes, then the joint rates, chain by chain (dts/configuration.h).
#pragma once

#include "dts/composite_bodies.h"

namespace hookpoint::dts {

/// M, row by row, velocity_count squared: M_ij = S_i . Ic_j S_j where joint i carries joint j, and
/// I_r more where i is j. The
/// kinetic energy is v.M v / 2. [kg m^2, kg m, kg]. O(links^2).
std::vector<double> mass_matrix(const Model<double>& model, const CompositeBodies& composite);

}  // namespace hookpoint::dts
