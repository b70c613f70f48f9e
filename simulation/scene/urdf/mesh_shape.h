// What a mesh becomes of a link that it is part of.
#pragma once

#include <map>
#include <span>
#include <string>

#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

/// Adds to `link` the bounding box, or the outermost vertices of the hull, of a mesh that stands at
/// `X_LS`, its coordinates times `scale`; what of it is not taken to `left_out`.
void add_mesh(std::span<const Vector3d> vertices, const Vector3d& scale, UrdfMeshes as,
              const Pose& X_LS, const language::Position& place, UrdfLink& link,
              std::map<std::string, std::size_t>& left_out);

}  // namespace hookpoint::simulation
