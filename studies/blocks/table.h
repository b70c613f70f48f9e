// Table blocks: a metric over two of what the study varied.
#pragma once

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct StudyParts;

void add_table_class(language::Schema& schema);

TableSpec load_table(const language::Object& block, const StudyParts& so_far,
                     language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
