// Which values of components the sliders of a panel move.
#pragma once

#include <string>
#include <vector>

#include "apps/view/widgets/panel.h"
#include "simulation/analysis/unstable_stretches.h"

namespace hookpoint::view {

struct SliderPath {
  std::string slider;              ///< trail of the port that it sets
  simulation::MovedValue moves{};  ///< what a wire leads from there to, and the slider's range
};

/// Of every Valuator with a range, one a wire that starts there. O(widgets wires).
std::vector<SliderPath> slider_paths(const Panel& panel, const simulation::Experiment& experiment);

}  // namespace hookpoint::view
