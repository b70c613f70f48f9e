// All that a run leaves in its folder, written while it runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/files/csv.h"
#include "output/files/result_folder.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/run/movies.h"
#include "simulation/run/records.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// A movie beside those of the file. `file`: where; empty: movie.h5 in the run's folder. Throws
/// ExperimentError when one of the file's own writes there.
void add_movie(const std::filesystem::path& file, Experiment& experiment);

/// Names in a run's folder that no Record and no Movie may have.
std::vector<std::string> run_files();

struct RunFilesRequest {
  std::filesystem::path folder;
  std::vector<std::string> trails;   ///< of trace.csv: trails or globs (port_search.h)
  std::string text;                  ///< the experiment's
  bool leaves_files = false;         ///< experiment.hook is written even beside nothing else
  EngineDescription engine;          ///< that runs it
  std::vector<std::string> sources;  ///< files that `text` was made from, absolute
  bool changes = false;              ///< a user may change it: changes.csv is among its files
};

/// Finds out what cannot be written before anything is. Throws ExperimentError.
void check_run_files(const Experiment& experiment, const std::vector<Port>& ports,
                     const RunFilesRequest& request);

/// The Records and Movies of the file, and the rows of trace.csv: the row at the first step, then
/// one a step. What lies in the folder is tied to the experiment (output/files/result_folder.h).
class RunFiles {
 public:
  /// `ports`: all of the world. `first_step`: of the rows. A movie begins with the present instant
  /// of `world`, which a run that is resumed reaches before its first row. Throws ExperimentError
  /// before anything is written, output::FolderError, output::FileError.
  RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
           const RunFilesRequest& request, std::int64_t first_step = 0);
  void row(std::int64_t step, double time);
  /// Around what somebody changes between two steps, see Movies.
  void before_change() { movies_.before_change(); }
  void go_on() { movies_.go_on(); }
  /// The run continues in another world of the same layout. Throws ExperimentError if that
  /// lacks a port; all is then as it was.
  void rebind(const Experiment& experiment, const World& world, const std::vector<Port>& ports);
  /// The port of a value that is to be written and is not finite, "" if there is none.
  const std::string& first_not_finite() const;
  void close();
  /// The same while the world is within a step that does not end: movies end with their last
  /// instant.
  void close_within_step();
  /// Where it writes, as the user names it: the run's folder and the files in it.
  const std::filesystem::path& folder() const { return place_; }
  const std::vector<std::string>& names() const { return names_; }
  /// Whether a step leaves something.
  bool has_rows() const { return trace_ || !movies_.empty() || !records_.empty(); }

 private:
  RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
           const RunFilesRequest& request, const RunText& text, std::int64_t first_step);

  std::filesystem::path place_;
  std::vector<std::string> names_;
  std::vector<Port> ports_;
  std::vector<double> values_;
  std::unique_ptr<output::ResultFolder> folder_;  ///< none where nothing goes into one
  Movies movies_;
  Records records_;
  std::optional<output::TraceWriter> trace_;
};

}  // namespace hookpoint::simulation
