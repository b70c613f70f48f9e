// The vertices of a robot's meshes. What lies between them is not needed: a bounding box and a
// convex hull are those of the vertices.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "math/vector3.h"

namespace hookpoint::simulation {

struct MeshPoints {
  std::vector<Vector3d> vertices;  ///< the file's unit and axes
  std::string problem;             ///< what is wrong with the file; "" for a good one
};

/// The file's vertices, each once, in order of x, y, z: STL (binary or ASCII), OBJ or DAE (Collada,
/// its metres and its scene's transforms applied), by the ending of its name. A problem for a file
/// that is none of these, is larger than 100 MB, is broken, or has no vertex, more than 1e7 of them
/// or one beyond 1e6. n log n in the vertices.
MeshPoints read_mesh(const std::filesystem::path& path);

/// The same of a file's bytes, in its own order; vertices may recur.
MeshPoints read_stl(std::string_view bytes);
MeshPoints read_obj(std::string_view bytes);
MeshPoints read_collada(std::string_view bytes);

}  // namespace hookpoint::simulation
