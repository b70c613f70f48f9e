// One pair of axes with its strips and curves, as gnuplot's commands.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "output/figures/plot.h"
#include "output/figures/plot_scale.h"

namespace hookpoint::output {

/// Whether a line goes from point to point: a dense curve does, and one without a closed form.
bool joined(const Series& series);

/// Names of the axes that are written.
struct AxisTitles {
  bool x = true, y = true;
};

/// Draws `plot` from the rows of `<name>.csv` that begin with row `first_row` after the header;
/// returns the row after its last.
std::size_t write_axes(std::ostream& out, const Plot& plot, const Layout& layout,
                       const std::string& name, std::size_t first_row, AxisTitles titles);

}  // namespace hookpoint::output
