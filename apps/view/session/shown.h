// What a file says of its windows, at present.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::view {

struct Shown {
  std::string description;           ///< JSON (docs/view_protocol.md)
  std::vector<std::string> trails;   ///< that its widgets read
  std::vector<std::string> plotted;  ///< of these, those that are plotted from the beginning on
  bool holds = false;                ///< a run that plays waits at the duration that its file gives
  std::vector<std::filesystem::path> sources;  ///< the run starts again when one of them is saved
};

}  // namespace hookpoint::view
