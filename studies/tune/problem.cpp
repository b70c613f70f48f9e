#include "studies/tune/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"
#include "output/files/hash.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/engine_interface/step_count.h"
#include "studies/blocks/block.h"
#include "studies/blocks/fix.h"
#include "studies/blocks/measure.h"
#include "studies/blocks/tune.h"
#include "studies/results/selection.h"
#include "studies/search/step_warnings.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// The run's engine and law publish what the metric is of.
void check_ports(const Object& block, const MeasureBlock& measure, SceneNames& names,
                 const simulation::Experiment& experiment, Diagnostics& diagnostics) {
  if (measure.of == nullptr || diagnostics.has_errors()) return;
  for (const std::string& name : measure.of->formula->names) {
    std::string why;
    const auto port = names.port(name, why, &experiment);
    if (port && !port->missing.empty())
      diagnostics.error(block.position,
                        fmt::format("no run has `{}`: {}", block.name, port->missing));
  }
}

/// Reports a Measure whose name another column of evaluations.csv has.
void check_name(const TunePlan& plan, const Object& measure, Diagnostics& diagnostics) {
  static const std::vector<std::string> no_metrics{"evaluation", "stage",     "generation",
                                                   "feasible",   "violation", "first_seed",
                                                   "seeds",      "status"};
  const bool constant =
      std::ranges::find(plan.varied, measure.name, &VariedConstant::name) != plan.varied.end();
  if (constant || language::contains(no_metrics, measure.name))
    diagnostics.error(measure.position,
                      fmt::format("evaluations.csv has another column `{}`: give this metric "
                                  "another name",
                                  measure.name));
}

/// Metrics of the user's own, of ports of the scene `own`.
void add_measures(TunePlan& plan, const Object& tune, const LoadedScene& own,
                  Diagnostics& diagnostics) {
  SceneNames names(*own.tree);
  for (const Object* block : tune.children_of("Measure")) {
    const MetricDefinition* known = find_metric(block->name);
    if (known != nullptr && !check_of_one_run(*block, *known, diagnostics)) continue;
    const MeasureBlock measure = measure_block(*block);
    if (measure.predicted != nullptr)
      diagnostics.error(measure.predicted->position,
                        "a Tune compares nothing with a closed form: leave `predicted` out");
    check_name(plan, *block, diagnostics);
    load_measure(*block, &names, plan.runs, diagnostics);
    check_ports(*block, measure, names, own.experiment, diagnostics);
  }
}

void set_times(TunePlan& plan, const TuneBlock& block, double scene_duration) {
  const RunTimes times = load_times(block, plan.runs.quick, scene_duration);
  plan.runs.settle = times.settle;
  plan.runs.duration = *times.duration;
}

void set_search(TunePlan& plan, const TuneBlock& block) {
  plan.method = *block.method == "cmaes" ? SearchMethod::cmaes : SearchMethod::nsga2;
  plan.population = *block.population;
  plan.generations = block.generations;
  plan.seeds = block.seeds;
  plan.samples = block.samples;
  plan.seed = block.seed;
}

void check_search(const TunePlan& plan, const Object& tune, const TuneBlock& block, double deltat,
                  Diagnostics& diagnostics) {
  if (plan.varied.empty() && tune.children_of("Vary").empty())
    diagnostics.error(tune.position, "a Tune needs a Vary: nothing is to be tuned");
  if (plan.objectives.empty() && tune.children_of("Objective").empty())
    diagnostics.error(tune.position, "a Tune needs an Objective: nothing is wanted");
  if (plan.method == SearchMethod::cmaes && plan.objectives.size() > 1)
    diagnostics.error(block.method.position_or(tune.position),
                      "cmaes takes one Objective; nsga2 takes several, and Require what must hold");
  if (plan.method == SearchMethod::nsga2 && plan.population % 4 != 0)
    diagnostics.error(block.population.position_or(tune.position),
                      "nsga2 pairs its candidates: a multiple of 4");
  const auto& said = block.duration ? block.duration : block.quick_duration;
  std::string problem = simulation::step_count_problem(plan.runs.duration, deltat);
  if (problem.empty()) problem = simulation::no_step_problem(plan.runs.duration, deltat);
  if (!problem.empty()) diagnostics.error(said.position_or(tune.position), problem);
  if (plan.runs.settle >= plan.runs.duration)
    diagnostics.error(block.settle.position_or(tune.position),
                      "settle must be shorter than the duration: nothing would be measured");
}

