// The blocks inside a Study, each checked against the others and against the scene's Params; the
// Subject of a Wall besides.
#pragma once

#include <vector>

#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// What a Subject block says of engine, law, integrator and settings; its Fix and Only blocks are
/// left to the caller.
SubjectPlan subject_of(const language::Object& block);

/// Fills sweeps, subjects, metrics, truths and plots of `plan`; returns the study's own Fix blocks.
/// Errors go to `diagnostics`.
std::vector<Assignment> plan_parts(StudyPlan& plan, const language::Object& study,
                                   const std::vector<language::ParameterDeclaration>& parameters,
                                   const PlanOptions& options, language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
