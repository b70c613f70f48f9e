#include "studies/blocks/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "language/names.h"
#include "language/tree/references.h"
#include "simulation/scene/load.h"
#include "studies/blocks/block.h"
#include "studies/blocks/study_parts.h"
#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Dimension;
using language::Field;
using language::Formula;
using language::FormulaUnit;
using language::Object;

namespace {

const Fields<MeasureBlock>& measure_fields() {
  static const Fields<MeasureBlock> fields{
      words_field("over", 1, &MeasureBlock::over,
                  "of `anisotropy`: the Sweep of directions; default azimuth"),
      formula_field("of", &MeasureBlock::of, "a port or an expression of ports, of every step"),
      words_field("trace", 1, &MeasureBlock::trace,
                  "in the place of `of`: a Trace of the study's Cases; the distance of its port "
                  "from what was measured, at every sample"),
      choice_field("take", simulation::reduction_names(), &MeasureBlock::take,
                   "what becomes of its values; the manual defines each"),
      not_negative(number_field("from", "s", &MeasureBlock::from,
                                "values before do not count; default: settle")),
      positive(number_field("to", "s", &MeasureBlock::to,
                            "values after do not count; default: the run's end")),
      words_field("unit", 1, &MeasureBlock::unit,
                  "of its values: mm, \"m/s\", deg; default: the SI unit"),
      number_field("level", "?", &MeasureBlock::level,
                   "of `time_at`, `count_above`, `time_above`; of `settle_time` what it settles "
                   "about, if not where it ends"),
      positive(number_field("band", "?", &MeasureBlock::band,
                            "of `settle_time`: how far off counts as settled")),
      formula_field("predicted", &MeasureBlock::predicted,
                    "the closed form, of Params of the scene and of fields that hold a number "
                    "there")};
  return fields;
}

const std::string& reduction_name(simulation::Reduction take) {
  return simulation::reduction_names()[static_cast<std::size_t>(take)];
}
/// "time of maximum"
std::string spoken_reduction(simulation::Reduction take) { return spoken(reduction_name(take)); }

/// One Measure block.
class MeasureLoader {
 public:
  MeasureLoader(const Object& object, SceneNames* scene, StudyParts& so_far,
                Diagnostics& diagnostics)
      : object_(object),
        block_(measure_block(object)),
        scene_(scene),
        so_far_(so_far),
        diagnostics_(diagnostics) {}

  void load() {
    if (block_.defines_metric()) return add_own();
    const MetricDefinition* metric = find_metric(object_.name);
    if (metric == nullptr)
      return diagnostics_.error(
          object_.position,
          fmt::format("no metric is called `{}` (one of your own says what it is `of`){}",
                      object_.name, language::did_you_mean(object_.name, metric_names())));
    check_own_fields();
    const int sweep = find_sweep(*metric);
    ShownUnit shown{std::string(metric->unit)};
    if (block_.unit) {
      const auto own = language::parse_unit(metric->unit);
      if (const auto unit = given_unit(own ? own->dimension : Dimension{}))
        shown = {*block_.unit, unit->numerator / unit->denominator};
    }
    so_far_.metrics.push_back({metric, std::move(shown), sweep});
  }

 private:
  /// Errors where a built-in metric's block has fields of the user's own.
  void check_own_fields() {
    for (const Field* field : {block_.take.field, block_.from.field, block_.to.field,
                               block_.level.field, block_.band.field, block_.predicted}) {
      if (field == nullptr) continue;
      diagnostics_.error(field->position,
                         fmt::format("`{}` belongs to a metric of your own, which says what it is "
                                     "`of`",
                                     field->schema->name));
    }
  }

  /// The sweep that the metric is over; -1 of a metric of one run.
  int find_sweep(const MetricDefinition& metric) {
    if (metric.scope != MetricScope::sweep) {
      if (block_.over)
        diagnostics_.error(block_.over.position(),
                           fmt::format("`{}` is of one run, not over a Sweep", object_.name));
      return -1;
    }
    const int sweep = so_far_.sweep_index(block_.over ? *block_.over : "azimuth");
    if (sweep < 0 && block_.over)
      report_unknown(block_.over.position(), "Sweep", *block_.over, so_far_.sweep_names(),
                     diagnostics_);
    else if (sweep < 0)
      diagnostics_.warning(object_.position,
                           fmt::format("`{}` says nothing: no Sweep is called azimuth, and `over` "
                                       "names no other",
                                       object_.name));
    return sweep;
  }

