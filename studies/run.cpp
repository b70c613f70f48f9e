#include "studies/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "simulation/energy_watch.h"
#include "studies/execute.h"
#include "studies/results_csv.h"
#include "studies/row_runner.h"
#include "studies/verdict.h"

namespace hookpoint::studies {
namespace {

const EngineEntry* find_engine(const EngineTable& engines, const std::string& name) {
  const auto entry = engines.find(name);
  return entry == engines.end() ? nullptr : &entry->second;
}

/// What several rows have in common to say: `text` with a # for each number.
std::string kind_of(const std::string& text) {
  if (text.starts_with(simulation::energy_finding)) return std::string(simulation::energy_finding);
  std::string plain;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit || plain.empty() || plain.back() != '#') plain += digit ? '#' : c;
  }
  return plain;
}

/// Each once, with the first row that says so and how many others do, whatever the numbers in it.
std::vector<std::string> collect_notices(const StudyPlan& plan,
                                         const std::vector<RowOutcome>& outcomes) {
  struct Notice {
    std::size_t row;
    std::string text;
    std::set<std::size_t> rows;
  };
  std::vector<Notice> found;
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    for (const std::string& notice : outcomes[i].notices) {
      const auto [place, is_new] = places.try_emplace(kind_of(notice), found.size());
      if (is_new) found.push_back({i, notice, {}});
      found[place->second].rows.insert(i);
    }
  }
  std::vector<std::string> notices;
  for (const Notice& notice : found) {
    const std::size_t others = notice.rows.size() - 1;
    notices.push_back(plan.name_of(plan.rows[notice.row]) + ": " + notice.text +
                      (others == 0   ? ""
                       : others == 1 ? " (so does 1 more run)"
                                     : fmt::format(" (so do {} more runs)", others)));
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
                     [&](std::size_t) { return plan.metrics.size(); }, plan.plots.size()};
  run.interrupted = !run_rows(order, work, options, store, meter, outcomes) ||
                    (timed && !run_timing(plan, engines, stop, meter, outcomes));
  run.notices = collect_notices(plan, outcomes);
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
