#include "studies/run/run.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "studies/run/execute.h"
#include "studies/run/kept_rows.h"
#include "studies/run/results_csv.h"
#include "studies/run/row_runner.h"
#include "studies/run/verdict.h"

namespace hookpoint::studies {
namespace {

/// The timing metrics of the rows that ran to their end, one after the other; those that are kept
/// are not timed again. False when stopped.
bool run_timing(const StudyPlan& plan, const EngineTable& engines, const KeptRows& kept,
                const std::atomic<bool>& stop, ProgressMeter& meter, RunStore& store) {
  const auto complete = [&](const RunRecord& record) {
    return std::ranges::all_of(plan.metrics, [&](const MetricDefinition* metric) {
      return !metric->timing() || record.values.contains(std::string(metric->name));
    });
  };
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    if (stop) return false;
    const RunRecord record = kept.numbers(i);
    const bool there = record.status != "ok" || complete(record);
    if (!there)
      store.save_timing(kept.timing_identity(i),
                        execute_timing(plan.metrics, plan.experiment_of(plan.rows[i]),
                                       engines.at(plan.rows[i].engine)));
    meter.advance(there);
  }
  return true;
}

/// The row's run for another process: one that has an engine to run it.
std::optional<RunRequest> request_of(const StudyPlan& plan, const EngineTable& engines,
                                     const RowPlan& row, const std::string& identity) {
  const auto engine = engines.find(row.engine);
  const bool runs =
      row.refusal.empty() && engine != engines.end() && engine->second.description.found;
  if (!runs) return std::nullopt;
  return RunRequest{plan.name_of(row), identity, plan.scene_of(row), measurement_of(plan, row)};
}

}  // namespace

std::size_t remote_runs(const StudyPlan& plan, const EngineTable& engines) {
  const std::vector<std::string> identities = run_identities(plan, engines);
  std::set<std::string_view> runs;
  for (std::size_t row = 0; row < plan.rows.size(); ++row)
    if (request_of(plan, engines, plan.rows[row], identities[row])) runs.insert(identities[row]);
  return runs.size();
}

std::shared_ptr<RunStore> open_store(const RunOptions& options,
                                     const std::filesystem::path& folder) {
  return options.store ? options.store
                       : std::make_shared<RunStore>(folder / store_folder, options.resume);
}

StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop) {
  StudyRun run;
  run.folder = options.folder.empty() ? plan.folder() : options.folder;
  run.files =
      std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan), study_files(plan));
  const auto store = open_store(options, run.folder);
  const KeptRows kept(plan, engines, store);
  const bool timed = plan.measures(MetricScope::timing);
  ProgressMeter meter(plan.rows.size() * (timed ? 2 : 1), options);
  std::vector<std::size_t> order(plan.rows.size());
  std::iota(order.begin(), order.end(), 0);
  RowWork work{plan.name, kept.identities(),
               [&](std::size_t row) {
                 const RowPlan& planned = plan.rows[row];
                 return execute(measurement_of(plan, planned), plan.experiment_of(planned), engines,
                                planned.refusal, stop);
               },
               [&](std::size_t row, const RunRecord& record) {
                 return measurement_of(plan, plan.rows[row]).found_in(record);
               },
               [&](std::size_t row) {
                 return request_of(plan, engines, plan.rows[row], kept.identities()[row]);
               }};
  std::mutex telling;
  if (options.row_done)
    work.done = [&](std::size_t row) {
      const RunResult result = assemble_row(plan, kept, row);
      const std::lock_guard lock(telling);
      options.row_done(row, result);
    };
  run.interrupted = !run_rows(order, work, options, *store, meter, stop) ||
                    (timed && !run_timing(plan, engines, kept, stop, meter, *store));
  if (run.interrupted) {
    run.files.reset();
    return run;
  }
  Notices notices;
  run.result = assemble(plan, kept, notices);
  run.notices = notices.texts([&](std::size_t row) { return plan.name_of(plan.rows[row]); });
  run.provenance = make_provenance(plan, engines);
  write_study_files(run.folder, plan, run.result, run.provenance);
  return run;
}

}  // namespace hookpoint::studies