  /// A metric that the block itself defines.
  void add_own() {
    if (find_metric(object_.name) != nullptr)
      return diagnostics_.error(
          object_.position,
          fmt::format("`{}` is a metric that there is; give your own another name", object_.name));
    UserMetric metric;
    metric.name = object_.name;
    const auto unit_of_ports = set_source(metric);
    // After an error the metric is kept all the same: what names it is not wrong.
    const FormulaUnit found = unit_of_ports.value_or(FormulaUnit{});
    metric.reduction = reduction();
    std::optional<Dimension> dimension;
    const simulation::Reduction take = metric.reduction.take;
    const bool of_time =
        simulation::dimension_of(take, {}) == simulation::dimension_of(take, Dimension{0, 1, 0, 0});
    if (found.dimension || of_time)
      dimension = simulation::dimension_of(take, found.dimension.value_or(Dimension{}));
    if (!unit_of_ports) metric.unit = "?";
    set_unit(metric, dimension);
    for (const Field* field : {block_.level.field, block_.band.field})
      if (field != nullptr && found.dimension)
        check_fits(*field, field->dimension, *found.dimension);
    if (block_.predicted != nullptr) {
      metric.predicted = block_.predicted->formula;
      std::vector<std::string> none;
      const auto predicted = formula_unit(*metric.predicted, false, none);
      const auto unit = language::parse_unit(metric.unit);
      if (predicted && unit && (dimension || block_.unit))
        check_fits(*block_.predicted, predicted->dimension, unit->dimension);
    }
    add_user_metric(std::move(metric), so_far_);
  }

  /// Sets what the metric is of: ports, or a Trace of the Cases. Nothing after an error.
  std::optional<FormulaUnit> set_source(UserMetric& metric) {
    const std::string take = spoken_reduction(*block_.take);
    if (block_.trace) {
      metric.doc = fmt::format("{} of the distance from the trace {}", take, *block_.trace);
      return set_trace(metric);
    }
    metric.of = block_.of->formula;
    metric.doc = fmt::format("{} of {}", take, metric.of->text);
    return formula_unit(*metric.of, true, metric.trails);
  }

  std::optional<FormulaUnit> set_trace(UserMetric& metric) {
    metric.trace = *block_.trace;
    if (block_.of != nullptr) {
      diagnostics_.error(block_.trace.position(),
                         "a metric is `of` ports or of a `trace`, not both");
      return std::nullopt;
    }
    std::vector<std::string> known;
    for (const Object* cases : object_.parent->children_of("Cases"))
      for (const Object* trace : cases->children_of("Trace")) known.push_back(trace->name);
    if (std::ranges::find(known, metric.trace) == known.end())
      report_unknown(block_.trace.position(), "Trace of the study's Cases", metric.trace, known,
                     diagnostics_);
    const auto curves = std::ranges::find(so_far_.curves, metric.trace, &MeasuredCurves::name);
    // A Trace that could not be read has its error already.
    if (curves == so_far_.curves.end()) return std::nullopt;
    const TracePlan& trace = *curves->cases.front();
    metric.trails = trace.parts;
    const language::Dimension radians{0, 0, 0, 1};
    return FormulaUnit{trace.is_orientation() ? radians : trace.measured.unit.dimension};
  }

  simulation::ReductionSpec reduction() {
    simulation::ReductionSpec spec;
    spec.take = *block_.take;
    spec.from = block_.from.value.value_or(so_far_.settle);
    spec.to = block_.to.value;
    spec.level = block_.level.value;
    spec.band = block_.band.value;
    if (block_.from && so_far_.duration > 0. && *block_.from >= so_far_.duration)
      diagnostics_.error(block_.from.position(),
                         fmt::format("a run ends at {} s{}: nothing would be measured from {} s on",
                                     text::rounded(so_far_.duration, 6),
                                     so_far_.quick ? " under --quick (`quick_duration`)" : "",
                                     text::rounded(*block_.from, 6)));
    if (spec.to && *spec.to <= spec.from)
      diagnostics_.error(block_.to.position(),
                         "`to` must be later than `from`, which is `settle` unless it is given");
    if (const std::string missing = simulation::missing_of(spec); !missing.empty())
      diagnostics_.error(block_.take.position_or(object_.position), missing);
    return spec;
  }

  void set_unit(UserMetric& metric, const std::optional<Dimension>& dimension) {
    if (dimension) metric.unit = language::unit_text(*dimension);
    if (!block_.unit) return;
    const auto unit = given_unit(dimension);
    if (!unit) return;
    metric.unit = *block_.unit;
    metric.scale = unit->numerator / unit->denominator;
  }

  /// The unit that the block gives, where it fits `dimension`; else nothing, after an error.
  std::optional<language::Unit> given_unit(const std::optional<Dimension>& dimension) {
    const std::string& written = *block_.unit;
    const auto unit = language::parse_unit(written);
    if (!unit)
      diagnostics_.error(block_.unit.position(),
                         fmt::format("`{}` is no unit{}", written,
                                     language::did_you_mean(written, language::unit_names())));
    if (!unit || !dimension || language::fits(*dimension, unit->dimension) ||
        language::fits(unit->dimension, *dimension))
      return unit;
    const std::string& take = reduction_name(*block_.take);
    diagnostics_.error(block_.unit.position(),
                       fmt::format("{}`{}` is in {}, not in {}",
                                   block_.defines_metric() ? "`" + take + "` of " : "",
                                   object_.name, language::describe_dimension(*dimension),
                                   language::describe_dimension(unit->dimension)));
    return std::nullopt;
  }

