// What a file says of its windows, at present.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/view/widgets/slider_paths.h"

namespace hookpoint::view {

struct Shown {
  std::string description;           ///< JSON (docs/view_protocol.md)
  std::vector<std::string> trails;   ///< that its widgets read
  std::vector<std::string> plotted;  ///< of these, those that are plotted from the beginning on
  std::vector<SliderPath> sliders;   ///< of a run: those whose marks a page may request
  bool holds = false;                ///< a run that plays waits at the duration that its file gives
  std::vector<std::filesystem::path> sources;  ///< the run starts again when one of them is saved
};

}  // namespace hookpoint::view
