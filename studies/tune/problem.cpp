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
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// Turns the blocks of a Tune into the parts of its plan.
class TuneBuilder {
 public:
  TuneBuilder(TunePlan& plan, Diagnostics& diagnostics) : plan_(plan), diagnostics_(diagnostics) {}

  void add_constant(const Object& block) {
    if (auto constant = varied_constant(block, *plan_.scene, diagnostics_))
      plan_.varied.push_back(std::move(*constant));
  }

  /// Metrics of the user's own, of ports of the scene `own`.
  void add_measures(const Object& tune, const LoadedScene& own) {
    SceneNames names(*own.tree);
    for (const Object* block : tune.children_of("Measure")) {
      const MetricDefinition* known = find_metric(block->name);
      if (known != nullptr && !is_of_one_run(*block, *known)) continue;
      const MeasureBlock measure = measure_block(*block);
      if (measure.predicted != nullptr)
        error(measure.predicted->position,
              "a Tune compares nothing with a closed form: leave `predicted` out");
      load_measure(*block, &names, plan_.runs, diagnostics_);
      check_ports(*block, measure, names, own.experiment);
      check_from(measure);
    }
  }

  void add_objective(const Object& object) {
    const auto metric = metric_of(object);
    if (!metric) return;
    const ObjectiveBlock block = objective_block(object);
    ObjectivePlan objective{*metric, block.maximise, block.take};
    objective.target = number(block.target, *metric);
    if (block.minimise + block.maximise + objective.target.has_value() != 1)
      error(object.position, "an Objective says one of `minimise;`, `maximise;` and `target = `");
    if (objective.target) objective.target_text = written_text(block.target, *metric);
    objective.may_be_empty = block.may_be_empty;
    plan_.objectives.push_back(std::move(objective));
  }

  void add_requirement(const Object& object) {
    const auto metric = metric_of(object);
    if (!metric) return;
    const RequireBlock block = require_block(object);
    RequirementPlan require;
    require.metric = *metric;
    require.equals = number(block.equals, *metric);
    require.above = number(block.above, *metric);
    require.below = number(block.below, *metric);
    require.within = number(block.within, *metric).value_or(0.);
    if (!require.equals && !require.above && !require.below)
      error(object.position, "a Require says `equals`, `above` or `below`");
    require.words = object.name + " " + words_of(block, require);
    require.may_be_empty = block.may_be_empty;
    plan_.requirements.push_back(std::move(require));
  }

 private:
  void error(const language::Position& position, std::string message) {
    diagnostics_.error(position, std::move(message));
  }

  bool is_of_one_run(const Object& block, const MetricDefinition& metric) {
    if (metric.scope == MetricScope::run) return true;
    error(block.position, fmt::format("`{}` is {}: a tuning takes metrics of one run", block.name,
                                      metric.timing() ? "a time, which is never the same twice"
                                                      : "of several runs together"));
    return false;
  }

  /// The run's engine and law publish what the metric is of.
  void check_ports(const Object& block, const MeasureBlock& measure, SceneNames& names,
                   const simulation::Experiment& experiment) {
    if (measure.of == nullptr || diagnostics_.has_errors()) return;
    for (const std::string& name : measure.of->formula->names) {
      std::string why;
      const auto port = names.port(name, why, &experiment);
      if (port && !port->missing.empty())
        error(block.position, fmt::format("no run has `{}`: {}", block.name, port->missing));
    }
  }

  /// A run lasts until the Measure begins.
  void check_from(const MeasureBlock& block) {
    if (!block.from || *block.from < plan_.runs.duration) return;
    error(block.from.position(),
          fmt::format("a run ends at {} s{}: nothing would be measured from {} s on",
                      text::rounded(plan_.runs.duration, 6),
                      plan_.runs.quick ? " under --quick (`quick_duration`)" : "",
                      text::rounded(*block.from, 6)));
  }

