#include "apps/view/widgets/slider_paths.h"

namespace hookpoint::view {
namespace {

/// A range so wide that equal ways are equal factors (spansDecades of page/numbers.ts).
bool spans_decades(const Range& range) {
  constexpr double decades = 1000. * (1. - 1e-12);
  return range[0] > 0. && range[1] >= decades * range[0];
}

void collect(const Widget& widget, const simulation::Experiment& experiment,
             std::vector<SliderPath>& paths) {
  if (const auto* frame = std::get_if<Frame>(&widget.content))
    for (const Widget& child : frame->children) collect(child, experiment, paths);
  const auto* valuator = std::get_if<Valuator>(&widget.content);
  if (valuator == nullptr || !valuator->range) return;
  const Range& range = *valuator->range;
  for (const simulation::WireSpec& wire : experiment.wires)
    if (wire.from == valuator->port.trail)
      paths.push_back({wire.from, {wire.to, {range[0], range[1]}, spans_decades(range)}});
}

}  // namespace

std::vector<SliderPath> slider_paths(const Panel& panel, const simulation::Experiment& experiment) {
  std::vector<SliderPath> paths;
  for (const Widget& widget : panel.windows) collect(widget, experiment, paths);
  return paths;
}

}  // namespace hookpoint::view
