// What figures of every kind ask of a study and a Plot block.
#pragma once

#include <cstddef>
#include <string>

#include "studies/report/figures.h"
#include "studies/results/selection.h"

namespace hookpoint::studies {

/// Whether the row's subject is among the block's `subjects` (all of none are given) and its values
/// among those of `where`.
bool selected(const StudyResult& study, const PlotSpec& spec, const RunResult& row);

/// Sweeps of several values of which the block says nothing: they are no axis, no series, no panels
/// and not fixed by `where`. "azimuth and dt"; "" for none.
std::string undecided_sweeps(const StudyResult& study, const PlotSpec& spec);
/// What `where` fixes, for a figure's subtitle: "mu = 0.8, dt = 1 ms". Without the axes and the
/// panels, which are reported elsewhere.
std::string fixed_values_text(const StudyResult& study, const PlotSpec& spec);

/// The values of the sweep `name` that are drawn: those in `where`, else all.
std::vector<double> drawn_values(const StudyResult& study, const PlotSpec& spec,
                                 const std::string& name);

/// A panel of the block `spec`: the same block with `panels` empty and, in `where`, the panel's own
/// values besides.
struct PanelSpec {
  PlotSpec spec;
  std::string title;  ///< "peak = 0.9, direction = 90 deg"
};
/// Row by row from the top.
std::vector<PanelSpec> panel_specs(const StudyResult& study, const PlotSpec& spec);

/// The figure of a block with a colour: a map over its x and y.
Figure make_map(const StudyResult& study, const PlotSpec& spec);

}  // namespace hookpoint::studies
