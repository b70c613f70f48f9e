#include "studies/run/run.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "studies/run/execute.h"
#include "studies/run/results_csv.h"
#include "studies/run/rows.h"
#include "studies/run/verdict.h"

namespace hookpoint::studies {
namespace {

/// The timing metrics of the rows that ran to their end, one after the other; those that are kept
/// are not timed again. False when stopped.
bool run_timing(const StudyPlan& plan, const EngineTable& engines, const StudyRows& rows,
                const std::atomic<bool>& stop, CachedRuns& runs) {
  const std::vector<const MetricDefinition*> metrics = plan.metric_definitions();
  const auto complete = [&](const RunRecord& record) {
    return std::ranges::all_of(metrics, [&](const MetricDefinition* metric) {
      return !metric->timing() || record.values.contains(std::string(metric->name));
    });
  };
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    if (stop) return false;
    const RunRecord record = rows.numbers(i);
    const bool there = record.status != "ok" || complete(record);
    if (!there)
      runs.store()->save_timing(rows.timing_identity(i),
                                execute_timing(metrics, plan.experiment_of(plan.rows[i]),
                                               engines.at(plan.rows[i].engine)));
    runs.advance(there);
  }
  return true;
}

}  // namespace

std::size_t remote_runs(const StudyPlan& plan, const EngineTable& engines) {
  const std::vector<std::string> identities = run_identities(plan, engines);
  std::set<std::string_view> runs;
  for (std::size_t row = 0; row < plan.rows.size(); ++row)
    if (request_of(plan, engines, plan.rows[row], identities[row])) runs.insert(identities[row]);
  return runs.size();
}

StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop) {
  StudyRun run;
  run.folder = options.folder.empty() ? plan.folder() : options.folder;
  run.files =
      std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan), study_files(plan));
  const bool timed = plan.measures(MetricScope::timing);
  CachedRuns runs(plan.name, options, run.folder, plan.rows.size() * (timed ? 2 : 1), stop);
  const StudyRows rows(plan, engines, runs.store());
  RunBatch batch = rows.batch(stop);
  std::mutex telling;
  if (options.row_done)
    batch.done = [&](std::size_t row) {
      const RunResult result = assemble_row(plan, rows, row);
      const std::lock_guard lock(telling);
      options.row_done(row, result);
    };
  run.interrupted = !runs.run(batch) || (timed && !run_timing(plan, engines, rows, stop, runs));
  if (run.interrupted) {
    run.files.reset();
    return run;
  }
  Notices notices;
  run.result = assemble(plan, rows, notices);
  run.notices = notices.texts([&](std::size_t row) { return plan.name_of(plan.rows[row]); });
  run.provenance = make_provenance(plan, engines);
  write_study_files(*run.files, plan, run.result, run.provenance);
  return run;
}

}  // namespace hookpoint::studies
