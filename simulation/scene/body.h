// What a base and a link share: the fields and ports of a body. For the files of the load step
// alone.
#pragma once

#include <string>
#include <vector>

#include "simulation/scene/fields.h"

namespace hookpoint::simulation {

/// Fields of a body's mass that more than one file works on.
namespace mass_field {
inline constexpr const char *mass = "mass", *center_of_mass = "center_of_mass",
                            *inertia = "inertia";
}

/// Mass properties; `axes` are those of "base" or "link".
std::vector<FieldSchema> mass_fields(const std::string& axes);
/// What every body publishes of its contact with the ground.
std::vector<FieldSchema> contact_ports();
/// How a body's velocities change, for whom `body` is.
std::vector<FieldSchema> acceleration_ports(const std::string& body);
/// The motion of a body that moves with others: read only. `position` is the name of its place.
std::vector<FieldSchema> motion_ports(const std::string& position, const std::string& body);

}  // namespace hookpoint::simulation
