// A robot's file by itself: URDF, MJCF, or a module of the language that holds a Robot and no World.
#pragma once

#include <filesystem>

#include "apps/shared/application.h"

namespace hookpoint::application {

/// The file to evaluate for `file`: itself, or, if it holds robots and no World, one of the same folder that
/// `application` is given, in which they stand on a plane as an Include reads them: in the keyframe `home`
/// if there is one, joints held, meshes by their hulls where those are found; a note on stderr has that
/// Include. A robot on a fixed base has no ground. What is wrong with `file` is left for its evaluation to report.
std::filesystem::path with_a_world(Application& application, const std::filesystem::path& file,
                                   bool allow_plugins);

}  // namespace hookpoint::application
