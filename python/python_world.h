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

#include "application/application.h"
#include "simulation/run/run_files.h"
#include "simulation/run/world.h"

namespace hookpoint::python {

/// An Application that keeps what it has to tell, for an exception.
class QuietApplication {
 public:
  explicit QuietApplication(bool allow_plugins);
  application::Application& operator*() { return *application_; }
  application::Application* operator->() { return application_.get(); }
  /// Throws hookpoint.FileError with what was told last.
  [[noreturn]] void fail() const;
  /// Warnings told since the last call become warnings of Python, each with its place.
  void pass_on_warnings();

 private:
  struct Told {
    language::Diagnostics last;
    std::vector<std::string> warnings;
  };
  std::shared_ptr<Told> told_;
  std::unique_ptr<application::Application> application_;
};

/// What a run records and writes.
struct RunOptions {
  std::optional<double> duration;   ///< [s]; none: to the end of the file's own
  std::vector<std::string> trails;  ///< whose values are returned, and written to trace.csv
  std::int64_t every = 1;           ///< steps from one returned row to the next
  std::optional<std::filesystem::path> output;  ///< folder of the files; none: nothing is written
  std::optional<std::filesystem::path> movie;   ///< beside those of the file; empty: movie.h5
};

/// What a .hook file is, and what is changed in it before it is evaluated.
struct Source {
  std::filesystem::path file;
  std::optional<std::string> text;    ///< the file's, if it is none on disk
  std::vector<std::string> settings;  ///< trail=value
  std::optional<std::string> engine;
  bool allow_plugins = false;
};

class PythonWorld {
 public:
  /// At time 0. Throws hookpoint.FileError, or hookpoint.Error when the engine cannot run it.
  explicit PythonWorld(const Source& source);

  /// Takes `count` steps, fewer when the run ends. Lets other threads run.
  void step(std::int64_t count);
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
  const simulation::Experiment& experiment() const { return *experiment_; }
  const std::string& text() const { return text_; }
  std::string ended() const { return world_->ended(); }
  const std::vector<std::string>& notices() const { return world_->state().notices; }
  const pybind11::dict& recorded() const { return recorded_; }

 private:
  struct Recording;
  const simulation::Port& port(const std::string& trail);
  /// Steps without the GIL, looking for signals now and then. The status of the last.
  simulation::StepStatus advance(std::int64_t count, Recording& recording);
  /// The settings with one more: a field of the file's World.
  std::vector<std::string> settings_with(const std::string& field, const std::string& value);
  /// The experiment as it lies beside the files of a run: one that begins at time 0 with the run's
  /// duration as the World's.
  std::string text_of_run(const RunOptions& options);
  std::unique_ptr<simulation::RunFiles> open_files(const RunOptions& options);

  Source source_;
  QuietApplication application_;
  std::optional<simulation::Experiment> experiment_;
  std::string text_;
  std::vector<std::string> sources_;  ///< files that it was made from
  std::unique_ptr<simulation::World> world_;
  std::vector<simulation::Port> ports_;
  std::unordered_map<std::string, simulation::Port> found_;
  pybind11::dict recorded_;
};

}  // namespace hookpoint::python
