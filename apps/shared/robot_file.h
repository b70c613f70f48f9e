// A robot's file by itself: URDF, MJCF, or a module of the language that holds a Robot and no World.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/shared/application.h"

namespace hookpoint::application {

/// A file that is not on disk, beside the robot's.
struct RobotWorld {
  std::filesystem::path file;
  std::string text;
  std::string
      note;  ///< that there is no World in the robot's file, and with which Include it got one
};

/// What of the joints of a robot's file: held by springs, to be looked at, or as the file has them.
enum class RobotJoints { held, as_written };

/// The world in which the robots of `file` stand on a plane, as an Include reads them: in the keyframe `home`
/// if there is one, meshes by their hulls where those are found. A robot on a fixed base has no ground. None for a file with a World, and for one that is wrong,
/// which its evaluation reports. `application`: for files that it has read. Cost: a few evaluations of the file.
std::optional<RobotWorld> world_of_robot(Application& application,
                                         const std::filesystem::path& file, Consent consent,
                                         RobotJoints joints = RobotJoints::held);

/// The file to evaluate: `file`, or the world of its robots, which `application` has from then on and of
/// which it reports the note.
std::filesystem::path file_with_world(Application& application, const std::filesystem::path& file,
                                      Consent consent, RobotJoints joints = RobotJoints::held);

}  // namespace hookpoint::application
