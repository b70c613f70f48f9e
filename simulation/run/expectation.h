// What a scene expects of its run, measured: one port, reduced to one number over a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/experiment.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// As in `take = maximum`, in the order of the enumeration.
const std::vector<std::string>& reduction_names();
std::optional<Reduction> find_reduction(std::string_view name);

/// Sees a port's value at every step and keeps a fixed amount of memory, however long the run.
class Reducer {
 public:
  explicit Reducer(const ExpectationSpec& spec)
      : take_(spec.take), from_(spec.from), to_(spec.to), level_(spec.level) {}
  /// Times grow. Values outside the window are left out. O(1).
  void observe(double time, double value);
  /// Nothing while no value was in the window, and for a level that was not crossed.
  std::optional<double> value() const;

 private:
  void find_crossing(double time, double value);

  Reduction take_;
  double from_;
  std::optional<double> to_;
  double level_;
  std::int64_t count_ = 0;
  double first_time_ = 0., first_ = 0., last_time_ = 0., last_ = 0.;
  double least_ = 0., greatest_ = 0.;
  double mean_ = 0., mean_time_ = 0.;  ///< running means, updated by differences: no cancellation
  double square_mean_ = 0., time_square_ = 0., product_ = 0.;
  std::optional<double> crossing_;
};

/// An expectation and what a run made of it.
struct ExpectationResult {
  const ExpectationSpec* spec = nullptr;
  std::optional<double> measured;
  /// |measured - expected|; relative where `tolerance` decides.
  std::optional<double> error() const;
  bool ok() const;
};

/// All expectations of an experiment that cover its law and integrator.
class Expectations {
 public:
  /// `ports`: all of the world. Throws ExperimentError for a port that the engine does not have.
  Expectations(const Experiment& experiment, const std::vector<Port>& ports);
  /// At step 0 and after every step.
  void observe(double time);
  std::vector<ExpectationResult> results() const;
  bool empty() const { return watched_.empty(); }

 private:
  struct Watched {
    const ExpectationSpec* spec;
    const double* value;
    Reducer reducer;
  };
  std::vector<Watched> watched_;
};

}  // namespace hookpoint::simulation
