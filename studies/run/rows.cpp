#include "studies/run/rows.h"

#include <utility>

#include "output/files/hash.h"

namespace hookpoint::studies {
namespace {

/// What was read of a row that was there when the study ended.
template <class Record>
Record there(std::optional<Record> record) {
  if (record) return std::move(*record);
  throw StoreError(
      "a finished run was damaged in the store of the study's folder since it was kept; start "
      "the study again with --resume");
}

}  // namespace

Measurement measurement_of(const StudyPlan& plan, const RowPlan& row) {
  Measurement measurement{plan.settle, row.duration, {}, {}, plan.measures(MetricScope::subjects)};
  measurement.body = plan.body;
  measurement.may_end = plan.may_end;
  for (const MetricDefinition* metric : plan.metric_definitions()) {
    const bool missing = metric->user != nullptr && !row.forms[metric->user->index].missing.empty();
    if (!metric->timing() && !missing) measurement.metrics.push_back(metric);
    if (metric->user != nullptr && !missing && !metric->user->trace.empty())
      measurement.traces[metric->user->trace] = plan.measured_in(row, metric->user->trace);
  }
  for (const PlotPlan& plot : plan.plots)
    if (plan.records(plot, row)) measurement.signals.push_back({plot.signal, plot.spec.log_x});
  return measurement;
}

std::optional<RunRequest> request_of(const StudyPlan& plan, const EngineTable& engines,
                                     const RowPlan& row, const std::string& identity) {
  if (!row.refusal.empty() || !engines.available(row.engine)) return std::nullopt;
  return RunRequest{plan.name_of(row), identity, plan.scene_of(row), measurement_of(plan, row)};
}

std::vector<std::string> run_identities(const StudyPlan& plan, const EngineTable& engines) {
  std::vector<std::string> identities;
  identities.reserve(plan.rows.size());
  for (const RowPlan& row : plan.rows)
    identities.push_back(run_identity(row.hash, measurement_of(plan, row), row.engine, engines));
  return identities;
}

StudyRows::StudyRows(const StudyPlan& plan, const EngineTable& engines,
                     std::shared_ptr<RunStore> store)
    : plan_(plan),
      engines_(engines),
      store_(std::move(store)),
      identities_(run_identities(plan, engines)) {}

RunBatch StudyRows::batch(const std::atomic<bool>& stop) const {
  RunBatch batch;
  batch.count = plan_.rows.size();
  batch.identity = [this](std::size_t row) { return identities_[row]; };
  batch.make = [this, &stop](std::size_t row) {
    const RowPlan& planned = plan_.rows[row];
    return execute(measurement_of(plan_, planned), plan_.experiment_of(planned), engines_,
                   planned.refusal, stop);
  };
  batch.complete = [this](std::size_t row, const RunRecord& record) {
    return measurement_of(plan_, plan_.rows[row]).found_in(record);
  };
  batch.request = [this](std::size_t row) {
    return request_of(plan_, engines_, plan_.rows[row], identities_[row]);
  };
  return batch;
}

std::string StudyRows::timing_identity(std::size_t row) const {
  return output::Hash()
      .add("timed")
      .add(plan_.printed)
      .add(plan_.name_of(plan_.rows[row]))
      .add(identities_[row])
      .text();
}

RunRecord StudyRows::numbers(std::size_t row) const {
  RunRecord record = there(store_->numbers(identities_[row]));
  if (plan_.measures(MetricScope::timing))
    if (auto timed = store_->timing(timing_identity(row))) record.merge(std::move(*timed));
  return record;
}

RecordedTrace StudyRows::trace(std::size_t row, std::size_t plot) const {
  const PlotPlan& planned = plan_.plots[plot];
  if (!plan_.records(planned, plan_.rows[row])) return {};
  const std::string name = RecordedSignal{planned.signal, planned.spec.log_x}.name();
  return RecordedTrace([store = store_, identity = identities_[row], name] {
    return trace_of(there(store->load(identity)).curves[name]);
  });
}

std::vector<Vector3d> StudyRows::path(std::size_t row) const {
  return path_of(there(store_->load(identities_[row])).curves[path_curve]);
}

}  // namespace hookpoint::studies
