#include "studies/tune/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "language/names.h"
#include "output/text/hash.h"
#include "output/text/number.h"
#include "simulation/identity.h"
#include "simulation/step_count.h"
#include "studies/plan/plan_builder.h"
#include "studies/plan/plan_parts.h"
#include "studies/run/execute.h"
#include "studies/tune/step_warnings.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// What --quick leaves of a search.
constexpr int quick_population = 8, quick_generations = 3, quick_seeds = 2, quick_samples = 0;

double to_six_digits(double value) {
  char digits[32];
  const auto written =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 5);
  std::from_chars(digits, written.ptr, value);
  return value;
}

/// Turns the blocks of a Tune into the parts of its plan.
class TuneBuilder {
 public:
  TuneBuilder(TunePlan& plan, Diagnostics& diagnostics) : plan_(plan), diagnostics_(diagnostics) {}

  void add_constant(const Object& block) {
    if (auto constant = varied_constant(block, *plan_.scene, diagnostics_))
      plan_.varied.push_back(std::move(*constant));
  }

  /// Metrics of the user's own, of ports of the scene `own`.
  void add_measures(const Object& tune, const TunedScene& own) {
    SceneNames names(*own.tree);
    const PlanOptions options;
    PlanBuilder builder(plan_.runs, options, diagnostics_);
    builder.know(&names);
    for (const Object* block : tune.children_of("Measure")) {
      const MetricDefinition* known = find_metric(block->name);
      if (known != nullptr && !is_of_one_run(*block, *known)) continue;
      if (block->given("predicted"))
        error(block->find("predicted")->position,
              "a Tune compares nothing with a closed form: leave `predicted` out");
      builder.add_metric(*block);
      check_ports(*block, names, own.experiment);
      check_from(*block);
    }
  }

  void add_objective(const Object& block) {
    const auto metric = metric_of(block);
    if (!metric) return;
    const bool less = !block.children_of("minimise").empty();
    const bool more = !block.children_of("maximise").empty();
    ObjectivePlan objective{
        *metric, more,
        block.word("take") == "worst" ? ObjectivePlan::Take::worst : ObjectivePlan::Take::mean};
    objective.target = number(block, "target", *metric);
    if (less + more + objective.target.has_value() != 1)
      error(block.position, "an Objective says one of `minimise;`, `maximise;` and `target = `");
    if (objective.target) objective.target_text = written_text(*block.find("target"), *metric);
    plan_.objectives.push_back(std::move(objective));
  }

