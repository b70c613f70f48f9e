// Back to a moment of a movie: the world is put to the instant before it and steps there, so that
// everything is as the run had it, what only a step computes included. The world of an engine that
// cannot be saved runs there from its start.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "output/movies/movie.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

class Rewind {
 public:
  /// `world`: of the movie's experiment, at time 0. Both outlive it. Throws output::MovieError when
  /// the world's numbers are not those of the movie.
  Rewind(const Experiment& experiment, const output::MovieReader& movie, World& world);

  /// The first and the last step that can be reached.
  std::int64_t first() const;
  std::int64_t last() const { return steps_.back(); }
  /// The step at `time` [s]. Throws output::MovieError when none is there or it is out of reach.
  std::int64_t step_at(double time) const;

  /// Once `stop` is true, each of the calls below that steps throws output::MovieError.
  void stop_when(const std::atomic<bool>& stop) { stop_ = &stop; }

  /// Puts the world to the last instant before `step` (that of time 0 stays as it is), after making
  /// sure that the run between the instants around `step` repeats to the last bit. Throws
  /// output::MovieError when it does not.
  void approach(std::int64_t step);
  /// From there to `step`.
  void arrive(std::int64_t step);

  /// For who goes along a movie piece by piece: makes sure that steps lead from here to `step`.
  /// Where an instant lies between, or `step` behind, the world is put to the last instant before
  /// it.
  void turn_to(std::int64_t step);
  /// One step. At an instant the world is compared with the movie, and takes its numbers where they
  /// differ. "" or how they do. Throws output::MovieError when no step leads on.
  std::string go_on();
  /// Whether what only a step computes is right: not when the world was just put to an instant.
  bool whole() const { return whole_; }

 private:
  void put(std::size_t instant);
  void run_again(std::int64_t step);
  void run_to(std::int64_t step);
  /// The last instant before `step`; of the first moment, that one.
  std::size_t instant_before(std::int64_t step) const;
  /// "" or how the world differs from the movie.
  std::string difference(std::size_t instant);
  void compare(std::size_t instant);
  std::string time_text(std::int64_t step) const;

  const Experiment& experiment_;
  const output::MovieReader& movie_;
  World& world_;
  std::vector<StateSection> sections_;
  std::vector<std::int64_t> steps_;  ///< of the instants
  std::vector<double> recorded_, computed_;
  std::size_t next_ = 0;  ///< the first instant after the world's present step
  bool whole_ = true;
  const std::atomic<bool>* stop_ = nullptr;
};

}  // namespace hookpoint::simulation
