#include "studies/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <numeric>

#include "studies/execute.h"
#include "studies/results_csv.h"
#include "studies/row_runner.h"
#include "studies/verdict.h"

namespace hookpoint::studies {
namespace {

std::atomic<bool> interrupt_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_interrupt(int signal) {
  interrupt_requested = true;
  std::signal(signal, SIG_DFL);
}

const EngineEntry* find_engine(const EngineTable& engines, const std::string& name) {
  const auto entry = engines.find(name);
  return entry == engines.end() ? nullptr : &entry->second;
}

/// What a row is called: "creep (dts_hookpoint, slope = 5 deg)".
std::string name_of(const StudyPlan& plan, const RowPlan& row) {
  std::string name =
      plan.name + " (" + plan.subjects[static_cast<std::size_t>(row.subject)].info.name;
  for (std::size_t i = 0; i < plan.sweeps.size(); ++i) {
    const SweepPlan& sweep = plan.sweeps[i];
    name += ", " + sweep.column.name + " = " + sweep.texts[static_cast<std::size_t>(row.values[i])];
  }
  return name + ")";
}

std::vector<std::string> collect_notices(const StudyPlan& plan,
                                         const std::vector<RowOutcome>& outcomes) {
  std::vector<std::string> notices;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    for (const std::string& notice : outcomes[i].notices) {
      const std::string text = name_of(plan, plan.rows[i]) + ": " + notice;
      if (std::ranges::find(notices, text) == notices.end()) notices.push_back(text);
    }
  }
  return notices;
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
  run.folder = options.folder.empty()
                   ? std::filesystem::path("runs") / fmt::format("{}-{}", plan.name, plan.hash)
                   : options.folder;
  const RowStore store(run.folder / "rows", plan.hash, options.resume);
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
                     [&](std::size_t) { return plan.metrics.size(); }, plan.plots.size()};
  run.interrupted = !run_rows(order, work, options, store, meter, outcomes) ||
                    (timed && !run_timing(plan, engines, stop, meter, outcomes));
  run.notices = collect_notices(plan, outcomes);
  if (run.interrupted) return run;
  run.result = assemble(plan, engines, outcomes);
  run.provenance = make_provenance(plan, engines);
  write_study_files(run.folder, plan, run.result, run.provenance);
  return run;
}

InterruptGuard::InterruptGuard() {
  interrupt_requested = false;
  std::signal(SIGINT, request_interrupt);
  std::signal(SIGTERM, request_interrupt);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::stop() { return interrupt_requested; }

}  // namespace hookpoint::studies
