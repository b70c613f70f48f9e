// The blocks inside a Study, each checked against the others and against the scene's Params.
#pragma once

#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// Fills sweeps, subjects, metrics, truths and plots of `plan`; returns the study's own Fix blocks.
/// Errors go to `diagnostics`.
std::vector<Assignment> plan_parts(StudyPlan& plan, const language::Object& study,
                                   const std::vector<language::ParameterDeclaration>& parameters,
                                   const PlanOptions& options, language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
