// What a reader cannot see of a figure, in words for its caption.
#pragma once

#include <string>
#include <vector>

#include "output/figures/plot.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

/// Curves that lie on one another in every panel, so that one marker hides the others: those with
/// the same x whose y differ by less than a marker's width, a hundredth of the axis. "" for none.
std::string coinciding_note(const std::vector<output::Plot>& panels);

/// That all which is drawn is zero, and why where the signal is of motion along the ground; ""
/// where it is not.
std::string vanishing_note(const PlotSpec& spec, const std::vector<output::Plot>& panels);

/// That points stand at the left edge because a logarithmic axis has no place for their x; "" where
/// none does.
std::string edge_note(const std::vector<output::Plot>& panels);

}  // namespace hookpoint::studies
