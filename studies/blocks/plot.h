// Plot blocks, with their References: what is drawn over what.
#pragma once

#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/blocks/only.h"
#include "studies/measure/metric.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct StudyParts;

struct PlotPlan {
  PlotSpec spec;
  const SignalDefinition* signal = nullptr;  ///< over time
  std::vector<Condition> only;
};

void add_plot_class(language::Schema& schema);
void add_reference_class(language::Schema& schema);

PlotPlan load_plot(const language::Object& block, const StudyParts& so_far,
                   language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
