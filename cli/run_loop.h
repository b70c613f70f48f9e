// A run from its present step to its last: what it writes, what it says. Shared by the commands
// that begin a run and that go on with one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/csv.h"
#include "simulation/expectation.h"
#include "simulation/movies.h"
#include "simulation/records.h"
#include "simulation/world.h"

namespace hookpoint::cli {

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
  RunFiles(const simulation::Experiment& experiment, simulation::World& world,
           const std::vector<simulation::Port>& ports, const RunRequest& request,
           std::int64_t first_step = 0);
  void row(std::int64_t step, double time);
  void close();

 private:
  std::vector<simulation::Port> ports_;
  std::vector<double> values_;
  simulation::Movies movies_;
  simulation::Records records_;
  std::optional<output::TraceWriter> trace_;
};

/// The largest stable step, and a warning when the experiment's is larger, on stderr.
void tell_stability(const simulation::Experiment& experiment);

/// Rows from the world's present step to step `last`, or to where the run ends; `expectations`, if
/// any, see every one. Returns the exit status; whatever went wrong has been said.
int step_through(const simulation::Experiment& experiment, simulation::World& world,
                 RunFiles& files, std::int64_t last,
                 simulation::Expectations* expectations = nullptr);

/// The truths that came with the scene beside what the run made of them, on stdout. Returns the
/// exit status.
int print_expectations(const simulation::Expectations& expectations);

/// Where everything is at the end, on stdout.
void print_summary(const simulation::Experiment& experiment, const simulation::WorldState& state);

}  // namespace hookpoint::cli
