#include "studies/cluster/shard.h"

#include <mutex>
#include <utility>
#include <vector>

#include "studies/measure/workers.h"

namespace hookpoint::studies {
namespace {

simulation::Experiment experiment_of(const RunRequest& run, language::Library& library,
                                     const EngineTable& engines) {
  language::Diagnostics found;
  auto loaded = load_scene(library, run.scene, found);
  const std::string identity =
      loaded ? run_identity(loaded->hash(), run.measurement, loaded->experiment.engine, engines)
             : "";
  if (identity != run.identity)
    throw RunListError(run.name +
                       ": this is not the run that was requested; the program, its engines or the "
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
  std::mutex writing;
  return work_through(left.size(), jobs, [&](std::size_t i) {
    const RunRequest& run = *left[i];
    const auto record =
        execute(run.measurement, experiment_of(run, library, engines), engines, "", stop);
    const std::lock_guard lock(writing);
    if (record) journal.add(run.identity, *record);
    return record.has_value();
  });
}

}  // namespace hookpoint::studies
