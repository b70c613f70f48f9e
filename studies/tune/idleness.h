// Objectives and Requires of a tuning that judged nothing, with the reason of each.
#pragma once

#include <vector>

#include "studies/results/idleness.h"
#include "studies/tune/tune.h"

namespace hookpoint::studies {

/// Objectives without a value or with the same value for every candidate, and Requires without a
/// value, over the candidates that ran. O(candidates x (objectives + requirements)).
std::vector<IdleBlock> idle_blocks(const TunePlan& plan, const TuneResult& result);

}  // namespace hookpoint::studies
