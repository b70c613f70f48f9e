#include "studies/run/kept_rows.h"

#include <utility>

#include "output/text/hash.h"
#include "studies/run/execute.h"

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

std::vector<std::string> run_identities(const StudyPlan& plan, const EngineTable& engines) {
  std::vector<std::string> identities;
  identities.reserve(plan.rows.size());
  for (const RowPlan& row : plan.rows)
    identities.push_back(run_identity(row.hash, measurement_of(plan, row), row.engine, engines));
  return identities;
}

KeptRows::KeptRows(const StudyPlan& plan, const EngineTable& engines,
                   std::shared_ptr<RunStore> store)
    : plan_(plan), store_(std::move(store)), identities_(run_identities(plan, engines)) {}

std::string KeptRows::timing_identity(std::size_t row) const {
  return output::Hash()
      .add("timed")
      .add(plan_.printed)
      .add(plan_.name_of(plan_.rows[row]))
      .add(identities_[row])
      .text();
}

RunRecord KeptRows::numbers(std::size_t row) const {
  RunRecord record = there(store_->numbers(identities_[row]));
  if (plan_.measures(MetricScope::timing))
    if (auto timed = store_->timing(timing_identity(row))) record.merge(std::move(*timed));
  return record;
}

RecordedTrace KeptRows::trace(std::size_t row, std::size_t plot) const {
  const PlotPlan& planned = plan_.plots[plot];
  if (planned.signal == nullptr || !plan_.covers(planned.only, plan_.rows[row])) return {};
  const std::string name = RecordedSignal{planned.signal, planned.spec.log_x}.name();
  return RecordedTrace([store = store_, identity = identities_[row], name] {
    return trace_of(there(store->load(identity)).curves[name]);
  });
}

std::vector<Vector3d> KeptRows::path(std::size_t row) const {
  return path_of(there(store_->load(identities_[row])).curves[path_curve]);
}

}  // namespace hookpoint::studies
