#include "studies/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <mutex>
#include <thread>

#include "studies/execute.h"
#include "studies/results_csv.h"
#include "studies/row_store.h"
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

/// Counts finished rows and tells the caller, one thread at a time.
class ProgressMeter {
 public:
  ProgressMeter(std::size_t total, const RunOptions& options) : options_(options) {
    progress_.total = total;
  }
  void advance(bool resumed) {
    const std::lock_guard lock(mutex_);
    ++progress_.done;
    if (resumed) ++progress_.resumed;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const auto worked = static_cast<double>(progress_.done - progress_.resumed);
    const auto left = static_cast<double>(progress_.total - progress_.done);
    progress_.seconds_left = worked > 0. ? elapsed.count() / worked * left : 0.;
    if (options_.progress) options_.progress(progress_);
  }

 private:
  const RunOptions& options_;
  std::mutex mutex_;
  Progress progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// All rows by `jobs` workers, each outcome into its own slot. False when stopped.
bool run_rows(const StudyPlan& plan, const EngineTable& engines, const RunOptions& options,
              const RowStore& store, const std::atomic<bool>& stop, ProgressMeter& meter,
              std::vector<RowOutcome>& outcomes) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cut_short{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < plan.rows.size() && !cut_short; i = next++) {
        auto outcome =
            options.resume ? store.load(i, plan.metrics.size(), plan.plots.size()) : std::nullopt;
        const bool resumed = outcome.has_value();
        if (!resumed)
          outcome = execute(plan, plan.rows[i],
                            find_engine(engines, plan.rows[i].experiment.engine), stop);
        if (!outcome) {
          cut_short = true;
          return;
        }
        if (!resumed) store.save(i, *outcome);
        outcomes[i] = std::move(*outcome);
        meter.advance(resumed);
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      failure = std::current_exception();
      cut_short = true;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < std::max(1, options.jobs); ++i) workers.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);
  return !cut_short;
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
  run.interrupted = !run_rows(plan, engines, options, store, stop, meter, outcomes) ||
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
