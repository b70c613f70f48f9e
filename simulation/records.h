// The data files that an experiment asks for, written row by row while it runs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/transmission_line.h"
#include "output/recorder.h"
#include "simulation/ports.h"

namespace hookpoint::simulation {

/// When something at `rate` [Hz] (none: every step) is written. Throws std::invalid_argument or
/// std::overflow_error.
control::Schedule row_schedule(const std::optional<double>& rate, double deltat);
/// What every file of a run says of it: version, engine, law, seed ...
std::vector<std::pair<std::string, std::string>> run_annotations(const Experiment& experiment);

class Records {
 public:
  /// Files in `folder`; `ports`: all of the world. `experiment_text` goes into every file.
  /// `first_step`: where a run that is resumed begins; its rows are those that the whole run would
  /// have from there on. Throws ExperimentError for a channel that no port publishes,
  /// output::FileError.
  Records(const Experiment& experiment, const std::vector<Port>& ports,
          const std::filesystem::path& folder, const std::string& experiment_text,
          std::int64_t first_step = 0);

  /// Called with every step once, in order, from the first on. Allocates nothing. Throws
  /// output::FileError after all other files got their row.
  void row(std::int64_t step, double time);
  /// All complete. Throws output::FileError.
  void close();

 private:
  struct Record {
    control::Schedule schedule;
    std::vector<const double*> sources;
    std::vector<double> values;
    std::unique_ptr<output::RecordWriter> writer;
  };
  std::vector<Record> records_;
};

}  // namespace hookpoint::simulation
