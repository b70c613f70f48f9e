#include "studies/run/execute.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <memory>
#include <string>
#include <utility>

#include "output/files/hash.h"
#include "simulation/engine_interface/engine_lost.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/run/loop.h"
#include "simulation/run/world.h"
#include "simulation/run/world_watch.h"
#include "studies/measure/measured_body.h"
#include "studies/predictions/predictions.h"
#include "studies/run/stance_ports.h"

namespace hookpoint::studies {
namespace {

/// In the order of StepStatus::Kind.
constexpr std::array kind_names{"ok", "not_finite", "step_too_large", "solver_failed",
                                "engine_lost"};

/// A curve over time being recorded: at step 0, then at `trace_samples` steps. A signal that counts
/// from `settle` starts there.
class Recording {
 public:
  Recording(const RecordedSignal& recorded, std::int64_t first, std::int64_t steps)
      : recorded_(recorded), first_(first), steps_(steps - first) {
    trace_.time.reserve(trace_samples + 1);
    trace_.value.reserve(trace_samples + 1);
  }
  void observe(const RunContext& context, const Observation& observation) {
    const std::int64_t step = observation.world.step - first_;
    if (step < due_) return;
    const double value = recorded_.signal->value(context, observation);
    if (step == 0 && recorded_.signal->since_settle) {
      start_time_ = observation.world.time;
      start_value_ = value;
    }
    trace_.time.push_back(observation.world.time - start_time_);
    trace_.value.push_back(value - start_value_);
    while (due_ <= step) due_ = step_of(++sample_);
  }
  KeptCurve take() {
    trace_.time.insert(trace_.time.end(), trace_.value.begin(), trace_.value.end());
    return {trace_.time.size(), std::move(trace_.time)};
  }

 private:
  std::int64_t step_of(int sample) const {
    const double part = static_cast<double>(sample) / trace_samples;
    const double last = static_cast<double>(steps_);
    if (sample > trace_samples) return INT64_MAX;
    return std::llround(recorded_.logarithmic ? std::pow(last, part) : part * last);
  }
  const RecordedSignal& recorded_;
  std::int64_t first_, steps_, due_ = 0;
  double start_time_ = 0., start_value_ = 0.;
  int sample_ = 0;
  Trace trace_;
};

/// A path being recorded: at equal intervals of the duration, whatever the step, between two steps
/// on the line that joins them.
class PathRecording {
 public:
  explicit PathRecording(double duration) : interval_(duration / path_samples) {}
  void observe(const Observation& observation) {
    const double time = observation.world.time;
    const Vector3d& position = observation.body.position;
    if (path_.empty()) path_.push_back(position);
    // Times are multiples of the step, rounded.
    for (double due;
         path_.size() <= path_samples &&
         (due = interval_ * static_cast<double>(path_.size())) < time + 1e-9 * interval_;) {
      const double part = std::min((due - time_) / (time - time_), 1.);
      path_.push_back(position_ + part * (position - position_));
    }
    time_ = time;
    position_ = position;
  }
  KeptCurve take() const {
    KeptCurve curve;
    for (const Vector3d& p : path_) curve.samples.insert(curve.samples.end(), {p.x, p.y, p.z});
    curve.size = curve.samples.size();
    return curve;
  }

 private:
  double interval_, time_ = 0.;
  Vector3d position_;
  std::vector<Vector3d> path_;
};

/// Everything that looks at a run.
class Watch {
 public:
  Watch(const Measurement& measurement, const RunContext& context, std::int64_t steps,
        simulation::World& world)
      : measurement_(measurement),
        context_(context),
        observer_(context, needs_points(), needs_feet()) {
    std::vector<simulation::Port> ports;
    if (std::ranges::any_of(measurement.metrics, &MetricDefinition::user)) ports = world.ports();
    for (const MetricDefinition* metric : measurement.metrics) {
      metrics_.push_back(nullptr);
      if (metric->make != nullptr) metrics_.back() = metric->make(context);
      if (metric->user != nullptr)
        metrics_.back() = make_user_metric(*metric->user, context, ports, measurement.traces);
    }
    if (any_needs(measurement.metrics, &MetricNeeds::stance))
      stance_ = stance_ports(context, world);
    balanced_ = any_needs(measurement.metrics, &MetricNeeds::numerical_energy) &&
                world.energy_balance().is_known();
    if (balanced_) {
      world.energy_balance().begin();
      world.energy_balance().begin_drives();
    }
    if (measurement.path) path_.emplace(measurement.duration);
    const std::int64_t settle =
        simulation::step_count(measurement.settle, context.experiment->deltat);
    recordings_.reserve(measurement.signals.size());
    for (const RecordedSignal& recorded : measurement.signals)
      recordings_.emplace_back(recorded, recorded.signal->since_settle ? settle : 0, steps);
  }
  void observe(const simulation::World& world) {
    Observation observation = observer_.observe(world.state(), &world.inputs());
    observation.stance = stance_;
    if (balanced_) {
      const auto robot = static_cast<std::size_t>(context_.robot);
      observation.numerical_energy = world.energy_balance().numerical_energy(robot);
      observation.driven_work = world.energy_balance().driven_work(robot);
    }
    for (const auto& metric : metrics_)
      if (metric) metric->observe(observation);
    for (Recording& recording : recordings_) recording.observe(context_, observation);
    if (path_) path_->observe(observation);
  }
  /// `broken`: the engine could not go on. Otherwise a run that is not complete was ended.
  void finish(RunRecord& record, bool complete, bool broken) {
    for (std::size_t i = 0; i < metrics_.size(); ++i) {
      std::optional<double> value;
      if (metrics_[i] && complete) value = metrics_[i]->value();
      if (metrics_[i] && broken) value = metrics_[i]->value_of_broken_run();
      if (value && !std::isfinite(*value)) value.reset();
      const MetricDefinition& metric = *measurement_.metrics[i];
      if (complete && !value && metrics_[i])
        if (const std::string why = metrics_[i]->why_not(); !why.empty())
          record.notices.push_back(std::string(metric.name) + ": " + why);
      record.values[kept_name(metric)].measured = value;
    }
    for (std::size_t i = 0; i < recordings_.size(); ++i)
      record.curves[measurement_.signals[i].name()] = recordings_[i].take();
    if (path_) record.curves[path_curve] = path_->take();
  }

