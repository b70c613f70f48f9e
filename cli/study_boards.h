// Studies as a page shows them: plans, rows and figures as view's plain values.
#pragma once

#include <cstddef>

#include "application/study_plans.h"
#include "studies/result.h"
#include "view/study_board.h"

namespace hookpoint::cli {

/// With no row run.
view::BoardStudy board_of(const studies::StudyPlan& plan);
/// A row a scene and subject, with how many of its truths hold.
view::BoardStudy board_of(const studies::WallPlan& plan);

/// Of a row that has run.
view::BoardRow board_row(const studies::RunResult& run);
/// `study.plots[plot]`, as the report draws it.
view::BoardFigure board_figure(const studies::StudyResult& study, std::size_t plot);

}  // namespace hookpoint::cli
