// What a scene expects of its run, measured: one port, reduced to one number over a time. A study's
// own metrics are reduced by the same code.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/dimension.h"
#include "simulation/experiment/experiment.h"
#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// As in `take = maximum`, in the order of the enumeration.
const std::vector<std::string>& reduction_names();
std::optional<Reduction> find_reduction(std::string_view name);

/// What a reduction needs besides its values, and has not got: "`time_at` needs the `level` ...";
/// "" when it has all.
std::string missing_of(const ReductionSpec& spec);

/// The dimension of the reduction of a quantity.
language::Dimension dimension_of(Reduction take, const language::Dimension& quantity);

/// Since when a quantity has stayed within `band` of where it ends, in a pass: the greatest and the
/// least values from each instant on, as a staircase that only the end decides how to read. Values
/// that differ by less than a hundredth of the band share a stair, so memory goes with the range of
/// the values over the band, not with time.
class SettleWatch {
 public:
  explicit SettleWatch(double band) : band_(band) {}
  void observe(double time, double value);
  /// The first of the times from which on all values are within the band of `end`, the last one's.
  double since(double end) const;

 private:
  struct Stair {
    double value;
    double left;  ///< the first time after it
  };
  /// From the top down; the last stair is the present value.
  using Staircase = std::vector<Stair>;
  void climb(Staircase& stairs, double time, double value) const;

  double band_, first_time_ = 0.;
  Staircase greatest_, least_;  ///< of the values, and of those with the other sign
};

/// The least-squares parabola over time, in a pass.
class ParabolaFit {
 public:
  void observe(double time, double value);
  /// Its second derivative; nothing before three values.
  std::optional<double> curvature() const;

 private:
  double count_ = 0., first_time_ = 0., first_ = 0.;
  std::array<double, 4>
      power_{};  ///< sums of the time since the first value, to the power of 1 to 4
  double value_ = 0., product_ = 0., square_product_ = 0.;  ///< sums of the values less the first
};

/// Sees a quantity's value at every step and keeps a fixed amount of memory, however long the run
/// (but for `settle_time` without a level: SettleWatch).
class Reducer {
 public:
  explicit Reducer(const ReductionSpec& spec)
      : take_(spec.take),
        from_(spec.from),
        to_(spec.to),
        level_(spec.level.value_or(0.)),
        band_(spec.band.value_or(0.)),
        about_level_(spec.level.has_value()),
        settling_(band_) {}
  /// Times grow. Values outside the window are left out. O(1).
  void observe(double time, double value);
  /// Nothing while no value was in the window, for a level that was not crossed, and for one that
  /// the last value is not within the band of.
  std::optional<double> value() const;

 private:
  void find_crossing(double time, double value);
  void observe_interval(double time, double value);
  void observe_settling(double time, double value);

  Reduction take_;
  double from_;
  std::optional<double> to_;
  double level_, band_;
  bool about_level_;
  SettleWatch settling_;
  ParabolaFit parabola_;
  std::optional<double> inside_since_;  ///< of the band about the level
  double integral_ = 0., above_ = 0.;
  std::int64_t rises_ = 0;
  double greatest_time_ = 0., least_time_ = 0.;
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
  /// log10 of |measured - expected| over the expectation's scale, at least `least_decades`; nothing
  /// without a value or a scale.
  std::optional<double> decades() const;
  static constexpr double least_decades = -9.;
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
