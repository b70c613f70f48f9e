// Where the axes begin and end, their ticks, and the strips for values that have no place on them.
#pragma once

#include <string>
#include <vector>

#include "output/figures/plot.h"

namespace hookpoint::output {

/// One axis, resolved against the data. `low` and `high` bound the scale proper; the strips lie
/// outside.
struct Scale {
  bool logarithmic = false;
  double floor = 0.;
  double low = 0., high = 1.;              ///< of the scale
  double range_low = 0., range_high = 1.;  ///< of the drawing, strips included
  std::string ticks;                       ///< gnuplot's list: ('10^{-3}' 1e-3, ...)

  /// A number between the bottom (0) and the top (1) of the drawing, in data units.
  double at(double fraction) const;
  /// Where a data value stands in the drawing, 0 to 1.
  double fraction(double value) const;
  bool below_floor(double value) const;
};

/// Which series need a lane in a strip: indices into Plot::series.
struct Strips {
  std::vector<int> below_floor;
  std::vector<int> unfinished;
};

struct Layout {
  Scale x, y;
  Strips strips;
  /// Where a series' lane lies, in data units of y; `lane` counts within its strip.
  double floor_lane(int lane) const;
  double unfinished_lane(int lane) const;
};

Layout lay_out(const Plot& plot);

/// Share of the drawing's height that a strip of so many lanes takes.
double strip_height(std::size_t lanes);

}  // namespace hookpoint::output