/// A Tune sweeps nothing.
void refuse_only(const Object* owner, Diagnostics& diagnostics) {
  if (owner == nullptr) return;
  for (const Object* only : owner->children_of("Only"))
    diagnostics.error(only->position, "a Tune sweeps nothing: there is no Only here");
}

/// Loads the scene with every constant at the end `share` of its range. False after errors.
bool check_corner(const TunePlan& plan, const Object& tune, double share,
                  Diagnostics& diagnostics) {
  std::vector<double> values;
  values.reserve(plan.varied.size());
  for (const VariedConstant& constant : plan.varied) values.push_back(constant.at(share));
  Diagnostics found;
  const auto scene = plan.scene->load(plan.settings(values), 1, found);
  report_at_ends(found, plan.varied, *plan.scene, share == 1., diagnostics);
  const std::string where =
      std::string("with every constant at its ") + (share == 0. ? "least" : "greatest") + " value";
  if (scene)
    warn_of_step(scene->experiment, tune.position, where, diagnostics);
  else
    diagnostics.note(tune.position, where);
  return scene.has_value();
}

/// A constant that changes nothing is a mistake, as a Param is that another ground leaves unused.
/// Tried at a few places of its range, the others having their own values or lying in theirs.
void check_effects(const TunePlan& plan, const Object& tune, Diagnostics& diagnostics) {
  // Irregular: an even or a periodic function has not the same value at all of them.
  constexpr std::array places{1., 0.37, 0.61, 0.13, 0.5, 0.83, 0.249, 0.731};
  constexpr std::array<std::optional<double>, 3> places_of_others{std::nullopt, 0.29, 0.67};
  const std::vector<VariedConstant>& constants = plan.varied;
  const auto text_at = [&](std::size_t varied, double place, std::optional<double> others) {
    std::vector<ConstantSetting> settings;
    for (std::size_t i = 0; i < constants.size(); ++i)
      if (i == varied || others)
        settings.push_back(constants[i].setting(constants[i].at(i == varied ? place : *others)));
    Diagnostics unreported;
    const auto tree = plan.scene->compose(settings, 1, unreported);
    return tree == nullptr ? std::string() : language::print(*tree);
  };
  const auto blocks = tune.children_of("Vary");
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const bool changes = std::ranges::any_of(places_of_others, [&](const auto& others) {
      const std::string least = text_at(i, 0., others);
      return std::ranges::any_of(places,
                                 [&](double place) { return text_at(i, place, others) != least; });
    });
    if (!changes)
      diagnostics.error(blocks[i]->position,
                        fmt::format("`{}` changes nothing in the scene", constants[i].name));
  }
}

void set_hashes(TunePlan& plan, const LoadedScene& own, const EngineTable& engines) {
  StudyPlan& runs = plan.runs;
  const std::set<std::string> inputs = own.sources();
  runs.scene_printed = own.printed();
  output::Hash hash;
  hash.add(own.hash());
  hash.add(fmt::format("{} {}", runs.settle, runs.duration));
  for (const MetricDefinition* metric : runs.metric_definitions()) hash.add(kept_name(*metric));
  for (const output::InputFile& input : simulation::hashed(inputs)) hash.add(input.hash);
  plan.runs_hash = simulation::run_hash(hash.text(), engines.describe(own.experiment.engine));
  runs.hash = output::Hash()
                  .add(runs.printed)
                  .add(plan.label)
                  .add(hash.text())
                  .add(runs.quick ? "quick" : "")
                  .text();
  runs.inputs = simulation::hashed(inputs);
}

