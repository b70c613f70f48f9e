// A Wall for the eye: a page and a table of the terminal.
#pragma once

#include <optional>
#include <string>

#include "output/latex/latex.h"
#include "studies/compare/wall.h"
#include "studies/report/report.h"
#include "studies/report/terminal_table.h"

namespace hookpoint::studies {

/// One self-contained page: scenes and their truths down, subjects across; each cell what was
/// measured, how far from the closed form, and whether that is allowed. `card`: the drawing of
/// score_card(), before the table. Pure.
std::string wall_html(const WallResult& wall, const ReportContext& context,
                      const std::optional<ReportFigure>& card = {});

/// A line a truth: the closed form, how many subjects meet it and the largest error; then what does
/// not hold, and the counts.
std::string wall_terminal_table(const WallResult& wall, const TableStyle& style);

/// The same lines as LaTeX.
output::LatexTable latex_wall_table(const WallResult& wall);

}  // namespace hookpoint::studies
