// What a base and a link share: the fields and ports of a body. For the files of the load step
// alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "language/tree/fields.h"

namespace hookpoint::simulation {

using language::FieldSchema;

/// Fields of a body's mass that more than one file works on.
namespace mass_field {
inline constexpr const char *mass = "mass", *center_of_mass = "center_of_mass",
                            *inertia = "inertia";
}

/// What is wrong with an inertia, "" if some distribution of mass has it: "has a negative principal
/// moment".
std::string inertia_problem(const Symmetric3d& inertia);
/// Mass properties; `axes` are those of "base" or "link".
std::vector<FieldSchema> mass_fields(const std::string& axes);
/// What gives a Shape, or an Obstacle, of that kind its dimensions: "Box".
std::vector<FieldSchema> geometry_fields(std::string_view kind);
/// The material of what touches: of a Shape, a ContactPoint, or as the default of a body's. `whose`
/// follows "of its surface".
FieldSchema foot_material_field(const std::string& whose);
inline constexpr const char* of_its_shapes =
    ", for its shapes and ContactPoints that name none of their own";
/// What every body publishes of its contact with the ground.
std::vector<FieldSchema> contact_ports();
/// What bodies do to the terrain or to an obstacle.
std::vector<FieldSchema> surface_contact_ports();
/// How a body's velocities change, for whom `body` is.
std::vector<FieldSchema> acceleration_ports(const std::string& body);
/// The motion of a body that moves with others: read only. `position` is the name of its place.
std::vector<FieldSchema> motion_ports(const std::string& position, const std::string& body);

}  // namespace hookpoint::simulation
