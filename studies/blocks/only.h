// Only blocks: some values of what is swept, or some rows of a table of cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/fields.h"

namespace hookpoint::studies {

struct StudyParts;

/// An `Only` block as its file has it.
struct OnlyBlock {
  const language::Field* values = nullptr;
  language::Placed<double> from, to;  ///< SI
};

void add_only_class(language::Schema& schema);
OnlyBlock only_block(const language::Object& block);

/// An `Only` block: some values of a swept Param.
struct Condition {
  int sweep = 0;
  /// SI; none: any within the bounds. Empty where --quick leaves out all that it names.
  std::optional<std::vector<double>> values;
  std::optional<double> from, to;  ///< SI
  bool holds(double value) const;
};

/// The Only blocks of a part of a Study. Errors for Sweeps and values that there are not.
std::vector<Condition> load_conditions(const language::Object& owner, const StudyParts& so_far,
                                       language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
