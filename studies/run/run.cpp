#include "studies/run/run.h"

#include <algorithm>
#include <numeric>

#include "studies/run/execute.h"
#include "studies/run/results_csv.h"
#include "studies/run/row_runner.h"
#include "studies/run/verdict.h"

namespace hookpoint::studies {
namespace {

const EngineEntry* find_engine(const EngineTable& engines, const std::string& name) {
  const auto entry = engines.find(name);
  return entry == engines.end() ? nullptr : &entry->second;
}

/// The timing metrics of the rows that ran to their end, one after the other. False when stopped.
bool run_timing(const StudyPlan& plan, const EngineTable& engines, const std::atomic<bool>& stop,
                ProgressMeter& meter, std::vector<RowOutcome>& outcomes) {
  for (std::size_t i = 0; i < plan.rows.size(); ++i) {
    if (stop) return false;
    const EngineEntry* engine = find_engine(engines, plan.rows[i].experiment.engine);
    if (outcomes[i].status == "ok" && engine != nullptr) {
      const auto values = execute_timing(plan, plan.rows[i], *engine);
      for (std::size_t metric = 0; metric < values.size(); ++metric)
        if (values[metric]) outcomes[i].measured[metric] = values[metric];
    }
    meter.advance(false);
  }
  return true;
}

}  // namespace

StudyRun run_study(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
                   const std::atomic<bool>& stop) {
  StudyRun run;
  run.folder = options.folder.empty() ? plan.folder() : options.folder;
  run.files =
      std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan), study_files(plan));
  const RowStore store(run.folder / "rows", options.resume);
  std::vector<RowOutcome> outcomes(plan.rows.size());
  const bool timed = std::any_of(plan.metrics.begin(), plan.metrics.end(),
                                 [](const MetricDefinition* metric) { return metric->timing(); });
  ProgressMeter meter(plan.rows.size() * (timed ? 2 : 1), options);
  std::vector<std::size_t> order(plan.rows.size());
  std::iota(order.begin(), order.end(), 0);
  const RowWork work{[&](std::size_t row) {
                       return execute(plan, plan.rows[row],
                                      find_engine(engines, plan.rows[row].experiment.engine), stop);
                     },
                     [&](std::size_t row) { return plan.identity_of(plan.rows[row], engines); },
                     [&](std::size_t) { return plan.metrics.size(); }, plan.plots.size(),
                     tell_rows(options, [&](std::size_t row, const RowOutcome& outcome) {
                       return assemble_row(plan, engines, row, outcome);
                     })};
  run.interrupted = !run_rows(order, work, options, store, meter, outcomes) ||
                    (timed && !run_timing(plan, engines, stop, meter, outcomes));
  run.notices =
      collect_notices(outcomes, [&](std::size_t row) { return plan.name_of(plan.rows[row]); });
  if (run.interrupted) {
    run.files.reset();
    return run;
  }
  run.result = assemble(plan, engines, outcomes);
  run.provenance = make_provenance(plan, engines);
  write_study_files(run.folder, plan, run.result, run.provenance);
  return run;
}

}  // namespace hookpoint::studies
