// The words that names stand for in one run of a study: what its Sweeps over words say, and what
// Params of the scene hold.
#pragma once

#include <map>
#include <string>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// By name; strings without their quotes.
using SceneWords = std::map<std::string, std::string>;

/// Those of the row, whose `scene` is set: of the Sweeps; of the Params of the scene and its ground
/// that the study sets or whose default is a word, a string, or the name of a Param that is one.
/// Thread-safe. Cost: linear in the Params.
SceneWords words_of(const StudyPlan& plan, const RowPlan& row);

}  // namespace hookpoint::studies
