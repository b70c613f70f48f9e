// Laws turned round: the constant with which a law's prediction is what the user wants.
#pragma once

#include <optional>
#include <string_view>

#include "contact/force_law.h"
#include "simulation/experiment/material_fields.h"

namespace hookpoint::simulation {

/// The field of that name. Throws std::logic_error for a name that there is not.
MaterialField field_named(std::string_view name);

/// The constant that the law's depth at rest depends on: of `nominal` the stiffness below the
/// nominal depth, of `exponential` the rate.
std::optional<MaterialField> stiffness_field(const contact::LawDescription& law);

/// The constant that the law's rebound depends on; none for a law that reads no damping.
std::optional<MaterialField> damping_field(const contact::LawDescription& law);

/// The value of `field` with which `load` [N] rests `depth` [m] deep.
double stiffness_for_depth(const contact::LawDescription& law, const MaterialField& field,
                           double load, double depth, contact::MaterialConstants<double> material);

/// Whether a point on the tile, not inside the ground, is carried with more than `share` of `load`
/// [N]: the body then hovers, or nearly so. Only a law that acts above the tile does that.
bool carries_above_ground(const contact::LawDescription& law, double load, double share,
                          const contact::MaterialConstants<double>& material);

/// Force and rate of an exponential spring with which `load` [N] rests `depth` [m] deep and the
/// tile carries `share` of it.
contact::MaterialConstants<double> exponential_for_depth(
    double load, double depth, double share, contact::MaterialConstants<double> material);

/// The value of `field` with which `mass` [kg] that hits at `speed` [m/s] rebounds with `rebound`
/// of it; 0 when it never rebounds as fast.
double damping_for_rebound(const contact::LawDescription& law, const MaterialField& field,
                           double mass, double speed, double rebound,
                           contact::MaterialConstants<double> material);

}  // namespace hookpoint::simulation
