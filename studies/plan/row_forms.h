// What the user's own definitions say of one run before it starts.
#pragma once

#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// One a metric of the user's, in their order: the closed form, from the constants of `tree` and
/// the words that names hold in the row, and what the run's engine or law lacks of the ports that
/// it is of. `tree`, `experiment`: of the row. Empty without such metrics. Cost: linear in the
/// tree.
std::vector<RowForm> row_forms(const StudyPlan& plan, const RowPlan& row,
                               const language::Object& tree,
                               const simulation::Experiment& experiment);

}  // namespace hookpoint::studies
