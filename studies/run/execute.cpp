#include "studies/run/execute.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <memory>
#include <string>

#include "simulation/run/energy_watch.h"
#include "simulation/run/world.h"

namespace hookpoint::studies {
namespace {

using simulation::StepStatus;

std::string_view kind_name(StepStatus::Kind kind) {
  switch (kind) {
    case StepStatus::Kind::ok:
      return "ok";
    case StepStatus::Kind::not_finite:
      return "not_finite";
    case StepStatus::Kind::step_too_large:
      return "step_too_large";
    case StepStatus::Kind::solver_failed:
      return "solver_failed";
  }
  return "failed";
}

std::string failure(const StepStatus& status) {
  return fmt::format("{} at {:.6g} s ({}): {}", kind_name(status.kind), status.time, status.body,
                     status.advice);
}

/// A trace being recorded: at step 0, then at `trace_samples` steps spread evenly or, for a
/// logarithmic time axis, in geometric progression. A signal that counts from `settle` starts
/// there.
class Recording {
 public:
  Recording(const PlotPlan& plot, std::int64_t first, std::int64_t steps)
      : plot_(plot), first_(first), steps_(steps - first) {
    trace_.time.reserve(trace_samples + 1);
    trace_.value.reserve(trace_samples + 1);
  }
  void observe(const RunContext& context, const Observation& observation) {
    const std::int64_t step = observation.world.step - first_;
    if (step < due_) return;
    const double value = plot_.signal->value(context, observation);
    if (step == 0 && plot_.signal->since_settle) {
      start_time_ = observation.world.time;
      start_value_ = value;
    }
    trace_.time.push_back(observation.world.time - start_time_);
    trace_.value.push_back(value - start_value_);
    while (due_ <= step) due_ = step_of(++sample_);
  }
  Trace take() { return std::move(trace_); }

 private:
  std::int64_t step_of(int sample) const {
    const double part = static_cast<double>(sample) / trace_samples;
    const double last = static_cast<double>(steps_);
    if (sample > trace_samples) return INT64_MAX;
    return std::llround(plot_.spec.log_x ? std::pow(last, part) : part * last);
  }
  const PlotPlan& plot_;
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
  std::vector<Vector3d> take() { return std::move(path_); }

 private:
  double interval_, time_ = 0.;
  Vector3d position_;
  std::vector<Vector3d> path_;
};

/// Everything that looks at a run.
class Watch {
 public:
  Watch(const StudyPlan& plan, const RowPlan& row, const RunContext& context, std::int64_t steps)
      : context_(context), observer_(context, needs_points(plan)) {
    for (const MetricDefinition* metric : plan.metrics)
      metrics_.push_back(metric->make == nullptr ? nullptr : metric->make(context));
    if (plan.measures(MetricScope::subjects)) path_.emplace(plan.duration);
    const std::int64_t settle = std::llround(plan.settle / row.experiment.deltat);
    for (const PlotPlan& plot : plan.plots) {
      const bool recorded = plot.signal != nullptr && plan.covers(plot.only, row);
      const std::int64_t first = recorded && plot.signal->since_settle ? settle : 0;
      recordings_.push_back(recorded ? std::optional<Recording>(std::in_place, plot, first, steps)
                                     : std::nullopt);
    }
  }
  void observe(const simulation::World& world) {
    const Observation observation = observer_.observe(world.state(), &world.inputs());
    for (const auto& metric : metrics_)
      if (metric) metric->observe(observation);
    for (auto& recording : recordings_)
      if (recording) recording->observe(context_, observation);
    if (path_) path_->observe(observation);
  }
  /// `broken`: the engine could not go on. Otherwise a run that is not complete was ended.
  void finish(RowOutcome& outcome, bool complete, bool broken) {
    for (const auto& metric : metrics_) {
      std::optional<double> value;
      if (metric && complete) value = metric->value();
      if (metric && broken) value = metric->value_of_broken_run();
      outcome.measured.push_back(value && std::isfinite(*value) ? value : std::nullopt);
    }
    for (auto& recording : recordings_)
      outcome.traces.push_back(recording ? recording->take() : Trace{});
    if (path_) outcome.path = path_->take();
  }

