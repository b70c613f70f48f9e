// Truth blocks: what a metric must be.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/blocks/only.h"

namespace hookpoint::studies {

struct StudyParts;

struct TruthPlan {
  std::size_t metric = 0;  ///< index into StudyParts::metrics
  bool predicted = false;
  std::optional<double> value, above, below;
  double tolerance = 0., within = 0.;
  int same_over = -1;         ///< index of a sweep
  bool of_scene = false;      ///< an Expect's: each run says what is allowed
  std::vector<int> subjects;  ///< empty: all
  std::vector<Condition> only;
  bool may_be_empty = false;
  std::string name, words;
};

void add_truth_class(language::Schema& schema);

/// Nothing where the study does not measure its metric.
std::optional<TruthPlan> load_truth(const language::Object& block, const StudyParts& so_far,
                                    language::Diagnostics& diagnostics);

/// " within 1 % or 2 mm"; `within` is the text of the latter.
std::string allowed_words(const TruthPlan& truth, const std::string& within);

}  // namespace hookpoint::studies
