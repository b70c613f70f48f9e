#include "studies/tune/run_batches.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "output/text/hash.h"
#include "simulation/identity.h"

namespace hookpoint::studies {
namespace {

/// Of a run whose scene cannot be loaded: every metric is there, without a value.
RunRecord unloadable(const Measurement& measurement, const language::Diagnostics& found) {
  RunRecord record;
  record.status = "cannot run: " + first_error_of(found);
  for (const MetricDefinition* metric : measurement.metrics) record.values[kept_name(*metric)] = {};
  return record;
}

}  // namespace

RunBatches::RunBatches(BatchPlan plan, const EngineTable& engines, const RunOptions& options,
                       const std::filesystem::path& folder, std::size_t total,
                       const std::atomic<bool>& stop)
    : plan_(std::move(plan)),
      measurement_{plan_.runs.settle, plan_.runs.duration, plan_.runs.metrics, {}, false},
      engines_(engines),
      options_(options),
      stop_(stop),
      store_(open_store(options, folder)),
      meter_(total, options_) {}

std::string RunBatches::identity_of(const WantedRun& wanted) const {
  output::Hash identity;
  identity.add(plan_.hash).add(std::to_string(wanted.seed));
  for (const ConstantSetting& constant : wanted.constants)
    identity.add(constant.name).add(constant.text);
  return identity.text();
}

std::optional<RunRecord> RunBatches::execute(const WantedRun& wanted) const {
  if (stop_.load(std::memory_order_relaxed)) return std::nullopt;
  language::Diagnostics found;
  auto scene = plan_.scene.load(wanted.constants, wanted.seed, found);
  if (!scene) return unloadable(measurement_, found);
  scene->experiment.duration = measurement_.duration;
  return studies::execute(measurement_, scene->experiment, engines_, "", stop_);
}

std::optional<RunRequest> RunBatches::request(const WantedRun& wanted) const {
  language::Diagnostics untold;
  RowScene row = plan_.scene.row_scene(wanted.constants, wanted.seed);
  const auto scene = plan_.scene.load(wanted.constants, wanted.seed, untold);
  if (!scene) return std::nullopt;
  const std::string experiment =
      simulation::experiment_hash(language::print(*scene->tree), scene->experiment);
  return RunRequest{fmt::format("{}, seed {}", plan_.runs.name, wanted.seed),
                    run_identity(experiment, measurement_, scene->experiment.engine, engines_),
                    std::move(row), measurement_};
}

std::optional<WantedOutcome> RunBatches::outcome_of(std::size_t run) const {
  const auto record = store_->numbers(identities_[run]);
  if (!record || !measurement_.found_in(*record)) return std::nullopt;
  WantedOutcome outcome{record->status, {}};
  for (const MetricDefinition* metric : measurement_.metrics)
    outcome.measured.push_back(record->values.at(kept_name(*metric)).measured);
  return outcome;
}

std::vector<WantedOutcome> RunBatches::run(std::span<const WantedRun> wanted) {
  const std::size_t first = identities_.size();
  for (const WantedRun& one : wanted) identities_.push_back(identity_of(one));
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), first);
  // A request is asked for several times, and costs as much as loading the scene.
  std::vector<std::optional<std::optional<RunRequest>>> requests(wanted.size());
  const RowWork work{
      plan_.runs.name, identities_, [&](std::size_t run) { return execute(wanted[run - first]); },
      [&](std::size_t, const RunRecord& record) { return measurement_.found_in(record); },
      [&](std::size_t run) {
        auto& known = requests[run - first];
        if (!known) known = request(wanted[run - first]);
        return *known;
      }};
  const bool all = run_rows(order, work, options_, *store_, meter_, stop_);
  std::vector<WantedOutcome> outcomes;
  std::vector<std::optional<WantedOutcome>> finished;
  for (const std::size_t run : order) {
    auto outcome = outcome_of(run);
    if (all && !outcome) throw StoreError("a run that was just kept cannot be read back");
    if (all)
      outcomes.push_back(std::move(*outcome));
    else
      finished.push_back(std::move(outcome));
  }
  if (!all) throw BatchInterrupted(std::move(finished));
  return outcomes;
}

void RunBatches::skip(std::size_t runs) {
  for (std::size_t i = 0; i < runs; ++i) meter_.advance(true);
}

}  // namespace hookpoint::studies
