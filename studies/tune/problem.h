// What a Tune block requires: what is varied, what is wanted, what is required, and how it is
// searched.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/blocks/objective.h"
#include "studies/blocks/written_values.h"
#include "studies/plan/plan.h"
#include "studies/run/execute.h"
#include "studies/search/optimiser.h"
#include "studies/search/varied_constant.h"

namespace hookpoint::studies {

/// An Objective block. What is minimised or maximised is the metric or, where there is a target,
/// minimised the distance of the metric from it in each run, in the metric's unit.
struct ObjectivePlan {
  using Take = SeedsTake;
  std::size_t metric = 0;  ///< index into TunePlan::runs.metrics
  bool maximise = false;
  Take take = Take::mean;
  std::optional<double> target = {};  ///< in the metric's unit
  std::string target_text = {};       ///< as its author wrote it: "3 mm"
  bool may_be_empty = false;          ///< it may judge nothing

  /// What the objective is for a run with this value of the metric.
  double of_run(double value) const { return target ? std::abs(value - *target) : value; }
};

/// A Require block.
struct RequirementPlan {
  std::size_t metric = 0;
  std::optional<double> equals, above, below;
  double within = 0.;
  std::string words;          ///< "stable_step is above 0.5 ms"
  bool may_be_empty = false;  ///< it may judge nothing

  /// How far a value is from what is required, as a part of the bound's magnitude (of 1 where that
  /// is 0); 0 where it holds.
  double missed_by(double value) const;
};

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
  std::string name_of(const ObjectivePlan& objective) const;  ///< the metric's: "sink"
  /// What is made small or great: "foot_slip", "distance of sink from 3 mm".
  std::string label_of(const ObjectivePlan& objective) const;
  std::filesystem::path folder() const { return folder_of(label, runs.hash); }
  std::size_t runs_of_a_generation() const {
    return static_cast<std::size_t>(population) * static_cast<std::size_t>(seeds);
  }
  Measurement measurement() const { return {runs.settle, runs.duration, runs.metrics, {}, false}; }
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
