// Robots and worlds written as SDFormat, of Gazebo: the file with the models that it includes and their
// frames (document.h), what is in a link (geometry.h), links and joints in the terms of URDF (read.cpp),
// from which the tree and the objects of the language come as a URDF's do (urdf/). What is static
// becomes the ground and obstacles.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "language/syntax/files.h"
#include "language/tree/foreign.h"
#include "simulation/scene/urdf/robot_include.h"

namespace hookpoint::simulation {

/// A collision of a static model: an obstacle, where it stands in the world.
struct SdfSolid {
  std::string name;
  UrdfShape shape;
};

/// A static plane or grid of heights: the ground.
struct SdfGround {
  std::string name, material;
  language::Position place;
  Vector3d point, normal{0., 0., 1.};  ///< of a plane [m]
  /// Of a grid: its file, the distance of its vertices, the world's x and y of the corner of least x
  /// and y, the heights of black and white [m].
  std::string file;
  double spacing = 0., origin_x = 0., origin_y = 0., low = 0., high = 0.;
};

struct SdfScene {
  language::Position place;
  std::vector<UrdfRobot> robots;  ///< each with a link "world" first
  std::vector<SdfSolid> solids;
  std::optional<SdfGround> ground;
  std::vector<SurfaceMaterial> materials;
  std::map<std::string, std::size_t> left_out;
};

/// Nothing after an error. Linear in the file, and n log n in the vertices of its meshes.
std::optional<SdfScene> read_sdf(const language::SourceFile& file, const UrdfChoices& choices,
                                 language::FileStore& files, language::Report& report);

/// The reader of an Include: robots, ground, obstacles and materials as objects of the language.
std::vector<language::ForeignObject> include_sdf(const language::SourceFile& file,
                                                 const language::ForeignArguments& arguments,
                                                 language::FileStore& files,
                                                 language::Report& report);

}  // namespace hookpoint::simulation
