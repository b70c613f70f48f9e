// From a Plot block and a study's rows to a figure.
#pragma once

#include <string>

#include "output/plot.h"
#include "studies/result.h"

namespace hookpoint::studies {

struct Figure {
  output::Plot plot;
  std::string caption;  ///< what is drawn, what is held fixed and what stands for what
};

/// The figure of `study.plots[plot]`. A subject's colour and marker are those of its number in the
/// study, in every figure. Rows that the block's `where` and axes leave undecided (a sweep that is
/// neither) are condensed to the largest magnitude, and the caption says so. Curves over time are
/// thinned to their envelope, at most about 800 points each.
Figure make_figure(const StudyResult& study, std::size_t plot);

}  // namespace hookpoint::studies
