// Measure blocks: metrics that there are, and metrics of the user's own; the Expects of the scene
// as metrics besides.
#pragma once

#include <string>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/fields.h"
#include "simulation/run/expectation.h"
#include "studies/measure/scene_names.h"
#include "studies/metrics/user_metric.h"

namespace hookpoint::studies {

struct StudyParts;

/// A Measure block as its file has it.
struct MeasureBlock {
  language::Placed<std::string> over;
  const language::Field* of = nullptr;
  language::Placed<std::string> trace;
  language::Placed<simulation::Reduction> take = simulation::Reduction::last;
  language::Placed<double> from, to;
  language::Placed<std::string> unit;
  language::Placed<double> level, band;
  const language::Field* predicted = nullptr;

  /// Whether the block defines a metric of the user's own.
  bool defines_metric() const { return of != nullptr || trace.given(); }
};

void add_measure_class(language::Schema& schema);
MeasureBlock measure_block(const language::Object& block);

/// Adds a metric to those that are measured. Without `scene`, where it could not be created, one
/// of the user's own has no unit.
void load_measure(const language::Object& block, SceneNames* scene, StudyParts& so_far,
                  language::Diagnostics& diagnostics);
/// Adds a metric that is defined, but for its `key`, `definition` and `index`.
void add_user_metric(UserMetric metric, StudyParts& so_far);
/// Adds those Expects of the scene that hold for a run as long as the study's, with their Truths.
void load_expectations(SceneNames& scene, StudyParts& so_far, language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
