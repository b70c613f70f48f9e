// Cases blocks: runs that were measured, as an axis of the study, with the curves of each.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/measure/scene_names.h"
#include "studies/measurements/trace_plan.h"

namespace hookpoint::studies {

struct StudyParts;

/// A Trace of the study's Cases.
struct MeasuredCurves {
  std::string name;
  std::vector<std::string> ports;  ///< trails as the study writes them, one a part
  std::vector<std::shared_ptr<const TracePlan>> cases;  ///< weights are 1
};

void add_cases_class(language::Schema& schema);

/// Adds the axis and its table's rows.
void load_cases(const language::Object& block, StudyParts& so_far,
                language::Diagnostics& diagnostics);
/// Adds what the Traces of the study's Cases have measured, and how long a study without a
/// `duration` runs. Without `scene`, where it could not be created, no trace is read.
void load_curves(const language::Object& study, SceneNames* scene, StudyParts& so_far,
                 language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
