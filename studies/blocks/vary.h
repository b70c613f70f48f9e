// Vary blocks: constants that are searched for, each within a range.
#pragma once

#include <string>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/blocks/written_values.h"

namespace hookpoint::studies {

/// Both ends in the unit that the block writes, tidied.
struct VaryRange {
  WrittenUnit unit;
  double from = 0., to = 1.;
  bool logarithmic = false;
  language::Position from_place, to_place;
};

void add_vary_class(language::Schema& schema);

/// Errors for a range that is empty, of two units, or on a log scale not above 0.
VaryRange load_vary(const language::Object& block, language::Diagnostics& diagnostics);
/// Errors where an end is not of that dimension.
void check_varied(const language::Object& block, const language::Dimension& wanted,
                  const std::string& problem, language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
