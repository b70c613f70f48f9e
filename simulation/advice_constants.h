// Laws turned round: the constant with which a law's prediction is what the user wants.
#pragma once

#include <optional>

#include "contact/force_law.h"
#include "simulation/material_fields.h"

namespace hookpoint::simulation {

/// The constant that the law's depth at rest depends on, the one below the nominal depth first;
/// none for a law that reads neither stiffness.
std::optional<MaterialField> stiffness_field(const contact::ForceLaw& law, double load,
                                             const contact::MaterialConstants<double>& material);

/// The constant that the law's rebound depends on; none for a law that reads no damping.
std::optional<MaterialField> damping_field(const contact::ForceLaw& law, double mass, double speed,
                                           const contact::MaterialConstants<double>& material);

/// The value of `field` with which `load` [N] rests `depth` [m] deep.
double stiffness_for_depth(const contact::ForceLaw& law, const MaterialField& field, double load,
                           double depth, contact::MaterialConstants<double> material);

/// The value of `field` with which `mass` [kg] that hits at `speed` [m/s] rebounds with `rebound`
/// of it; 0 when it never rebounds as fast.
double damping_for_rebound(const contact::ForceLaw& law, const MaterialField& field, double mass,
                           double speed, double rebound,
                           contact::MaterialConstants<double> material);

}  // namespace hookpoint::simulation
