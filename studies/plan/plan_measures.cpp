// Measure blocks that define a metric of the user's own, and the Expects of the scene as metrics
// with their Truths.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "language/names.h"
#include "language/tree/references.h"
#include "output/text/number.h"
#include "simulation/run/expectation.h"
#include "simulation/scene/load.h"
#include "studies/plan/plan_builder.h"
#include "studies/summary.h"

namespace hookpoint::studies {

using language::Dimension;
using language::Field;
using language::Formula;
using language::Object;

namespace {

constexpr const char* of_formula = "of";

/// Fields that say something of a formula alone.
constexpr std::array own_fields{"take", "from", "to", "level", "band", "predicted"};

}  // namespace

std::vector<std::string> PlanBuilder::measured_names() const {
  std::vector<std::string> names;
  for (const MetricDefinition* metric : plan_.metrics) names.emplace_back(metric->name);
  return names;
}

std::ptrdiff_t PlanBuilder::measured_index(std::string_view name) const {
  const auto found = std::ranges::find(plan_.metrics, name, &MetricDefinition::name);
  return found == plan_.metrics.end() ? -1 : found - plan_.metrics.begin();
}

void PlanBuilder::check_own_fields(const Object& block) {
  for (const char* field : own_fields) {
    if (!block.given(field)) continue;
    diagnostics_.error(block.find(field)->position,
                       fmt::format("`{}` belongs to a metric of your own, which says what it is "
                                   "`of`",
                                   field));
  }
}

std::optional<std::vector<std::optional<Dimension>>> PlanBuilder::dimensions_of(
    const Formula& formula, bool ports, std::vector<std::string>& trails) {
  if (scene_ == nullptr) return std::nullopt;
  std::vector<std::optional<Dimension>> dimensions;
  bool good = true;
  const auto wrong = [&](std::size_t name, const std::string& why) {
    good = false;
    diagnostics_.error(formula.places[name], why);
  };
  if (!ports) {
    for (const auto& number : scene_->numbers(formula, wrong))
      dimensions.push_back(number ? number->dimension : std::nullopt);
  }
  for (std::size_t i = 0; i < formula.names.size() && ports; ++i) {
    std::string why;
    const auto port = scene_->port(formula.names[i], why);
    if (!port) {
      wrong(i, why);
      continue;
    }
    dimensions.push_back(port->dimension);
    trails.push_back(port->trail);
  }
  return good ? std::optional(std::move(dimensions)) : std::nullopt;
}

std::optional<language::FormulaUnit> PlanBuilder::formula_unit(const Formula& formula, bool ports,
                                                               std::vector<std::string>& trails) {
  const auto names = dimensions_of(formula, ports, trails);
  return names ? language::unit_of(formula, *names, diagnostics_) : std::nullopt;
}

void PlanBuilder::check_fits(const Field& field, const std::optional<Dimension>& found,
                             const Dimension& wanted) {
  if (!found || language::fits(*found, wanted)) return;
  diagnostics_.error(
      field.position,
      fmt::format("`{}` is to be in {}, not in {}", field.schema->name,
                  language::describe_dimension(wanted), language::describe_dimension(*found)));
}

simulation::ReductionSpec PlanBuilder::reduction_of(const Object& block) {
  simulation::ReductionSpec spec;
  const auto number = [&](const char* field) {
    return block.given(field) ? std::optional(block.number(field)) : std::nullopt;
  };
  spec.take = *simulation::find_reduction(block.word("take"));
  spec.from = number("from").value_or(plan_.settle);
  spec.to = number("to");
  spec.level = number("level");
  spec.band = number("band");
  if (spec.to && *spec.to <= spec.from)
    diagnostics_.error(block.find("to")->position,
                       "`to` must be later than `from`, which is `settle` unless it is given");
  if (const std::string missing = simulation::missing_of(spec); !missing.empty())
    diagnostics_.error(block.given("take") ? block.find("take")->position : block.position,
                       missing);
  return spec;
}

void PlanBuilder::set_unit(UserMetric& metric, const Object& block,
                           const std::optional<Dimension>& dimension) {
  if (dimension) metric.unit = language::unit_text(*dimension);
  if (!block.given("unit")) return;
  const auto unit = given_unit(block, dimension);
  if (!unit) return;
  metric.unit = block.find("unit")->words.front();
  metric.scale = unit->numerator / unit->denominator;
}

std::optional<language::Unit> PlanBuilder::given_unit(const Object& block,
                                                      const std::optional<Dimension>& dimension) {
  const Field& field = *block.find("unit");
  const auto unit = language::parse_unit(field.words.front());
  if (!unit)
    diagnostics_.error(field.position, fmt::format("`{}` is no unit{}", field.words.front(),
                                                   language::did_you_mean(field.words.front(),
                                                                          language::unit_names())));
  if (!unit || !dimension || language::fits(*dimension, unit->dimension) ||
      language::fits(unit->dimension, *dimension))
    return unit;
  const bool own = block.given(of_formula) || block.given("trace");
  diagnostics_.error(
      field.position,
      fmt::format("{}`{}` is in {}, not in {}", own ? "`" + block.word("take") + "` of " : "",
                  block.name, language::describe_dimension(*dimension),
                  language::describe_dimension(unit->dimension)));
  return std::nullopt;
}

std::optional<language::FormulaUnit> PlanBuilder::set_source(UserMetric& metric,
                                                             const Object& block) {
  const std::string take = spoken(block.word("take"));
  if (block.given("trace")) {
    metric.doc = fmt::format("{} of the distance from the trace {}", take, block.word("trace"));
    return set_trace(metric, block);
  }
  metric.of = block.find(of_formula)->formula;
  metric.doc = fmt::format("{} of {}", take, metric.of->text);
  return formula_unit(*metric.of, true, metric.trails);
}

void PlanBuilder::add_own_metric(const Object& block) {
  if (find_metric(block.name) != nullptr)
    return diagnostics_.error(
        block.position,
        fmt::format("`{}` is a metric that there is; give your own another name", block.name));
  UserMetric metric;
  metric.name = block.name;
  const auto unit_of_ports = set_source(metric, block);
  // After an error the metric is kept all the same: what names it is not wrong.
  const language::FormulaUnit found = unit_of_ports.value_or(language::FormulaUnit{});
  metric.reduction = reduction_of(block);
  std::optional<Dimension> dimension;
  const simulation::Reduction take = metric.reduction.take;
  const bool of_time =
      simulation::dimension_of(take, {}) == simulation::dimension_of(take, Dimension{0, 1, 0, 0});
  if (found.dimension || of_time)
    dimension = simulation::dimension_of(take, found.dimension.value_or(Dimension{}));
  if (!unit_of_ports) metric.unit = "?";
  set_unit(metric, block, dimension);
  for (const char* field : {"level", "band"})
    if (block.given(field) && found.dimension)
      check_fits(*block.find(field), block.find(field)->dimension, *found.dimension);
  if (block.given("predicted")) {
    metric.predicted = block.find("predicted")->formula;
    std::vector<std::string> none;
    const auto predicted = formula_unit(*metric.predicted, false, none);
    const auto unit = language::parse_unit(metric.unit);
    if (predicted && unit && (dimension || block.given("unit")))
      check_fits(*block.find("predicted"), predicted->dimension, unit->dimension);
  }
  keep(std::move(metric));
}

void PlanBuilder::add_expectations() {
  const int cases = plan_.case_sweep();
  const bool differ =
      cases >= 0 && !plan_.sweeps[static_cast<std::size_t>(cases)].durations.empty();
  if (differ || scene_->tree().children_of("Expect").empty()) return;
  language::Diagnostics untold;
  const auto experiment = simulation::load_experiment(scene_->tree(), untold);
  if (!experiment) return;  // which a row says as well
  const bool as_long = std::abs(experiment->duration - plan_.duration) <= 1e-9 * plan_.duration;
  for (const Object* block : scene_->tree().children_of("Expect")) {
    const auto& specs = experiment->expectations;
    const auto spec = std::ranges::find(specs, block->name, &simulation::ExpectationSpec::name);
    if (spec == specs.end()) continue;
    if (spec->to ? *spec->to > plan_.duration : !as_long) continue;
    if (measured_index(spec->name) >= 0) {
      diagnostics_.error(block->position,
                         fmt::format("the study measures another `{}`; rename one, or say "
                                     "`expects = false` in the study",
                                     spec->name));
      continue;
    }
    add_expectation(*block, *spec);
  }
}

void PlanBuilder::add_expectation(const Object& block, const simulation::ExpectationSpec& spec) {
  UserMetric metric;
  metric.name = metric.expectation = spec.name;
  const std::string& port = block.find("of")->words.front();
  metric.doc = fmt::format("{} of {}, which the scene expects", spoken(block.word("take")), port);
  std::string why;
  const auto found = scene_->port(port, why);
  const Dimension quantity = found ? found->dimension.value_or(Dimension{}) : Dimension{};
  metric.unit = language::unit_text(simulation::dimension_of(spec.take, quantity));
  TruthPlan truth;
  truth.metric = plan_.metrics.size();
  truth.predicted = truth.of_scene = true;
  truth.tolerance = spec.tolerance;
  truth.within = spec.within;
  truth.name = spec.name;
  const std::string unit = metric.unit.empty() ? "" : " " + metric.unit;
  truth.words = fmt::format("{} equals the scene's {}{}", spec.name, spec.formula,
                            allowed_words(truth, output::rounded(spec.within) + unit));
  plan_.truths.push_back(std::move(truth));
  keep(std::move(metric));
}

void PlanBuilder::keep(UserMetric metric) {
  metric.index = plan_.user_metrics.size();
  auto kept = std::make_shared<UserMetric>(std::move(metric));
  complete(*kept);
  plan_.metrics.push_back(&kept->definition);
  plan_.units.push_back({kept->unit});
  plan_.metric_sweeps.push_back(-1);
  plan_.user_metrics.push_back(std::move(kept));
}

}  // namespace hookpoint::studies