  void add_requirement(const Object& block) {
    const auto metric = metric_of(block);
    if (!metric) return;
    RequirementPlan require;
    require.metric = *metric;
    require.equals = number(block, "equals", *metric);
    require.above = number(block, "above", *metric);
    require.below = number(block, "below", *metric);
    require.within = number(block, "within", *metric).value_or(0.);
    if (!require.equals && !require.above && !require.below)
      error(block.position, "a Require says `equals`, `above` or `below`");
    require.words = words_of(block, require);
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
  void check_ports(const Object& block, SceneNames& names,
                   const simulation::Experiment& experiment) {
    const language::Field* of = block.find("of");
    if (of == nullptr || diagnostics_.has_errors()) return;
    for (const std::string& name : of->formula->names) {
      std::string why;
      const auto port = names.port(name, why, &experiment);
      if (port && !port->missing.empty())
        error(block.position, fmt::format("no run has `{}`: {}", block.name, port->missing));
    }
  }

  /// A run lasts until the Measure begins.
  void check_from(const Object& block) {
    if (!block.given("from") || block.number("from") < plan_.runs.duration) return;
    error(block.find("from")->position,
          fmt::format("a run ends at {} s{}: nothing would be measured from {} s on",
                      output::rounded(plan_.runs.duration, 6),
                      plan_.runs.quick ? " under --quick (`quick_duration`)" : "",
                      output::rounded(block.number("from"), 6)));
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
  std::optional<double> number(const Object& block, const char* name, std::size_t metric) {
    const language::Field* given = block.find(name);
    if (given == nullptr) return std::nullopt;
    const auto unit = language::parse_unit(plan_.runs.metrics[metric]->unit);
    if (unit && !language::fits(given->dimension, unit->dimension))
      error(given->position, fmt::format("`{}` is in {}, not {}", name,
                                         language::describe_dimension(unit->dimension),
                                         language::describe_dimension(given->dimension)));
    return block.number(name) * (unit ? unit->denominator / unit->numerator : 1.);
  }

  /// The number in the unit that the file writes, else in the metric's.
  std::string written_text(const language::Field& field, std::size_t metric) const {
    WrittenUnit unit = written_unit(field);
    if (unit.text.empty()) {
      unit.text = plan_.runs.metrics[metric]->unit;
      unit.unit = language::parse_unit(unit.text).value_or(language::Unit{});
    }
    return output::rounded(unit.from_si(field.numbers.at(0)), 6) +
           (unit.text.empty() ? "" : " " + unit.text);
  }

  /// "stable_step is above 0.5 ms", in the units that the block writes.
  std::string words_of(const Object& block, const RequirementPlan& require) const {
    const auto value = [&](const char* field) {
      return written_text(*block.find(field), require.metric);
    };
    std::vector<std::string> parts;
    if (require.equals)
      parts.push_back("equals " + value("equals") +
                      (require.within > 0. ? " within " + value("within") : ""));
    if (require.above) parts.push_back("is above " + value("above"));
    if (require.below) parts.push_back("is below " + value("below"));
    return block.name + " " + language::join(parts, " and ");
  }

  TunePlan& plan_;
  Diagnostics& diagnostics_;
};

void set_times(TunePlan& plan, const Object& tune, bool quick, double scene_duration) {
  constexpr double quick_part = 0.2;
  StudyPlan& runs = plan.runs;
  runs.duration = tune.given("duration") ? tune.number("duration") : scene_duration;
  runs.settle = tune.number("settle");
  if (!quick) return;
  runs.duration =
      tune.given("quick_duration") ? tune.number("quick_duration") : quick_part * runs.duration;
  runs.settle = tune.given("quick_settle") ? tune.number("quick_settle") : quick_part * runs.settle;
}

void set_search(TunePlan& plan, const Object& tune, bool quick) {
  const auto whole = [&](const char* field) { return static_cast<int>(tune.number(field)); };
  plan.method = tune.word("method") == "cmaes" ? SearchMethod::cmaes : SearchMethod::nsga2;
  plan.population = whole("population");
  plan.generations = whole("generations");
  plan.seeds = whole("seeds");
  plan.samples = whole("samples");
  plan.seed = static_cast<std::uint64_t>(tune.number("seed"));
  if (!quick) return;
  plan.population = std::min(plan.population, quick_population);
  plan.generations = std::min(plan.generations, quick_generations);
  plan.seeds = std::min(plan.seeds, quick_seeds);
  plan.samples = std::min(plan.samples, quick_samples);
}

void check_search(const TunePlan& plan, const Object& tune, double deltat,
                  Diagnostics& diagnostics) {
  if (plan.varied.empty())
    diagnostics.error(tune.position, "a Tune needs a Vary: nothing is to be tuned");
  if (plan.objectives.empty())
    diagnostics.error(tune.position, "a Tune needs an Objective: nothing is wanted");
  const auto at = [&](const char* field) {
    return tune.given(field) ? tune.find(field)->position : tune.position;
  };
  if (plan.method == SearchMethod::cmaes && plan.objectives.size() > 1)
    diagnostics.error(at("method"),
                      "cmaes takes one Objective; nsga2 takes several, and Require what must hold");
  if (plan.method == SearchMethod::nsga2 && plan.population % 4 != 0)
    diagnostics.error(at("population"), "nsga2 pairs its candidates: a multiple of 4");
  if (const std::string problem = simulation::step_count_problem(plan.runs.duration, deltat);
      !problem.empty())
    diagnostics.error(
        at(tune.given("quick_duration") && !tune.given("duration") ? "quick_duration" : "duration"),
        problem);
  if (plan.runs.settle >= plan.runs.duration)
    diagnostics.error(at("settle"),
                      "settle must be shorter than the duration: nothing would be measured");
}

std::filesystem::path find_file(const Object& tune, const char* field, const std::string& file,
                                const language::Library& library, Diagnostics& diagnostics) {
  if (!tune.given(field)) return {};
  const std::filesystem::path found = library.find(tune.word(field), file);
  if (found.empty())
    diagnostics.error(tune.find(field)->position,
                      "no file \"" + tune.word(field) + "\" beside the Tune or in configs/");
  return found;
}

SceneSource source_of(const Object& tune, const Object* subject, const SubjectPlan& settings,
                      const std::string& file, const language::Library& library,
                      Diagnostics& diagnostics) {
  SceneSource source;
  source.scene = find_file(tune, "scene", file, library, diagnostics);
  source.terrain = find_file(tune, "terrain", file, library, diagnostics);
  if (tune.given("material")) source.material = tune.word("material");
  for (const Object* owner : {&tune, subject}) {
    if (owner == nullptr) continue;
    for (const Object* fix : owner->children_of("Fix"))
      source.settled.push_back(
          {ConstantPlace::scene_parameter, fix->name, text_of(*fix->find("value"))});
    for (const Object* only : owner->children_of("Only"))
      diagnostics.error(only->position, "a Tune sweeps nothing: there is no Only here");
  }
  const auto set = [&](const char* field, const std::string& value) {
    if (!value.empty()) source.world.emplace_back(field, value);
  };
  set("contact", settings.contact);
  set("integrator", settings.integrator);
  set("engine", settings.engine);
  set("settings", settings.settings);
  return source;
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
    Diagnostics untold;
    const auto tree = plan.scene->compose(settings, 1, untold);
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

void set_hashes(TunePlan& plan, const TunedScene& own, const EngineTable& engines) {
  StudyPlan& runs = plan.runs;
  std::set<std::string> inputs = simulation::files_read(own.experiment);
  for (std::string& source : language::sources_of(*own.tree)) inputs.insert(std::move(source));
  runs.scene_printed = language::print(*own.tree);
  output::Hash hash;
  hash.add(simulation::experiment_hash(runs.scene_printed, own.experiment));
  hash.add(fmt::format("{} {}", runs.settle, runs.duration));
  for (const MetricDefinition* metric : runs.metrics) hash.add(kept_name(*metric));
  for (const output::InputFile& input : simulation::hashed(inputs)) hash.add(input.hash);
  const auto engine = engines.find(own.experiment.engine);
  plan.runs_hash = simulation::run_hash(
      hash.text(), engine == engines.end()
                       ? simulation::EngineDescription{own.experiment.engine, {}, {}, false, {}}
                       : engine->second.description);
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
  if (tune.given("title")) plan.title = tune.word("title");
  if (tune.given("question")) plan.question = tune.word("question");
  SubjectPlan settings = subject == nullptr ? SubjectPlan{} : subject_of(*subject);
  plan.label = tune.name + (several ? "_" + settings.info.name : "");
  plan.runs.name = plan.label;
  plan.runs.file = file;
  plan.runs.quick = quick;
  plan.runs.printed = language::print(root);
  SceneSource source = source_of(tune, subject, settings, file, library, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.scene =
      std::make_shared<const TuneScene>(library, std::move(source), tune.position, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  const auto own = plan.scene->load({}, 1, diagnostics);
  if (!own) return std::nullopt;
  warn_of_step(own->experiment, tune.position, "", diagnostics);
  set_times(plan, tune, quick, own->experiment.duration);
  TuneBuilder builder(plan, diagnostics);
  for (const Object* block : tune.children_of("Vary")) builder.add_constant(*block);
  builder.add_measures(tune, *own);
  for (const Object* block : tune.children_of("Objective")) builder.add_objective(*block);
  for (const Object* block : tune.children_of("Require")) builder.add_requirement(*block);
  set_search(plan, tune, quick);
  check_search(plan, tune, own->experiment.deltat, diagnostics);
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
  complete_subject(settings.info, own->experiment, engines);
  plan.runs.subjects.push_back(std::move(settings));
  set_hashes(plan, *own, engines);
  return plan;
}

}  // namespace

std::optional<VariedConstant> varied_constant(const Object& block, const TuneScene& scene,
                                              Diagnostics& diagnostics) {
  const auto place = scene.place_of(block.name);
  if (!place) {
    diagnostics.error(block.position,
                      fmt::format("neither the terrain nor the scene has a Param `{}`, nor "
                                  "their Material or World a number of that name{}",
                                  block.name, language::did_you_mean(block.name, scene.names())));
    return std::nullopt;
  }
  VariedConstant constant = varied_range(block, diagnostics);
  constant.place = *place;
  return constant;
}

VariedConstant varied_range(const Object& block, Diagnostics& diagnostics) {
  VariedConstant constant{
      block.name, ConstantPlace::scene_parameter, written_unit(*block.find("from")), 0., 1., false};
  if (!language::fits(block.find("to")->dimension, block.find("from")->dimension) ||
      !language::fits(block.find("from")->dimension, block.find("to")->dimension))
    diagnostics.error(block.find("to")->position, "`from` and `to` are of different units");
  constant.from = tidy(constant.unit.from_si(block.number("from")));
  constant.to = tidy(constant.unit.from_si(block.number("to")));
  constant.logarithmic = block.word("scale") == "log";
  if (!(constant.from < constant.to))
    diagnostics.error(block.find("to")->position, "`to` must be greater than `from`");
  else if (constant.logarithmic && !(constant.from > 0.))
    diagnostics.error(block.find("from")->position, "a range on a log scale begins above 0");
  return constant;
}

void complete_subject(SubjectInfo& info, const simulation::Experiment& experiment,
                      const EngineTable& engines) {
  info.engine = experiment.engine;
  const auto entry = engines.find(info.engine);
  info.available = entry != engines.end() && entry->second.description.found;
  const bool ours = info.engine == "dts";
  info.law = ours ? experiment.contact : "";
  info.integrator = ours ? experiment.integrator : "";
  info.settings = ours ? "" : experiment.settings;
}

double VariedConstant::at(double share) const {
  return to_six_digits(logarithmic ? from * std::pow(to / from, share)
                                   : from + share * (to - from));
}

double VariedConstant::share_of(double value) const {
  if (!(value > from)) return 0.;
  if (!(value < to)) return 1.;
  return logarithmic ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
}

ConstantSetting VariedConstant::setting(double value) const {
  return {place, name, unit.with_unit(value)};
}

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
  std::vector<ConstantSetting> all;
  for (std::size_t i = 0; i < values.size(); ++i) all.push_back(varied[i].setting(values[i]));
  return all;
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
