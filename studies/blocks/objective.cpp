#include "studies/blocks/objective.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "language/names.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/written_values.h"
#include "text/number.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

/// An Objective block as its file has it.
struct ObjectiveBlock {
  SeedsTake take = SeedsTake::mean;
  Placed<double> target;
  bool may_be_empty = false;
};

/// A Require block as its file has it.
struct RequireBlock {
  Placed<double> equals, within, above, below;
  bool may_be_empty = false;
};

constexpr const char *minimise_class = "minimise", *maximise_class = "maximise";

const Fields<ObjectiveBlock>& objective_fields() {
  static const Fields<ObjectiveBlock> fields{
      choice_field("take", {"mean", "worst"}, &ObjectiveBlock::take,
                   "what is taken of the seeds' values"),
      number_field("target", "?", &ObjectiveBlock::target,
                   "in the place of minimise and maximise: what the metric should be; minimised "
                   "is its distance from it, run by run"),
      may_be_empty_field(&ObjectiveBlock::may_be_empty,
                         "every candidate has the same value of it, or none has one; a run "
                         "without a value is then the worst in it")};
  return fields;
}

const Fields<RequireBlock>& require_fields() {
  static const Fields<RequireBlock> fields{
      number_field("equals", "?", &RequireBlock::equals, "the value"),
      not_negative(number_field("within", "?", &RequireBlock::within,
                                "allowed difference from `equals`; default 0")),
      number_field("above", "?", &RequireBlock::above, "it must be greater"),
      number_field("below", "?", &RequireBlock::below, "it must be less"),
      may_be_empty_field(&RequireBlock::may_be_empty,
                         "no run has a value of it; a run without one then meets it")};
  return fields;
}

/// What an Objective is required with: a word by itself.
language::ClassSchema direction_class(std::string name, std::string doc) {
  language::ClassSchema direction;
  direction.name = std::move(name);
  direction.only_in = "Objective";
  direction.doc = std::move(doc);
  direction.naming = language::Naming::forbidden;
  return direction;
}

/// Index of the metric that the block names, among those that are measured.
std::optional<std::size_t> metric_of(const Object& block, StudyParts& so_far,
                                     Diagnostics& diagnostics) {
  if (const std::ptrdiff_t index = so_far.metric_index(block.name); index >= 0)
    return static_cast<std::size_t>(index);
  const MetricDefinition* metric = find_metric(block.name);
  if (metric == nullptr) {
    std::vector<std::string> names = so_far.metric_names();
    append(names, metric_names());
    diagnostics.error(block.position,
                      fmt::format("no metric is called `{}` (a Measure defines one of your own){}",
                                  block.name, language::did_you_mean(block.name, names)));
    return std::nullopt;
  }
  if (!check_of_one_run(block, *metric, diagnostics)) return std::nullopt;
  so_far.metrics.push_back({metric, {std::string(metric->unit)}});
  return so_far.metrics.size() - 1;
}

/// Numbers of a block that are values of a metric.
class ValuesOfMetric {
 public:
  ValuesOfMetric(const MetricDefinition& metric, Diagnostics& diagnostics)
      : unit_(metric.unit), diagnostics_(diagnostics) {}

  /// What the field holds, in the metric's unit.
  std::optional<double> number(const Placed<double>& field) {
    if (!field) return std::nullopt;
    return number_in(*field.field, unit_, diagnostics_);
  }

  /// The metric's unit.
  WrittenUnit own() const {
    return {unit_, language::parse_unit(unit_).value_or(language::Unit{})};
  }

  /// The number in the unit that the file writes, else in the metric's.
  std::string written(const Placed<double>& field) const {
    WrittenUnit unit = written_unit(*field.field);
    if (unit.text.empty()) unit = own();
    return text::rounded(unit.from_si(*field), 6) + (unit.text.empty() ? "" : " " + unit.text);
  }

 private:
  std::string unit_;
  Diagnostics& diagnostics_;
};

/// "is above 0.5 ms", in the units that the block writes.
std::string words_of(const RequireBlock& block, const RequirementPlan& require,
                     const ValuesOfMetric& values) {
  std::vector<std::string> parts;
  if (require.equals)
    parts.push_back("equals " + values.written(block.equals) +
                    (require.within > 0. ? " within " + values.written(block.within) : ""));
  if (require.above) parts.push_back("is above " + values.written(block.above));
  if (require.below) parts.push_back("is below " + values.written(block.below));
  return language::join(parts, " and ");
}

}  // namespace

void add_objective_classes(language::Schema& schema) {
  schema.add(block_class("Objective",
                         "A metric to make small or great, or to bring to a target, by its name.",
                         schemas(objective_fields()), {minimise_class, maximise_class}));
  schema.add(direction_class(minimise_class, "the less the better"));
  schema.add(direction_class(maximise_class, "the more the better"));
}

void add_require_class(language::Schema& schema) {
  schema.add(block_class("Require", "What a metric must be with every seed, by its name.",
                         schemas(require_fields())));
}

bool check_of_one_run(const Object& block, const MetricDefinition& metric,
                      Diagnostics& diagnostics) {
  if (metric.scope == MetricScope::run) return true;
  diagnostics.error(block.position,
                    fmt::format("`{}` is {}: a tuning takes metrics of one run", block.name,
                                metric.timing() ? "a time, which is never the same twice"
                                                : "of several runs together"));
  return false;
}

std::optional<ObjectivePlan> load_objective(const Object& block, StudyParts& so_far,
                                            Diagnostics& diagnostics) {
  const auto metric = metric_of(block, so_far, diagnostics);
  if (!metric) return std::nullopt;
  const ObjectiveBlock said = load_fields(block, objective_fields());
  const bool minimise = !block.children_of(minimise_class).empty();
  const bool maximise = !block.children_of(maximise_class).empty();
  ValuesOfMetric values(*so_far.metrics[*metric].definition, diagnostics);
  ObjectivePlan objective{*metric, maximise, said.take};
  objective.target = values.number(said.target);
  if (minimise + maximise + objective.target.has_value() != 1)
    diagnostics.error(block.position,
                      "an Objective says one of `minimise;`, `maximise;` and `target = `");
  if (objective.target) {
    objective.target_text = values.written(said.target);
    const WrittenUnit unit = written_unit(*said.target.field);
    if (!unit.text.empty()) {
      objective.written_unit = unit.text;
      objective.in_written_unit = unit.from_si(values.own().to_si(1.));
    }
  }
  objective.may_be_empty = said.may_be_empty;
  return objective;
}

std::optional<RequirementPlan> load_requirement(const Object& block, StudyParts& so_far,
                                                Diagnostics& diagnostics) {
  const auto metric = metric_of(block, so_far, diagnostics);
  if (!metric) return std::nullopt;
  const RequireBlock said = load_fields(block, require_fields());
  ValuesOfMetric values(*so_far.metrics[*metric].definition, diagnostics);
  RequirementPlan require;
  require.metric = *metric;
  require.equals = values.number(said.equals);
  require.above = values.number(said.above);
  require.below = values.number(said.below);
  require.within = values.number(said.within).value_or(0.);
  if (!require.equals && !require.above && !require.below)
    diagnostics.error(block.position, "a Require says `equals`, `above` or `below`");
  require.words = block.name + " " + words_of(said, require, values);
  require.may_be_empty = said.may_be_empty;
  return require;
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

}  // namespace hookpoint::studies
