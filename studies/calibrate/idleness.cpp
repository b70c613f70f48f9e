#include "studies/calibrate/idleness.h"

#include <algorithm>
#include <cstddef>

namespace hookpoint::studies {
namespace {

bool traces_may_be_empty(const CalibrationPlan& plan) {
  return std::ranges::all_of(plan.cases, [](const CalibrationCase& one) {
    return std::ranges::all_of(one.traces, &TracePlan::may_be_empty);
  });
}

}  // namespace

std::vector<IdleBlock> idle_blocks(const CalibrationPlan& plan, const CalibrationResult& result) {
  std::vector<IdleBlock> blocks;
  const bool any_fitted = std::ranges::any_of(
      result.subjects, [](const SubjectCalibration& found) { return found.error.has_value(); });
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    const CalibrationSubject& subject = plan.subjects[i];
    const SubjectCalibration& found = result.subjects[i];
    const auto add = [&](const char* kind, Idle idle, const std::string& why) {
      blocks.push_back({kind, subject.info.name, {idle, why}});
    };
    if (!found.error) {
      const bool cannot_run = !subject.info.available || !subject.refusal.empty();
      add("Subject", cannot_run && any_fitted ? Idle::left_out : Idle::fault,
          found.status == "ok" ? std::string("it has no fit") : found.status);
      continue;
    }
    if (!plan.varied.empty() && found.constants.empty())
      add("Subject", traces_may_be_empty(plan) ? Idle::allowed : Idle::fault,
          "none of the constants changes a trace: vary one that its law or engine reads");
    const bool held_out = std::ranges::any_of(
        found.folds, [](const FoldResult& fold) { return fold.held.has_value(); });
    if (!found.folds.empty() && !held_out)
      add("Fold", Idle::fault, "no held-out case has an error");
  }
  return blocks;
}

}  // namespace hookpoint::studies
