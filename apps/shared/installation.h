// Where the program's own files are: beside it when it is installed, wherever that was moved; else
// in the source tree that it was built from.
#pragma once

#include <filesystem>

namespace hookpoint::application {

struct Installation {
  std::filesystem::path configs;  ///< materials, robots, scenes to include
  std::filesystem::path plugins;  ///< trusted; "" when the program is not installed
};

/// Of the running program.
Installation find_installation();

}  // namespace hookpoint::application
