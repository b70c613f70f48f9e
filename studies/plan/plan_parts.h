// The blocks inside a Study in the order in which they are loaded: each is checked against those
// before it and against the scene.
#pragma once

#include <filesystem>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// Fills sweeps, subjects, metrics, truths, plots and fixes of `plan`, whose library, file, only,
/// quick and scene_parameters are set. `scene`: its file. Errors go to `diagnostics`.
void plan_parts(StudyPlan& plan, const language::Object& study, const std::filesystem::path& scene,
                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
