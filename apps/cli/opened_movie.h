// A movie and the experiment inside it, ready to be run again.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "apps/shared/application.h"
#include "output/files/temporary_folder.h"
#include "output/movies/movie.h"
#include "simulation/run/rewind.h"

namespace hookpoint::cli {

class OpenedMovie {
 public:
  /// Throws output::MovieError.
  explicit OpenedMovie(const std::filesystem::path& file, application::Consent consent);
  OpenedMovie(const OpenedMovie&) = delete;
  OpenedMovie& operator=(const OpenedMovie&) = delete;

  const output::MovieReader& reader() const { return reader_; }
  /// The experiment, with the files that it read as they were. Its diagnostics are printed; throws
  /// output::MovieError when it has errors.
  simulation::Experiment load();
  /// What was loaded.
  const language::Object& root() const { return *root_; }
  /// At time 0. Throws simulation::ExperimentError.
  simulation::World make_world(const simulation::Experiment& experiment) const;
  simulation::EngineDescription describe_engine(const simulation::Experiment& experiment) const {
    return application_.describe_engine(experiment);
  }

 private:
  output::MovieReader reader_;
  application::Application application_;
  std::unique_ptr<language::Object> root_;
  output::TemporaryFolder folder_;  ///< of the files taken out
};

/// "2.5 s", "300 ms", "2.5" as seconds. `option`: for the message. Throws output::MovieError.
double seconds(const std::string& text, const char* option);

/// As `use_movie` of work that steps `rewind` along its movie: an interrupt ends it.
int use_movie(simulation::Rewind& rewind, const std::function<int()>& work);

/// The exit status of `work`, which uses a movie; one that cannot be used is reported, and is wrong
/// input.
int use_movie(const std::function<int()>& work);

}  // namespace hookpoint::cli
