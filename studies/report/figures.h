// From a Plot block and a study's rows to a figure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/figures/heat_map.h"
#include "output/figures/plot.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct Figure {
  output::Plot plot;
  std::optional<output::HeatMap> map;       ///< instead of `plot`, which then has only its name
  std::optional<output::PanelPlot> panels;  ///< likewise
  std::string caption;  ///< what is drawn, what is held fixed and what stands for what
};

/// The output::Series::style of each subject: the colour is its family's (its law, or the engine of
/// a peer; its integrator where all have one law; its own where they have one integrator too), the
/// marker tells members of a family apart. No two are the same. Families without a run, or whose engine is not there, take their colours last.
std::vector<int> subject_styles(const StudyResult& study);

/// The figure of `study.plots[plot]`. A subject looks the same in every figure. Rows that the
/// block's `where` and axes leave undecided (a sweep that is neither) are condensed to the largest
/// magnitude, and the caption says so. Curves over time are thinned to their envelope, at most
/// about 800 points each.
Figure make_figure(const StudyResult& study, std::size_t plot);

}  // namespace hookpoint::studies
