// Robots written as MJCF: the file with what it includes and its default classes (document.h),
// bodies and joints in the terms of URDF (read.cpp, geom.cpp), from which the tree and the objects
// of the language come as a URDF's do (urdf/).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "language/syntax/files.h"
#include "language/tree/foreign.h"
#include "simulation/scene/urdf/robot_include.h"

namespace hookpoint::simulation {

struct MjcfChoices {
  UrdfMeshes meshes = UrdfMeshes::skip;
  std::string keyframe;               ///< the name of a <key>; "": the file's zero pose
  language::Position keyframe_place;  ///< of the argument
  UrdfMimic mimic = UrdfMimic::couple;
  UrdfInertia inertia = UrdfInertia::file;
  StatedContact contact = StatedContact::friction;  ///< what of geoms becomes Materials
};

struct MjcfScene {
  std::string name;
  language::Position place;
  std::vector<UrdfRobot> robots;           ///< each free body's, then what hangs on the world
  std::vector<SurfaceMaterial> materials;  ///< of geoms
};

/// Nothing after an error. Linear in the file.
std::optional<MjcfScene> read_mjcf(const language::SourceFile& file, const MjcfChoices& choices,
                                   language::FileStore& files, language::Report& report);

/// The reader of an Include: the robots as objects of the language.
std::vector<language::ForeignObject> include_mjcf(const language::SourceFile& file,
                                                  const language::ForeignArguments& arguments,
                                                  language::FileStore& files,
                                                  language::Report& report);

}  // namespace hookpoint::simulation
