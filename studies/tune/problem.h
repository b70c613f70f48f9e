// What a Tune block requires: what is varied, what is wanted, what is required, and how it is
// searched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/blocks/objective.h"
#include "studies/plan/plan.h"
#include "studies/run/execute.h"
#include "studies/search/optimiser.h"
#include "studies/search/varied_constant.h"

namespace hookpoint::studies {

struct TunePlan {
  std::string name, title, question;
  std::string label;  ///< the name, with the subject's where there are several
  /// What is measured in a run and for how long; it has no rows. Its one subject is the tuned one.
  StudyPlan runs;
  std::vector<VariedConstant> varied;
  std::vector<std::optional<double>> own;  ///< values of the files themselves, one a constant
  std::vector<ObjectivePlan> objectives;
  std::vector<RequirementPlan> requirements;
  SearchMethod method = SearchMethod::nsga2;
  int population = 40, generations = 25, seeds = 4, samples = 32;
  std::uint64_t seed = 1;
  std::shared_ptr<const VariedScene> scene;
  std::string runs_hash;  ///< of all that decides the numbers of a run but its constants and seed

  std::string unit_of(const ObjectivePlan& objective) const;
  /// The unit that its target is written in, else the metric's: what a reader sees.
  std::string shown_unit_of(const ObjectivePlan& objective) const;
  std::string name_of(const ObjectivePlan& objective) const;  ///< the metric's: "sink"
  /// What is made small or great: "foot_slip", "distance of sink from 3 mm".
  std::string label_of(const ObjectivePlan& objective) const;
  std::filesystem::path folder() const { return folder_of(label, runs.hash); }
  std::size_t runs_of_a_generation() const {
    return static_cast<std::size_t>(population) * static_cast<std::size_t>(seeds);
  }
  Measurement measurement() const {
    return {runs.settle, runs.duration, runs.metric_definitions(), {}, false};
  }
  /// What a candidate sets in the scene; of no values nothing.
  std::vector<ConstantSetting> settings(const std::vector<double>& values) const;
};

/// The plans of a Tune block, one a Subject; nothing when `diagnostics` got an error. The library
/// outlives them. Loads the scene with its own constants and at the corners of its ranges.
std::optional<std::vector<TunePlan>> make_tune_plans(const language::Object& root,
                                                     const language::Object& tune,
                                                     const std::string& file,
                                                     language::Library& library,
                                                     const EngineTable& engines, bool quick,
                                                     language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
