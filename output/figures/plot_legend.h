// Where the legend's entries stand: each as near as possible to the end of its curve.
#pragma once

#include <vector>

#include "output/figures/plot_scale.h"

namespace hookpoint::output {

struct LegendEntry {
  std::size_t series = 0;  ///< index into Plot::series
  double height = 0.;      ///< of the entry's middle, in the unit of `room`
  bool leads = false;      ///< the curve ends in the right half: a line from its end may lead here
  double end_x = 0., end_y = 0.;  ///< where the curve ends, as drawn, in data units
};

/// The stretch for entries: the axes' own from `bottom` to `top`, with `spacing` between entries.
struct LegendRoom {
  double bottom = 0., top = 1., spacing = 0.05;
};

/// One entry a series, from the top to the bottom, no two nearer than the spacing, with the least
/// sum of squared distances from the curves' ends (isotonic regression by pooling adjacent
/// violators). The room must hold all of them.
std::vector<LegendEntry> place_legend(const Plot& plot, const Layout& layout,
                                      const LegendRoom& room);

}  // namespace hookpoint::output
