// The movies that an experiment requests, written while it runs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "control/core/transmission_line.h"
#include "output/movies/movie.h"
#include "simulation/run/records.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// What the numbers of an instant are, as text: a line `size<TAB>owner<TAB>contents` a stretch.
std::string layout_text(const std::vector<StateSection>& sections);

class Movies {
 public:
  /// Files in `folder`, with `world`'s present instant as the first of each, whatever its rate, and
  /// from `first_step` on those that the whole run would have. `text` goes into every file, as
  /// do the files that the experiment reads. Throws output::FileError.
  Movies(const Experiment& experiment, const World& world, const std::filesystem::path& folder,
         const RunText& text, std::int64_t first_step = 0);

  /// Called with every step once, in order, from `first_step` on. Allocates nothing. Throws
  /// output::FileError.
  void row(std::int64_t step);
  bool empty() const { return movies_.empty(); }
  /// Somebody is about to change the world between two steps. Each movie has the instant as the run
  /// led to it, and, with the next row or `close`, as it was left: between two instants of a movie
  /// nobody has changed anything. Throws output::FileError.
  void before_change();
  /// Before each step, which may fail.
  void go_on() {
    if (changed_) world_->save_instant(left_);
  }
  /// From now on the instants are those of `world`, whose numbers are alike.
  void rebind(const World& world) { world_ = &world; }
  /// All complete, each with the world's last instant. Throws output::FileError.
  void close();
  /// All complete as they are, while the world is within a step.
  void close_within_step();

 private:
  struct Movie {
    control::Schedule schedule;
    std::unique_ptr<output::RecordWriter> writer;
    std::int64_t last = -1;  ///< step of the last instant
  };
  void write(Movie& movie);
  void write_all(bool even_again);
  void write_left();

  const World* world_;
  bool changed_ = false;      ///< since the last row
  double changed_time_ = 0.;  ///< when [s]
  std::vector<double> left_;  ///< what was left then
  std::vector<double> state_;
  std::vector<Movie> movies_;
};

}  // namespace hookpoint::simulation
