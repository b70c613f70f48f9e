#include "studies/tune/idleness.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace hookpoint::studies {
namespace {

Idleness idleness_of_objective(const TunePlan& plan, const TuneResult& result,
                               const ObjectivePlan& objective) {
  std::optional<double> first;
  std::size_t with_value = 0;
  for (const Candidate& candidate : result.candidates) {
    const std::optional<double> value = value_of(objective, candidate);
    if (!value) continue;
    ++with_value;
    if (first && *value != *first) return {};
    first = value;
  }
  if (!first) return {Idle::fault, "no candidate has a value of " + plan.name_of(objective)};
  if (with_value == 1) return {};
  return {Idle::fault,
          "the same for every candidate: no varied constant changes it. Vary a "
          "constant that the subject's law or engine reads, or choose another metric"};
}

Idleness idleness_of_requirement(const TunePlan& plan, const TuneResult& result,
                                 const RequirementPlan& required) {
  const bool judged = std::ranges::any_of(result.candidates, [&](const Candidate& candidate) {
    return values_of_seeds(candidate, required.metric).has_value();
  });
  if (judged) return {};
  return {Idle::fault, "no candidate has a value of " +
                           std::string(plan.runs.metrics[required.metric].definition->name)};
}

}  // namespace

std::vector<IdleBlock> idle_blocks(const TunePlan& plan, const TuneResult& result) {
  std::vector<IdleBlock> blocks;
  if (result.candidates.empty()) return blocks;
  const auto add = [&](const char* kind, const std::string& name, bool may_be_empty,
                       Idleness idleness) {
    if (idleness.idle != Idle::no)
      blocks.push_back({kind, name, allowed_by(may_be_empty, std::move(idleness))});
  };
  for (const ObjectivePlan& objective : plan.objectives)
    add("Objective", plan.name_of(objective), objective.may_be_empty,
        idleness_of_objective(plan, result, objective));
  for (const RequirementPlan& required : plan.requirements)
    add("Require", std::string(plan.runs.metrics[required.metric].definition->name),
        required.may_be_empty, idleness_of_requirement(plan, result, required));
  return blocks;
}

}  // namespace hookpoint::studies
