// What the names of a study hold in one of its runs, and what the user's own definitions say of it
// before it starts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// By name; strings without their quotes.
using SceneWords = std::map<std::string, std::string>;

/// Those of the row, whose `scene` is set: of the Sweeps; of the Params of the scene and its ground
/// that the study sets or whose default is a word, a string, or the name of a Param that is one.
/// Thread-safe. Cost: linear in the Params.
SceneWords words_of(const StudyPlan& plan, const RowPlan& row);

/// One a metric of the user's, in their order: the closed form, from the constants of `tree` and
/// the words that names hold in the row, and what the run's engine or law lacks of the ports that
/// it is of. `tree`, `experiment`: of the row. Empty without such metrics. Cost: linear in the
/// tree.
std::vector<RowForm> row_forms(const StudyPlan& plan, const RowPlan& row,
                               const language::Object& tree,
                               const simulation::Experiment& experiment);

}  // namespace hookpoint::studies
