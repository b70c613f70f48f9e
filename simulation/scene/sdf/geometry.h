// The <inertial>, <geometry> and <surface> of a link of SDFormat.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "dts/model.h"
#include "simulation/scene/sdf/document.h"
#include "simulation/scene/sdf/sdf.h"

namespace hookpoint::simulation {

/// The number in an element of another, `otherwise` where there is none.
double sdf_number(const XmlElement& parent, const char* name, double otherwise);
/// Three numbers in an element of another, `otherwise` where there are none or after an error.
Vector3d sdf_vector(const XmlElement& parent, const char* name, const Vector3d& otherwise);

/// What an <inertial> gives in the link's frame, with SDFormat's defaults: 1 kg, 1 kg m^2.
dts::MassProperties<double> read_sdf_inertial(const XmlElement& inertial, SdfModel& scope,
                                              const std::string& link, SdfDocument& document);
/// The mass of a link's collisions by their `density` (<inertial auto="true">), link's frame.
dts::MassProperties<double> mass_of_collisions(const XmlElement& of_link, SdfModel& scope,
                                               const std::string& link, SdfDocument& document);

/// A box, sphere, cylinder or capsule; nothing for what is none of these, or after an error.
std::optional<ShapeGeometry> read_sdf_shape(const XmlElement& geometry);

/// The surface of a <collision>; nothing where the file says nothing that counts.
std::optional<SurfaceMaterial> read_sdf_surface(const XmlElement& collision, StatedContact counts,
                                                std::map<std::string, std::size_t>& left_out);
/// Whether it touches anything: `collide_bitmask` is not 0.
bool sdf_touches(const XmlElement& collision);

/// The ground that the geometry of a static collision is, which stands at `X_WC`; nothing where it is
/// neither a plane nor a heightmap, or after an error.
std::optional<SdfGround> read_sdf_ground(const XmlElement& geometry, const Pose& X_WC,
                                         const SdfDocument& document, language::FileStore& files);

}  // namespace hookpoint::simulation
