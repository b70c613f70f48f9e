// The Table blocks of a study in its report, as HTML.
#pragma once

#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// Each Table under its heading; "" when the study has none.
std::string pivot_tables(const StudyResult& study);

}  // namespace hookpoint::studies