 private:
  bool needs_feet() const { return any_needs(measurement_.metrics, &MetricNeeds::feet); }
  bool needs_points() const {
    return any_needs(measurement_.metrics, &MetricNeeds::points) ||
           std::ranges::any_of(measurement_.signals, [](const RecordedSignal& recorded) {
             return recorded.signal->needs_points;
           });
  }
  const Measurement& measurement_;
  const RunContext& context_;
  Observer observer_;
  std::vector<std::unique_ptr<Metric>> metrics_;
  std::vector<const double*> stance_;
  bool balanced_ = false;  ///< metrics need the numerical energy
  std::vector<Recording> recordings_;
  std::optional<PathRecording> path_;
};

/// With every name that is measured, and nothing under it but the closed forms.
RunRecord not_run(const Measurement& measurement, RunRecord record, std::string status) {
  record.status = std::move(status);
  for (const MetricDefinition* metric : measurement.metrics)
    record.values[kept_name(*metric)].measured.reset();
  for (const RecordedSignal& recorded : measurement.signals) record.curves[recorded.name()] = {};
  if (measurement.path) record.curves[path_curve] = {};
  return record;
}

void predict_all(const Measurement& measurement, const RunContext& context,
                 const EngineEntry& engine, RunRecord& record) {
  const PeerContact peer = peer_contact(engine, *context.experiment);
  for (const MetricDefinition* metric : measurement.metrics)
    if (metric->user == nullptr) {
      const Prediction form = predict(metric->name, context, peer);
      KeptValue& value = record.values[kept_name(*metric)];
      value.predicted = form.value();
      value.no_form = form.why();
      if (value.predicted && !std::isfinite(*value.predicted)) {
        // For example the stopping distance without friction.
        value.predicted.reset();
        value.no_form = "the formula's value is not finite";
      }
    }
}

/// Of a measurement that looks at ports alone nothing need move.
RunContext context_of(const Measurement& measurement, const simulation::Experiment& experiment) {
  const bool of_ports =
      measurement.signals.empty() && !measurement.path && measurement.body.empty() &&
      std::ranges::all_of(measurement.metrics,
                          [](const auto* metric) { return metric->user != nullptr; });
  if (!of_ports || something_moves(experiment))
    return make_context(experiment, measurement.settle, measurement.duration, measurement.body);
  RunContext context;
  context.experiment = &experiment;
  context.settle = measurement.settle;
  context.duration = measurement.duration;
  return context;
}

/// As `execute`, of an engine that is there; may throw.
std::optional<RunRecord> step_through(const Measurement& measurement, const RunContext& context,
                                      const EngineEntry& engine, RunRecord record,
                                      const std::atomic<bool>& stop) {
  const simulation::Experiment& experiment = *context.experiment;
  const std::int64_t steps = simulation::step_count(measurement.duration, experiment.deltat);
  auto made = engine.make(experiment);
  if (any_needs(measurement.metrics, &MetricNeeds::forces)) made->publish_ground_forces();
  simulation::World world(experiment, std::move(made));
  if (any_needs(measurement.metrics, &MetricNeeds::contact_force)) world.publish_contact_forces();
  Watch watch(measurement, context, steps, world);
  simulation::WorldWatch watched(experiment, world, steps);
  watch.observe(world);
  world.announce(steps);
  const simulation::RunEnd end = simulation::run_until(
      world, steps, [&] { return !stop.load(std::memory_order_relaxed); },
      [&] {
        watch.observe(world);
        watched.observe();
      });
  if (end.interrupted()) return std::nullopt;
  if (end.failed())
    record.status = fmt::format("{} {}", kind_names[static_cast<std::size_t>(end.status.kind)],
                                simulation::failure_text(end.status));
  else if (!end.complete() && !measurement.may_end)
    record.status = fmt::format("ended at {:.6g} s: {}", world.state().time, end.why);
  record.notices = world.state().notices;
  for (std::string& finding : watched.findings()) record.notices.push_back(std::move(finding));
  watch.finish(record, record.status == "ok", end.failed());
  return record;
}

}  // namespace

std::string kept_name(const MetricDefinition& metric) {
  return metric.user == nullptr ? std::string(metric.name) : metric.user->key;
}

std::string RecordedSignal::name() const {
  return std::string(signal->name) + (logarithmic ? ", logarithmic" : "");
}

bool Measurement::found_in(const RunRecord& record) const {
  return std::ranges::all_of(metrics,
                             [&](const MetricDefinition* metric) {
                               return record.values.contains(kept_name(*metric));
                             }) &&
         std::ranges::all_of(signals,
                             [&](const RecordedSignal& recorded) {
                               return record.curves.contains(recorded.name());
                             }) &&
         (!path || record.curves.contains(path_curve));
}

std::string run_identity(const std::string& experiment, const Measurement& measurement,
                         const std::string& engine, const EngineTable& engines) {
  output::Hash hash;
  hash.add("measured")
      .add(fmt::format("{} {} {}", measurement.settle, measurement.duration, measurement.body))
      .add(simulation::run_hash(experiment, engines.describe(engine)));
  for (const auto& [name, trace] : measurement.traces) hash.add(name).add(trace_hash(*trace));
  if (measurement.may_end) hash.add("may end");
  return hash.text();
}

Trace trace_of(const KeptCurve& curve) {
  const auto middle = curve.samples.begin() + static_cast<std::ptrdiff_t>(curve.samples.size() / 2);
  return {{curve.samples.begin(), middle}, {middle, curve.samples.end()}};
}

std::vector<Vector3d> path_of(const KeptCurve& curve) {
  std::vector<Vector3d> path;
  for (std::size_t i = 0; i + 2 < curve.samples.size(); i += 3)
    path.push_back({curve.samples[i], curve.samples[i + 1], curve.samples[i + 2]});
  return path;
}

std::optional<RunRecord> execute(const Measurement& measurement,
                                 const simulation::Experiment& experiment,
                                 const EngineTable& engines, const std::string& refusal,
                                 const std::atomic<bool>& stop) {
  const EngineEntry* engine = engines.find(experiment.engine);
  const std::string why_not = !engines.available(experiment.engine)
                                  ? "skipped: " + engines.absence(experiment.engine)
                              : !refusal.empty() ? "refused: " + refusal
                                                 : "";
  RunRecord record;
  try {
    RunContext context = context_of(measurement, experiment);
    if (engine != nullptr) context.one_friction = engine->has_one_friction(experiment);
    if (something_moves(experiment)) record.regime = regime_of(context);
    if (!why_not.empty()) return not_run(measurement, std::move(record), why_not);
    context.make = engine->make;
    try {
      predict_all(measurement, context, *engine, record);
    } catch (const simulation::ExperimentError&) {
      // The run itself says why, if it cannot be.
    }
    return step_through(measurement, context, *engine, record, stop);
  } catch (const simulation::EngineLost& error) {
    record.values.clear();
    return not_run(measurement, std::move(record),
                   fmt::format("engine_lost before the run: {}", error.what()));
  } catch (const simulation::ExperimentError& error) {
    if (!why_not.empty()) return not_run(measurement, std::move(record), why_not);
    const bool peer = experiment.engine != "dts";
    if (peer) record.values.clear();
    return not_run(measurement, std::move(record),
                   fmt::format("{}: {}", peer ? "refused" : "cannot run", error.what()));
  }
}

RunRecord execute_timing(std::span<const MetricDefinition* const> metrics,
                         const simulation::Experiment& experiment, const EngineEntry& engine) {
  // Processor time: wall time counts whoever else uses the machine, and counts long steps of one
  // engine more often interrupted than short ones of another. A program works in another process, so
  // that only wall time sees its part.
  const auto seconds_now = [&engine] {
    using std::chrono::duration, std::chrono::steady_clock;
    return engine.is_program ? duration<double>(steady_clock::now().time_since_epoch()).count()
                             : static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  };
  constexpr int steps = 200;
  std::array<double, 5> stretches{};
  RunRecord record;
  for (const MetricDefinition* metric : metrics)
    if (metric->timing()) record.values[std::string(metric->name)];
  simulation::World world(experiment, engine.make(experiment));
  for (double& seconds : stretches) {
    const double start = seconds_now();
    for (int step = 0; step < steps; ++step)
      if (!world.step().ok()) return record;
    seconds = seconds_now() - start;
  }
  std::sort(stretches.begin(), stretches.end());
  const double step_time = stretches[stretches.size() / 2] / steps;
  for (const MetricDefinition* metric : metrics)
    if (metric->timing())
      record.values[std::string(metric->name)].measured =
          metric->of_step_time(step_time, experiment.deltat);
  return record;
}

}  // namespace hookpoint::studies