std::optional<TunePlan> make_tune_plan(const Object& root, const Object& tune,
                                       const Object* subject, bool several, const std::string& file,
                                       language::Library& library, const EngineTable& engines,
                                       bool quick, Diagnostics& diagnostics) {
  TunePlan plan;
  plan.name = tune.name;
  const TuneBlock block = load_tune(tune, quick);
  plan.title = block.title;
  plan.question = block.question;
  SubjectPlan settings = subject == nullptr ? SubjectPlan{} : subject_of(*subject);
  plan.label = tune.name + (several ? "_" + settings.info.name : "");
  plan.runs.name = plan.label;
  plan.runs.file = file;
  plan.runs.quick = quick;
  plan.runs.printed = language::print(root);
  SceneSource source = scene_source(tune, block, subject, settings, file, library, diagnostics);
  refuse_only(&tune, diagnostics);
  refuse_only(subject, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.scene =
      std::make_shared<const VariedScene>(library, std::move(source), tune.position, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  const auto own = plan.scene->load({}, 1, diagnostics);
  if (!own) return std::nullopt;
  warn_of_step(own->experiment, tune.position, "", diagnostics);
  set_times(plan, block, own->experiment.duration);
  for (const Object* vary : tune.children_of("Vary"))
    if (auto constant = varied_constant(*vary, *plan.scene, diagnostics))
      plan.varied.push_back(std::move(*constant));
  refuse_fixed(tune, plan.varied, diagnostics);
  if (subject != nullptr) refuse_fixed(*subject, plan.varied, diagnostics);
  add_measures(plan, tune, *own, diagnostics);
  for (const Object* child : tune.children_of("Objective"))
    if (auto objective = load_objective(*child, plan.runs, diagnostics))
      plan.objectives.push_back(std::move(*objective));
  for (const Object* child : tune.children_of("Require"))
    if (auto requirement = load_requirement(*child, plan.runs, diagnostics))
      plan.requirements.push_back(std::move(*requirement));
  set_search(plan, block);
  check_search(plan, tune, block, own->experiment.deltat, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  for (const double share : {0., 1.})
    if (!check_corner(plan, tune, share, diagnostics)) return std::nullopt;
  check_effects(plan, tune, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  for (const VariedConstant& constant : plan.varied) {
    const auto value = plan.scene->own_value(constant.setting(constant.from));
    plan.own.push_back(value ? std::optional(to_six_digits(constant.unit.from_si(*value)))
                             : std::nullopt);
  }
  settings.info = composition_of(own->experiment, engines, settings.info.name);
  plan.runs.subjects.push_back(std::move(settings));
  set_hashes(plan, *own, engines);
  return plan;
}

}  // namespace

std::string TunePlan::shown_unit_of(const ObjectivePlan& objective) const {
  return objective.written_unit.empty() ? unit_of(objective) : objective.written_unit;
}

std::string TunePlan::unit_of(const ObjectivePlan& objective) const {
  return std::string(runs.metrics[objective.metric].definition->unit);
}

std::string TunePlan::name_of(const ObjectivePlan& objective) const {
  return std::string(runs.metrics[objective.metric].definition->name);
}

std::string TunePlan::label_of(const ObjectivePlan& objective) const {
  const std::string metric = name_of(objective);
  return objective.target ? fmt::format("distance of {} from {}", metric, objective.target_text)
                          : metric;
}

std::vector<ConstantSetting> TunePlan::settings(const std::vector<double>& values) const {
  return settings_of(varied, values);
}

std::optional<std::vector<TunePlan>> make_tune_plans(const Object& root, const Object& tune,
                                                     const std::string& file,
                                                     language::Library& library,
                                                     const EngineTable& engines, bool quick,
                                                     Diagnostics& diagnostics) {
  std::vector<const Object*> subjects = tune.children_of("Subject");
  const bool several = subjects.size() > 1;
  if (subjects.empty()) subjects.push_back(nullptr);
  std::vector<TunePlan> plans;
  for (const Object* subject : subjects) {
    auto plan =
        make_tune_plan(root, tune, subject, several, file, library, engines, quick, diagnostics);
    if (!plan) return std::nullopt;
    plans.push_back(std::move(*plan));
  }
  return plans;
}

}  // namespace hookpoint::studies
