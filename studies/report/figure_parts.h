// What figures of every kind ask of a study and a Plot block.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "studies/report/figures.h"

namespace hookpoint::studies {

std::optional<std::size_t> sweep_index(const StudyResult& study, const std::string& name);
std::optional<std::size_t> metric_index(const StudyResult& study, const std::string& name);

/// Whether two values of a sweep are one.
bool same(double a, double b);
/// Whether the row has one of the values of each sweep.
bool admits(const StudyResult& study, const SweepValues& where, const RunResult& row);
/// Whether the block's `subjects` and `where` let the row in.
bool selected(const StudyResult& study, const PlotSpec& spec, const RunResult& row);

/// "azimuth, dt": sweeps that neither an axis, a series, panels nor `where` decides and that take
/// several values.
std::string undecided(const StudyResult& study, const PlotSpec& spec);
/// "mu = 0.8, dt = 1 ms": what `where` fixes.
std::string fixed_text(const StudyResult& study, const PlotSpec& spec);

/// The values of a sweep that `where` lets in.
std::vector<double> drawn_values(const StudyResult& study, const PlotSpec& spec,
                                 const std::string& name);

/// A block for each panel: `where` has the panel's values besides, and nothing else is left to say
/// of them. Row by row from the top.
struct PanelSpec {
  PlotSpec spec;
  std::string title;  ///< "peak = 0.9, direction = 90 deg"
};
std::vector<PanelSpec> panel_specs(const StudyResult& study, const PlotSpec& spec);

/// The figure of a block with a colour: a map over its x and y.
Figure make_map(const StudyResult& study, const PlotSpec& spec);

}  // namespace hookpoint::studies
