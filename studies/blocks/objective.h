// Objective blocks: what a Tune makes small or great; and Require blocks: what it may not leave.
#pragma once

#include "language/schema/schema.h"
#include "studies/blocks/block.h"

namespace hookpoint::studies {

/// Statistic of the values with each seed.
enum class SeedsTake { mean, worst };

/// An Objective block as its file has it.
struct ObjectiveBlock {
  SeedsTake take = SeedsTake::mean;
  Placed<double> target;
  bool minimise = false, maximise = false;
  bool may_be_empty = false;
};
/// A Require block as its file has it.
struct RequireBlock {
  Placed<double> equals, within, above, below;
  bool may_be_empty = false;
};

/// With `minimise` and `maximise`.
void add_objective_classes(language::Schema& schema);
void add_require_class(language::Schema& schema);

ObjectiveBlock objective_block(const language::Object& block);
RequireBlock require_block(const language::Object& block);

}  // namespace hookpoint::studies
