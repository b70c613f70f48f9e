// The mesh that a robot's file names, and what it becomes of a link that it is part of.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/urdf.h"
#include "simulation/scene/urdf/xml.h"

namespace hookpoint::simulation {

/// The vertices of the mesh that the file `robot` names `filename` (mesh_path.h), each once, read once
/// for all; null after an error at `at`.
const MeshPoints* find_mesh(const std::string& filename, const language::Position& at,
                            const std::filesystem::path& robot, language::FileStore& files,
                            UrdfXml& xml);

/// Adds to `link` the bounding box, or the outermost vertices of the hull, of a mesh that stands at
/// `X_LS`, its coordinates times `scale`, with the surface `material`; what of it is not taken to
/// `left_out`.
void add_mesh(std::span<const Vector3d> vertices, const Vector3d& scale, UrdfMeshes as,
              const Pose& X_LS, const language::Position& place, const std::string& material,
              UrdfLink& link, std::map<std::string, std::size_t>& left_out);

}  // namespace hookpoint::simulation
