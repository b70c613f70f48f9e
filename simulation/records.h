// The data files that an experiment asks for, written row by row while it runs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "control/transmission_line.h"
#include "output/recorder.h"
#include "simulation/ports.h"

namespace hookpoint::simulation {

class Records {
 public:
  /// Files in `folder`; `ports`: all of the world. `experiment_text` goes into every file. Throws
  /// ExperimentError for a channel that no port publishes, output::FileError.
  Records(const Experiment& experiment, const std::vector<Port>& ports,
          const std::filesystem::path& folder, const std::string& experiment_text);

  /// Called with every step once, in order, from 0 on. Allocates nothing. Throws output::FileError
  /// after all other files got their row.
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
