// report.html of a tuning: what came out, why, and how much better it is.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/report/report.h"
#include "studies/tune/tune.h"

namespace hookpoint::studies {

/// One self-contained page. Pure: the same arguments give the same bytes.
std::string tune_html(const TunePlan& plan, const TuneResult& result, const ReportContext& context,
                      const std::vector<ReportFigure>& figures);

/// For the terminal: the recommended constants, each objective beside the references', and what
/// does not hold.
std::string tune_terminal_text(const TunePlan& plan, const TuneResult& result);

}  // namespace hookpoint::studies
