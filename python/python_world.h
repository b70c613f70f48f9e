// A world as Python holds it: loaded from a file, stepped, read and written by trail.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "python/loaded_file.h"
#include "simulation/run/run_files.h"
#include "simulation/run/saved_state.h"
#include "simulation/run/world.h"

namespace hookpoint::python {

/// What a run records and writes.
struct RunOptions {
  std::optional<double> duration;   ///< [s]; none: to the end of the file's own
  std::vector<std::string> trails;  ///< whose values are returned, and written to trace.csv
  std::int64_t every = 1;           ///< steps from one returned row to the next
  std::optional<std::filesystem::path> output;  ///< folder of the files; none: nothing is written
  std::optional<std::filesystem::path> movie;   ///< beside those of the file; empty: movie.h5
};

class PythonWorld {
 public:
  /// At time 0. Throws hookpoint.FileError, or hookpoint.Error when the engine cannot run it.
  explicit PythonWorld(std::shared_ptr<LoadedFile> file);
  PythonWorld(const PythonWorld&) = delete;
  PythonWorld& operator=(const PythonWorld&) = delete;

  /// Takes `count` steps, fewer when the run ends. Lets other threads run. After every `every`
  /// steps and after the last `callback` gets this World, unless it is None; the steps end when it
  /// returns something false but None.
  void step(std::int64_t count, const pybind11::object& callback, std::int64_t every);
  /// Back to time 0, as the file says. Throws hookpoint.Error for an engine that cannot be saved.
  void reset();
  /// StateBytes of it.
  pybind11::bytes state();
  void set_state(const pybind11::bytes& state);
  /// A world of its own that goes on as this one does.
  std::unique_ptr<PythonWorld> copy();
  /// The memory of a port, of a vector's or of a list's, as an array that keeps `self` alive.
  pybind11::array view(const pybind11::object& self, const std::string& trail);
  /// Returns the values of the trails at the present instant and after every `every` steps, and
  /// "time". With `output` that folder gets what `hookpoint run` would leave in it. Throws
  /// output::FileError.
  pybind11::dict run(const RunOptions& options);
  double read(const std::string& trail);
  void write(const std::string& trail, double value);
  /// A tuple (trail, unit, writable) a port.
  pybind11::list ports();

  double time() const { return world_->state().time; }
  std::int64_t steps() const { return world_->state().step; }
  const simulation::Experiment& experiment() const { return file_->experiment(); }
  const std::string& text() const { return file_->text(); }
  /// What the engine published last.
  const simulation::WorldState& motion() const { return world_->state(); }
  std::string ended() const { return world_->ended(); }
  /// Of what ran since time 0.
  std::vector<std::string> notices() const;
  const pybind11::dict& recorded() const { return recorded_; }

 private:
  struct Recording;
  const simulation::Port& port(const std::string& trail);
  /// Steps without the GIL, looking for signals now and then. The status of the last.
  simulation::StepStatus advance(std::int64_t count, Recording& recording);
  /// The experiment as it lies beside the files of a run: one that begins at time 0 with the run's
  /// duration as the World's.
  std::string text_of_run(const RunOptions& options);
  std::unique_ptr<simulation::RunFiles> open_files(const RunOptions& options);

  const simulation::StateBytes& state_bytes();

  std::shared_ptr<LoadedFile> file_;
  std::unique_ptr<simulation::World> world_;
  std::vector<simulation::Port> ports_;
  std::unordered_map<std::string, simulation::Port> found_;
  std::optional<simulation::StateBytes> state_bytes_;  ///< once asked for
  std::vector<double> start_;                          ///< at time 0; empty: cannot be saved
  std::size_t first_notices_ = 0;                      ///< said at time 0
  std::size_t next_notice_ = 0;                        ///< the first after the last reset
  bool viewed_input_ = false;                          ///< may be written without a call
  pybind11::dict recorded_;
};

}  // namespace hookpoint::python
