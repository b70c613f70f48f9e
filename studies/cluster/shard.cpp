#include "studies/cluster/shard.h"

#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "simulation/identity.h"

namespace hookpoint::studies {
namespace {

simulation::Experiment experiment_of(const RunRequest& run, language::Library& library,
                                     const EngineTable& engines) {
  language::Diagnostics found;
  auto loaded = load_scene(library, run.scene, found);
  const std::string identity =
      loaded ? run_identity(simulation::experiment_hash(loaded->printed, loaded->experiment),
                            run.measurement, loaded->experiment.engine, engines)
             : "";
  if (identity != run.identity)
    throw RunListError(run.name +
                       ": this is not the run that was asked for; the program, its engines or the "
                       "files of the scene are not the same here");
  loaded->experiment.duration = run.measurement.duration;
  return std::move(loaded->experiment);
}

}  // namespace

bool run_shard(const RunList& list, Journal& journal, language::Library& library,
               const EngineTable& engines, int jobs, const std::atomic<bool>& stop) {
  std::vector<const RunRequest*> left;
  for (const RunRequest& run : list.runs)
    if (!journal.has(run.identity)) left.push_back(&run);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cut_short{false};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < left.size() && !cut_short; i = next++) {
        const RunRequest& run = *left[i];
        const auto record =
            execute(run.measurement, experiment_of(run, library, engines), engines, "", stop);
        const std::lock_guard lock(mutex);
        if (record)
          journal.add(run.identity, *record);
        else
          cut_short = true;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      cut_short = true;
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < jobs; ++i) workers.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);
  return !cut_short;
}

}  // namespace hookpoint::studies
