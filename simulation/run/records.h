// The data files that an experiment requests, written row by row while it runs.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/core/transmission_line.h"
#include "output/records/recorder.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// When something at `rate` [Hz] (none: every step) is written. Throws std::invalid_argument or
/// std::overflow_error.
control::Schedule row_schedule(const std::optional<double>& rate, double deltat);
/// An experiment as every file of its run tells it.
struct RunText {
  std::string text;  ///< as printed
  std::string hash;  ///< simulation/engine_interface/identity.h
};
/// What every file of a run says of it: the experiment's hash, version, engine, law, seed ...
std::vector<std::pair<std::string, std::string>> run_annotations(const Experiment& experiment,
                                                                 const std::string& hash);

class Records {
 public:
  /// Files in `folder`; `ports`: all of the world. `text` goes into every file.
  /// `first_step`: where a run that is resumed begins; its rows are those that the whole run would
  /// have from there on. Throws ExperimentError for a channel that no port publishes,
  /// output::FileError.
  Records(const Experiment& experiment, const std::vector<Port>& ports,
          const std::filesystem::path& folder, const RunText& text, std::int64_t first_step = 0);

  /// Called with every step once, in order, from the first on. Allocates nothing. Throws
  /// output::FileError after all other files got their row.
  void row(std::int64_t step, double time);
  /// From now on the values are those of `ports`: the run continues in another world. Throws
  /// ExperimentError where one is missing; all is then as it was.
  void rebind(const Experiment& experiment, const std::vector<Port>& ports);
  bool empty() const { return records_.empty(); }
  /// The port of a value that is to be written and is not finite, "" if there is none.
  const std::string& first_not_finite() const;
  /// All complete. Throws output::FileError.
  void close();

 private:
  struct Record {
    control::Schedule schedule;
    std::vector<const double*> sources;
    std::vector<std::string> trails;  ///< of the sources
    std::vector<double> values;
    std::unique_ptr<output::RecordWriter> writer;
  };
  std::vector<Record> records_;
};

}  // namespace hookpoint::simulation