 private:
  static bool needs_points(const StudyPlan& plan) {
    const bool metric = std::any_of(plan.metrics.begin(), plan.metrics.end(),
                                    [](const MetricDefinition* m) { return m->needs_points; });
    return metric || std::any_of(plan.plots.begin(), plan.plots.end(), [](const PlotPlan& plot) {
             return plot.signal != nullptr && plot.signal->name == "penetration";
           });
  }
  const RunContext& context_;
  Observer observer_;
  std::vector<std::unique_ptr<Metric>> metrics_;
  std::vector<std::optional<Recording>> recordings_;
  std::optional<PathRecording> path_;
};

RowOutcome not_run(const StudyPlan& plan, std::string status) {
  RowOutcome outcome;
  outcome.status = std::move(status);
  outcome.measured.resize(plan.metrics.size());
  outcome.traces.resize(plan.plots.size());
  return outcome;
}

}  // namespace

std::optional<RowOutcome> execute(const StudyPlan& plan, const RowPlan& row,
                                  const EngineEntry* engine, const std::atomic<bool>& stop) {
  if (engine == nullptr || !engine->description.found)
    return not_run(plan,
                   fmt::format("skipped: engine {} is not on this machine", row.experiment.engine));
  if (!row.refusal.empty()) return not_run(plan, "refused: " + row.refusal);
  try {
    const simulation::Experiment experiment = row.whole();
    RunContext context = make_context(experiment, plan.settle, plan.duration);
    context.make = engine->make;
    const std::int64_t steps = std::llround(plan.duration / row.experiment.deltat);
    auto made = engine->make(experiment);
    if (std::ranges::any_of(plan.metrics, &MetricDefinition::needs_forces))
      made->publish_ground_forces();
    simulation::World world(experiment, std::move(made));
    if (std::ranges::any_of(plan.metrics, &MetricDefinition::needs_contact_force))
      world.publish_contact_forces();
    Watch watch(plan, row, context, steps);
    simulation::EnergyWatch energy(experiment, world, steps);
    StepStatus status;
    watch.observe(world);
    std::string ended = world.ended();
    for (std::int64_t step = 0; step < steps && status.ok() && ended.empty(); ++step) {
      if (stop.load(std::memory_order_relaxed)) return std::nullopt;
      status = world.step();
      if (status.ok()) watch.observe(world);
      if (status.ok()) energy.observe();
      ended = world.ended();
    }
    RowOutcome outcome;
    if (!status.ok()) outcome.status = failure(status);
    outcome.notices = world.state().notices;
    if (std::string finding = energy.finding(); !finding.empty())
      outcome.notices.push_back(std::move(finding));
    const bool cut_short = status.ok() && world.state().step < steps;
    if (cut_short) outcome.status = fmt::format("ended at {:.6g} s: {}", world.state().time, ended);
    watch.finish(outcome, status.ok() && !cut_short, !status.ok());
    return outcome;
  } catch (const simulation::ExperimentError& error) {
    const bool peer = row.experiment.engine != "dts";
    return not_run(plan, fmt::format("{}: {}", peer ? "refused" : "cannot run", error.what()));
  }
}

std::vector<std::optional<double>> execute_timing(const StudyPlan& plan, const RowPlan& row,
                                                  const EngineEntry& engine) {
  // Processor time: wall time counts whoever else uses the machine, and counts long steps of one
  // engine more often interrupted than short ones of another.
  constexpr int steps = 200;
  std::array<double, 5> stretches{};
  std::vector<std::optional<double>> values(plan.metrics.size());
  const simulation::Experiment experiment = row.whole();
  simulation::World world(experiment, engine.make(experiment));
  for (double& seconds : stretches) {
    const std::clock_t start = std::clock();
    for (int step = 0; step < steps; ++step)
      if (!world.step().ok()) return values;
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::sort(stretches.begin(), stretches.end());
  const double step_time = stretches[stretches.size() / 2] / steps;
  for (std::size_t i = 0; i < plan.metrics.size(); ++i) {
    if (plan.metrics[i]->name == "step_time") values[i] = step_time;
    if (plan.metrics[i]->name == "realtime_factor") values[i] = row.experiment.deltat / step_time;
  }
  return values;
}

}  // namespace hookpoint::studies
