#include "studies/tune/run_batches.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "output/text/hash.h"

namespace hookpoint::studies {
namespace {

/// Of a run whose scene cannot be loaded.
RowOutcome unloadable(const StudyPlan& runs, const language::Diagnostics& found) {
  RowOutcome outcome;
  outcome.status = "cannot run";
  for (const language::Diagnostic& diagnostic : found.all()) {
    if (diagnostic.severity != language::Severity::error) continue;
    outcome.status += ": " + diagnostic.message;
    break;
  }
  outcome.measured.resize(runs.metrics.size());
  outcome.traces.resize(runs.plots.size());
  return outcome;
}

}  // namespace

RunBatches::RunBatches(BatchPlan plan, const EngineTable& engines, const RunOptions& options,
                       const std::filesystem::path& folder, std::size_t total,
                       const std::atomic<bool>& stop)
    : plan_(std::move(plan)),
      engines_(engines),
      options_(options),
      stop_(stop),
      store_(folder / "rows", options.resume),
      meter_(total, options_) {}

std::string RunBatches::identity_of(const RunRequest& request) const {
  output::Hash identity;
  identity.add(plan_.hash).add(std::to_string(request.seed));
  for (const ConstantSetting& constant : request.constants)
    identity.add(constant.name).add(constant.text);
  return identity.text();
}

std::optional<RowOutcome> RunBatches::execute(const RunRequest& request) const {
  if (stop_.load(std::memory_order_relaxed)) return std::nullopt;
  language::Diagnostics found;
  auto scene = plan_.scene.load(request.constants, request.seed, found);
  if (!scene) return unloadable(plan_.runs, found);
  RowPlan row;
  row.experiment = std::move(scene->experiment);
  row.experiment.duration = plan_.runs.duration;
  const auto engine = engines_.find(row.experiment.engine);
  return studies::execute(plan_.runs, row, engine == engines_.end() ? nullptr : &engine->second,
                          stop_);
}

std::vector<RowOutcome> RunBatches::run(std::span<const RunRequest> requests) {
  const std::size_t first = outcomes_.size();
  outcomes_.resize(first + requests.size());
  std::vector<std::size_t> order(requests.size());
  std::iota(order.begin(), order.end(), first);
  const RowWork work{[&](std::size_t row) { return execute(requests[row - first]); },
                     [&](std::size_t row) { return identity_of(requests[row - first]); },
                     [&](std::size_t) { return plan_.runs.metrics.size(); },
                     plan_.runs.plots.size()};
  if (run_rows(order, work, options_, store_, meter_, outcomes_))
    return {outcomes_.begin() + static_cast<std::ptrdiff_t>(first), outcomes_.end()};
  std::vector<std::optional<RowOutcome>> finished;
  for (std::size_t row = first; row < outcomes_.size(); ++row) {
    // One that was not run has no value for any metric, not even an empty one.
    const bool done = outcomes_[row].measured.size() == plan_.runs.metrics.size();
    finished.push_back(done ? std::optional(outcomes_[row]) : std::nullopt);
  }
  throw BatchInterrupted(std::move(finished));
}

void RunBatches::skip(std::size_t runs) {
  for (std::size_t i = 0; i < runs; ++i) meter_.advance(true);
}

}  // namespace hookpoint::studies
