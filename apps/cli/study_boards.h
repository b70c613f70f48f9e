// Studies as a page shows them: tables, rows and figures as view's plain values.
#pragma once

#include <cstddef>

#include "apps/view/wire/study_board.h"
#include "studies/results/result.h"

namespace hookpoint::cli {

/// Of a table with no row run.
view::BoardStudy board_of(const studies::StudyResult& table);

/// Of a row that has run.
view::BoardRow board_row(const studies::RunResult& run);
/// `study.plots[plot]`, as the report draws it.
view::BoardFigure board_figure(const studies::StudyResult& study, std::size_t plot);

}  // namespace hookpoint::cli
