// What the command line sets in a file.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hookpoint::application {

struct Settings {
  std::vector<std::string> trails;  ///< --set: trail=value
  /// Fields of the file's World with their values: --dt and its like.
  std::vector<std::pair<std::string, std::string>> world;
  bool empty() const { return trails.empty() && world.empty(); }
};

}  // namespace hookpoint::application
