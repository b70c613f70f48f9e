// A world as Python holds it: loaded from a file, stepped, read and written by trail.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/python/busy.h"
#include "apps/python/loaded_file.h"
#include "apps/python/made_whole.h"
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

class PythonWorld : public MadeWhole {
 public:
  /// At time 0. Throws hookpoint.FileError, or hookpoint.Error when the engine cannot run it.
  explicit PythonWorld(std::shared_ptr<LoadedFile> file);
  PythonWorld(const PythonWorld&) = delete;
  PythonWorld& operator=(const PythonWorld&) = delete;

  /// Takes `count` steps, fewer when the run ends. Lets other threads run. After every `every`
  /// steps and after the last `callback` gets this World, unless it is None; the steps end when it
  /// returns something false but None.
  void step(std::int64_t count, const pybind11::object& callback, std::int64_t every);
  /// Back to time 0 as the file says, but for what `state` gives, a dict {trail: numbers} or None
  /// (state_values.h). Throws hookpoint.Error and changes nothing where that cannot be.
  void reset(const pybind11::object& state);
  /// StateBytes of it.
  pybind11::bytes state();
  void set_state(const pybind11::bytes& state);
  /// A world of its own that continues as this one does.
  std::unique_ptr<PythonWorld> copy();
  /// The memory of a port, of a vector's or of a list's, as an array that keeps `self` alive.
  pybind11::array view(const pybind11::object& self, const std::string& trail);
  /// Returns the values of the trails at the present instant and after every `every` steps, and
  /// "time". With `output` that folder gets what `hookpoint run` would leave in it. Throws
  /// output::FileError.
  pybind11::dict run(const RunOptions& options);
  /// A float, or of a vector or a list an array of its own.
  pybind11::object read(const std::string& trail);
  void write(const std::string& trail, const pybind11::object& value);
  /// A tuple (trail, unit, writable) a port.
  pybind11::list ports();

  const LoadedFile& file() const { return *file_; }
  double time() const { return world_->state().time; }
  std::int64_t steps() const { return world_->state().step; }
  const simulation::Experiment& experiment() const { return file_->experiment(); }
  const std::string& text() const { return file_->text(); }
  /// What the engine published last.
  const simulation::WorldState& motion() const { return world_->state(); }
  std::string ended() const { return world_->ended(); }
  /// Of the file, and of what ran since time 0.
  const std::vector<std::string>& notices() const { return notices_; }
  const pybind11::dict& recorded() const { return recorded_; }
  std::string repr() const;

 private:
  struct Recording;
  class Watch;
  /// The elements of a trail: one of a number.
  const std::vector<simulation::Port>& ports(const std::string& trail);
  /// What is wrong with what Python wrote to viewed inputs; ok where nothing is.
  simulation::StepStatus check_viewed() const;
  /// Passes on what the engine has said since the last call.
  void take_notices();
  void add_notice(std::string notice);
  /// Steps without the GIL, looking for signals now and then. The status of the last.
  simulation::StepStatus advance(std::int64_t count, Recording& recording, Watch& watch);
  /// The experiment as it lies beside the files of a run: one that begins at time 0 with the run's
  /// duration as the World's.
  std::string text_of_run(const RunOptions& options);
  std::unique_ptr<simulation::RunFiles> open_files(const RunOptions& options);

  const simulation::StateBytes& state_bytes();

  std::shared_ptr<LoadedFile> file_;
  std::unique_ptr<simulation::World> world_;
  std::vector<simulation::Port> ports_;
  std::unordered_map<std::string, std::vector<simulation::Port>> found_;
  std::optional<simulation::StateBytes> state_bytes_;  ///< once needed
  std::vector<double> start_;                          ///< at time 0; empty: cannot be saved
  std::optional<simulation::Experiment> started_;      ///< with the initial state of the last reset
  std::vector<std::string> notices_;
  std::size_t first_notices_ = 0;  ///< of them, said at time 0
  std::size_t next_notice_ = 0;    ///< the first of the engine's that is not passed on
  std::vector<simulation::Port> viewed_inputs_;  ///< may be written without a call
  std::atomic<bool> busy_{false};                ///< steps without the GIL
  pybind11::dict recorded_;
};

}  // namespace hookpoint::python
