#include "studies/metrics/user_metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "output/files/hash.h"
#include "simulation/run/expectation.h"
#include "studies/measurements/sampled_port.h"
#include "studies/measurements/trace_residual.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// Without a value, and why.
class NotMeasured : public Metric {
 public:
  explicit NotMeasured(std::string why) : why_(std::move(why)) {}
  void observe(const Observation&) override {}
  std::optional<double> value() const override { return std::nullopt; }
  std::string why_not() const override { return why_; }

 private:
  std::string why_;
};

/// Of a formula of ports, reduced as the run goes on.
class MeasuredFormula : public Metric {
 public:
  MeasuredFormula(const UserMetric& metric, std::vector<const double*> sources, double slack)
      : metric_(metric),
        sources_(std::move(sources)),
        names_(sources_.size()),
        formula_(*metric.of),
        reducer_(widened(metric.reduction, slack)) {}
  void observe(const Observation& observation) override {
    for (std::size_t i = 0; i < sources_.size(); ++i) names_[i] = *sources_[i];
    const double value = formula_(names_);
    const double time = observation.world.time;
    if (std::isfinite(value))
      reducer_.observe(time, value);
    else if (!lost_)
      lost_ = time;
  }
  std::optional<double> value() const override {
    const auto value = lost_ ? std::nullopt : reducer_.value();
    return value ? std::optional(metric_.in_unit(*value)) : std::nullopt;
  }
  std::string why_not() const override {
    if (!lost_) return "";
    return fmt::format("`{}` has no value at {} s", metric_.of->text, text::rounded(*lost_, 6));
  }

 private:
  /// Times are multiples of the step, rounded.
  static simulation::ReductionSpec widened(simulation::ReductionSpec spec, double slack) {
    spec.from -= slack;
    if (spec.to) *spec.to += slack;
    return spec;
  }
  const UserMetric& metric_;
  std::vector<const double*> sources_;
  std::vector<double> names_;
  language::FormulaEvaluator formula_;
  simulation::Reducer reducer_;
  std::optional<double> lost_;  ///< when the formula had no value [s]
};

/// Of the distance from what was measured, reduced over the samples.
class MeasuredDistance : public Metric {
 public:
  MeasuredDistance(const UserMetric& metric, const TracePlan& trace,
                   const simulation::Experiment& experiment,
                   const std::vector<simulation::Port>& ports)
      : metric_(metric),
        trace_(trace),
        port_(trace, experiment, ports),
        deltat_(experiment.deltat),
        reducer_(metric.reduction) {}
  void observe(const Observation& observation) override {
    std::size_t sample = port_.samples();
    port_.observe(observation.world.time, deltat_);
    for (; sample < port_.samples(); ++sample)
      reducer_.observe(trace_.measured.time[sample], distance(trace_, sample, port_.residuals()));
  }
  std::optional<double> value() const override {
    const auto value = reducer_.value();
    return value ? std::optional(metric_.in_unit(*value)) : std::nullopt;
  }
  std::string why_not() const override {
    const auto& times = trace_.measured.time;
    const auto end = times.begin() + static_cast<std::ptrdiff_t>(port_.samples());
    const simulation::ReductionSpec& spec = metric_.reduction;
    const bool looked_at = std::any_of(times.begin(), end, [&](double time) {
      return time >= spec.from && (!spec.to || time <= *spec.to);
    });
    return looked_at ? "" : "no sample lies in the time that it looks at";
  }

 private:
  const UserMetric& metric_;
  const TracePlan& trace_;
  SampledPort port_;
  double deltat_;  ///< [s]
  simulation::Reducer reducer_;
};

/// An Expect of the scene.
class MeasuredExpect : public Metric {
 public:
  MeasuredExpect(const simulation::ExpectationSpec& spec, const double* source)
      : source_(source), reducer_(spec.reduction) {}
  void observe(const Observation& observation) override {
    reducer_.observe(observation.world.time, *source_);
  }
  std::optional<double> value() const override { return reducer_.value(); }

 private:
  const double* source_;
  simulation::Reducer reducer_;
};

std::string own_key(const UserMetric& metric) {
  if (!metric.expectation.empty()) return expectation_key(metric.expectation);
  constexpr std::size_t digits = 16;
  const simulation::ReductionSpec& spec = metric.reduction;
  output::Hash hash;
  hash.add(metric.of != nullptr ? metric.of->text : "trace " + metric.trace);
  for (const std::string& trail : metric.trails) hash.add(trail);
  hash.add(fmt::format("{} {} {} {} {} {}", static_cast<int>(spec.take), text::shortest(spec.from),
                       text::shortest(spec.to, "-"), text::shortest(spec.level, "-"),
                       text::shortest(spec.band, "-"), text::shortest(metric.scale)));
  return metric.name + "@" + hash.text().substr(0, digits);
}

}  // namespace

std::string expectation_key(const std::string& name) { return "expect:" + name; }

void complete(UserMetric& metric) {
  metric.key = own_key(metric);
  metric.definition = {.name = metric.name, .unit = metric.unit, .doc = metric.doc};
  metric.definition.user = &metric;
}

std::unique_ptr<Metric> make_user_metric(const UserMetric& metric, const RunContext& context,
                                         const std::vector<simulation::Port>& ports,
                                         const MeasuredTraces& traces) {
  const simulation::Experiment& experiment = *context.experiment;
  try {
    if (!metric.expectation.empty()) {
      const auto* spec = expectation_of(experiment, metric.expectation);
      if (spec == nullptr) return std::make_unique<NotMeasured>("");
      return std::make_unique<MeasuredExpect>(
          *spec, simulation::find_port(experiment, ports, spec->trail).value);
    }
    if (!metric.trace.empty())
      return std::make_unique<MeasuredDistance>(metric, *traces.at(metric.trace), experiment,
                                                ports);
    std::vector<const double*> sources;
    for (const std::string& trail : metric.trails)
      sources.push_back(simulation::find_port(experiment, ports, trail).value);
    return std::make_unique<MeasuredFormula>(metric, std::move(sources), 0.5 * experiment.deltat);
  } catch (const simulation::ExperimentError& error) {
    return std::make_unique<NotMeasured>(error.what());
  }
}

const simulation::ExpectationSpec* expectation_of(const simulation::Experiment& experiment,
                                                  const std::string& name) {
  const auto found =
      std::ranges::find(experiment.expectations, name, &simulation::ExpectationSpec::name);
  const bool covers = found != experiment.expectations.end() && found->covers(experiment);
  return covers ? &*found : nullptr;
}

}  // namespace hookpoint::studies