  void check_fits(const Field& field, const std::optional<Dimension>& found,
                  const Dimension& wanted) {
    if (!found || language::fits(*found, wanted)) return;
    diagnostics_.error(
        field.position,
        fmt::format("`{}` is to be in {}, not in {}", field.schema->name,
                    language::describe_dimension(wanted), language::describe_dimension(*found)));
  }

  std::optional<FormulaUnit> formula_unit(const Formula& formula, bool ports,
                                          std::vector<std::string>& trails) {
    const auto names = dimensions_of(formula, ports, trails);
    return names ? language::unit_of(formula, *names, diagnostics_) : std::nullopt;
  }

  /// Of the names of a formula of ports, or of the scene's constants; the ports' trails go to
  /// `trails`. Nothing after an error.
  std::optional<std::vector<std::optional<Dimension>>> dimensions_of(
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

  const Object& object_;
  const MeasureBlock block_;
  SceneNames* scene_;
  StudyParts& so_far_;
  Diagnostics& diagnostics_;
};

/// `block`: of the scene.
void add_expectation(const Object& block, const simulation::ExpectationSpec& spec,
                     SceneNames& scene, StudyParts& so_far) {
  UserMetric metric;
  metric.name = metric.expectation = spec.name;
  const std::string& port = simulation::port_of_expect(block);
  metric.doc =
      fmt::format("{} of {}, which the scene expects", spoken_reduction(spec.reduction.take), port);
  std::string why;
  const auto found = scene.port(port, why);
  const Dimension quantity = found ? found->dimension.value_or(Dimension{}) : Dimension{};
  metric.unit = language::unit_text(simulation::dimension_of(spec.reduction.take, quantity));
  TruthPlan truth;
  truth.metric = so_far.metrics.size();
  truth.predicted = truth.of_scene = true;
  truth.tolerance = spec.tolerance;
  truth.within = spec.within;
  truth.name = spec.name;
  const std::string unit = metric.unit.empty() ? "" : " " + metric.unit;
  truth.words = fmt::format("{} equals the scene's {}{}", spec.name, spec.formula,
                            allowed_words(truth, text::rounded(spec.within) + unit));
  so_far.truths.push_back(std::move(truth));
  add_user_metric(std::move(metric), so_far);
}

}  // namespace

void add_measure_class(language::Schema& schema) {
  schema.add(block_class(
      "Measure",
      "A metric to measure: by its name one that there is, or one of your own, `of` what ports "
      "say, or of the distance from a `trace`.",
      schemas(measure_fields())));
}

MeasureBlock measure_block(const Object& block) { return load_fields(block, measure_fields()); }

void load_measure(const Object& block, SceneNames* scene, StudyParts& so_far,
                  Diagnostics& diagnostics) {
  MeasureLoader(block, scene, so_far, diagnostics).load();
}

void add_user_metric(UserMetric metric, StudyParts& so_far) {
  metric.index = so_far.user_metrics.size();
  auto kept_metric = std::make_shared<UserMetric>(std::move(metric));
  complete(*kept_metric);
  so_far.metrics.push_back({&kept_metric->definition, {kept_metric->unit}});
  so_far.user_metrics.push_back(std::move(kept_metric));
}

void load_expectations(SceneNames& scene, StudyParts& so_far, Diagnostics& diagnostics) {
  const int cases = so_far.case_sweep();
  const bool differ =
      cases >= 0 && !so_far.sweeps[static_cast<std::size_t>(cases)].durations.empty();
  if (differ || scene.tree().children_of("Expect").empty()) return;
  language::Diagnostics unreported;
  const auto experiment = simulation::load_experiment(scene.tree(), unreported);
  if (!experiment) return;  // which a row says as well
  const bool as_long = std::abs(experiment->duration - so_far.duration) <= 1e-9 * so_far.duration;
  std::vector<const Object*> left_out;
  for (const Object* block : scene.tree().children_of("Expect")) {
    const auto& specs = experiment->expectations;
    const auto spec = std::ranges::find(specs, block->name, &simulation::ExpectationSpec::name);
    if (spec == specs.end()) continue;
    if (spec->reduction.to ? *spec->reduction.to > so_far.duration : !as_long) {
      left_out.push_back(block);
      continue;
    }
    if (so_far.metric_index(spec->name) >= 0) {
      diagnostics.error(block->position,
                        fmt::format("the study measures another `{}`; rename one, or say "
                                    "`expects = false` in the study",
                                    spec->name));
      continue;
    }
    add_expectation(*block, *spec, scene, so_far);
  }
  if (left_out.empty()) return;
  diagnostics.warning(
      left_out.front()->position,
      fmt::format("the study does not judge {}: its runs last {:g} s, and the scene's {:g} s; give "
                  "it that duration or the Expect a `to`, or say `expects = false`",
                  left_out.size() == 1 ? "this Expect"
                                       : fmt::format("{} Expects of its scene", left_out.size()),
                  so_far.duration, experiment->duration));
}

}  // namespace hookpoint::studies