  /// Its index among the metrics of a run.
  std::optional<std::size_t> metric_of(const Object& block) {
    auto& metrics = plan_.runs.metrics;
    const auto found = std::ranges::find(metrics, block.name, &MetricDefinition::name);
    if (found != metrics.end()) return static_cast<std::size_t>(found - metrics.begin());
    const MetricDefinition* metric = find_metric(block.name);
    if (metric == nullptr) {
      std::vector<std::string> names;
      for (const MetricDefinition* own : metrics) names.emplace_back(own->name);
      for (const MetricDefinition& known : metric_table()) names.emplace_back(known.name);
      error(block.position,
            fmt::format("no metric is called `{}` (a Measure defines one of your own){}",
                        block.name, language::did_you_mean(block.name, names)));
      return std::nullopt;
    }
    if (!is_of_one_run(block, *metric)) return std::nullopt;
    metrics.push_back(metric);
    plan_.runs.metric_sweeps.push_back(-1);
    return metrics.size() - 1;
  }

  /// What the field holds, in the metric's unit.
  std::optional<double> number(const language::Placed<double>& field, std::size_t metric) {
    if (!field) return std::nullopt;
    return number_in(*field.field, plan_.runs.metrics[metric]->unit, diagnostics_);
  }

  /// The number in the unit that the file writes, else in the metric's.
  std::string written_text(const language::Placed<double>& field, std::size_t metric) const {
    WrittenUnit unit = written_unit(*field.field);
    if (unit.text.empty()) {
      unit.text = plan_.runs.metrics[metric]->unit;
      unit.unit = language::parse_unit(unit.text).value_or(language::Unit{});
    }
    return text::rounded(unit.from_si(*field), 6) + (unit.text.empty() ? "" : " " + unit.text);
  }

  /// "is above 0.5 ms", in the units that the block writes.
  std::string words_of(const RequireBlock& block, const RequirementPlan& require) const {
    const auto value = [&](const language::Placed<double>& field) {
      return written_text(field, require.metric);
    };
    std::vector<std::string> parts;
    if (require.equals)
      parts.push_back("equals " + value(block.equals) +
                      (require.within > 0. ? " within " + value(block.within) : ""));
    if (require.above) parts.push_back("is above " + value(block.above));
    if (require.below) parts.push_back("is below " + value(block.below));
    return language::join(parts, " and ");
  }

  TunePlan& plan_;
  Diagnostics& diagnostics_;
};

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
  if (plan.varied.empty())
    diagnostics.error(tune.position, "a Tune needs a Vary: nothing is to be tuned");
  if (plan.objectives.empty())
    diagnostics.error(tune.position, "a Tune needs an Objective: nothing is wanted");
  if (plan.method == SearchMethod::cmaes && plan.objectives.size() > 1)
    diagnostics.error(block.method.position_or(tune.position),
                      "cmaes takes one Objective; nsga2 takes several, and Require what must hold");
  if (plan.method == SearchMethod::nsga2 && plan.population % 4 != 0)
    diagnostics.error(block.population.position_or(tune.position),
                      "nsga2 pairs its candidates: a multiple of 4");
  const auto& said = block.duration ? block.duration : block.quick_duration;
  if (const std::string problem = simulation::step_count_problem(plan.runs.duration, deltat);
      !problem.empty())
    diagnostics.error(said.position_or(tune.position), problem);
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
  const auto scene = plan.scene->load(plan.settings(values), 1, diagnostics);
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
  for (const MetricDefinition* metric : runs.metrics) hash.add(kept_name(*metric));
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
  TuneBuilder builder(plan, diagnostics);
  for (const Object* vary : tune.children_of("Vary")) builder.add_constant(*vary);
  builder.add_measures(tune, *own);
  for (const Object* objective : tune.children_of("Objective")) builder.add_objective(*objective);
  for (const Object* require : tune.children_of("Require")) builder.add_requirement(*require);
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

double RequirementPlan::missed_by(double value) const {
  double missed = 0.;
  const auto add = [&](double distance, double bound) {
    if (distance > 0.) missed += distance / (bound == 0. ? 1. : std::abs(bound));
  };
  if (equals) add(std::abs(value - *equals) - within, *equals);
  // A bound itself does not do: `above` means greater.
  const auto strictly = [&](double distance, double bound) {
    add(distance == 0. ? 1e-9 * (bound == 0. ? 1. : std::abs(bound)) : distance, bound);
  };
  if (above) strictly(*above - value, *above);
  if (below) strictly(value - *below, *below);
  return missed;
}

std::string TunePlan::unit_of(const ObjectivePlan& objective) const {
  return std::string(runs.metrics[objective.metric]->unit);
}

std::string TunePlan::name_of(const ObjectivePlan& objective) const {
  return std::string(runs.metrics[objective.metric]->name);
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
