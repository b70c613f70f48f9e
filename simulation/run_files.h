// All that a run leaves in its folder, written while it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/csv.h"
#include "simulation/movies.h"
#include "simulation/records.h"
#include "simulation/world.h"

namespace hookpoint::simulation {

/// A movie beside those of the file. `file`: where; empty: movie.h5 in the run's folder. Throws
/// ExperimentError when one of the file's own writes there.
void add_movie(const std::filesystem::path& file, Experiment& experiment);

struct RunRequest {
  std::filesystem::path folder;
  std::vector<std::string> trails;  ///< of trace.csv
  std::string text;                 ///< the experiment's
  bool leaves_files = false;        ///< experiment.hook is written even beside nothing else
};

/// The Records and Movies of the file, and the rows of trace.csv: the row at the first step, then
/// one a step.
class RunFiles {
 public:
  /// `ports`: all of the world. `first_step`: of the rows. A movie begins with the present instant
  /// of `world`, which a run that is resumed reaches before its first row.
  RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
           const RunRequest& request, std::int64_t first_step = 0);
  void row(std::int64_t step, double time);
  void close();

 private:
  std::vector<Port> ports_;
  std::vector<double> values_;
  Movies movies_;
  Records records_;
  std::optional<output::TraceWriter> trace_;
};

}  // namespace hookpoint::simulation
