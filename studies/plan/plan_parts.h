// The blocks inside a Study, each checked against the others and against the scene's Params; the
// Subject of a Wall besides.
#pragma once

#include <filesystem>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// What a Subject block says of engine, law, integrator and settings; its Fix and Only blocks are
/// left to the caller.
SubjectPlan subject_of(const language::Object& block);

/// Fills sweeps, subjects, metrics, truths, plots and fixes of `plan`, whose library, file and
/// scene_parameters are set. `scene`: its file. Errors go to `diagnostics`.
void plan_parts(StudyPlan& plan, const language::Object& study, const std::filesystem::path& scene,
                const PlanOptions& options, language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
