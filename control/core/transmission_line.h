// What a wire does to a value on its way: it is sampled (the value of that step, or the mean since
// the last sample), noise joins the sample, and the sample arrives later (docs/transmission.md).
// Time is a count of steps; a rate of 300 Hz on a step of 1 ms samples at steps 0, 4, 7, 10, 14 ...
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "control/core/rational.h"
#include "control/random.h"

namespace hookpoint::control {

/// When something that runs at a rate is due: its n-th time is the first step k with k dt >= n /
/// rate, exactly. A plain value: a copy is a checkpoint.
class Schedule {
 public:
  /// `rate` [Hz] > 0; without one, or with one above 1/dt, every step. `dt` [s] > 0. Throws
  /// std::invalid_argument or std::overflow_error.
  Schedule(const std::optional<Rational>& rate, const Rational& dt);

  /// Whether `step` is a due one. Called with every step once, in order, from 0 on.
  bool due(std::int64_t step) {
    if (step < next_) return false;
    advance();
    return true;
  }
  /// Nominal time from one to the next [s]: 1/rate, or dt without a rate or with a faster one.
  double period() const { return period_; }
  /// How often it was due so far.
  std::int64_t count() const { return count_; }
  /// As after having been due `count` times: a run continues from a record.
  void resume(std::int64_t count);
  /// The step at which it is due for the n-th time, from 0 on.
  std::int64_t step_of(std::int64_t n) const;
  /// Whether every step is a due one.
  bool every_step() const { return whole_ == 1 && part_ == 0; }
  /// No two due steps are closer than this many steps.
  std::int64_t shortest_interval() const { return whole_; }

 private:
  void advance() {
    ++count_;
    next_ += whole_;
    early_ -= part_;
    if (early_ < 0) {
      ++next_;
      early_ += denominator_;
    }
  }

  // n P with P = 1/(rate dt) = whole + part/denominator steps, rounded up to `next`; `early` =
  // (next - n P) denominator.
  std::int64_t whole_ = 1, part_ = 0, denominator_ = 1;
  std::int64_t next_ = 0, early_ = 0, count_ = 0;
  double period_ = 0.;
};

struct LineDescription {
  std::optional<Rational> rate;  ///< of sampling [Hz]; none: every step
  Rational delay;                ///< from a sample to its arrival [s]
  double noise = 0.;  ///< standard deviation of what is added to a sample, in the unit of the value
  std::uint64_t stream_seed = 0;  ///< key of its noise, see stream_key
  double initial =
      0.;  ///< output before the first arrival: the initial value of the port that it drives
  bool mean = false;  ///< a sample is the mean over the steps since the last one, its own included
};

/// A plain value: a copy is a checkpoint.
class TransmissionLine {
 public:
  /// `dt` [s] > 0. Throws std::invalid_argument (rate or dt <= 0, delay or noise < 0, more than ten
  /// million samples under way) or std::overflow_error, with a text for the user.
  TransmissionLine(const LineDescription& description, const Rational& dt);

  /// The output at time `step` dt when the source has `source_value` then. Samples when due; a
  /// sample taken at step k arrives at the first step whose time is not before k dt + delay; holds
  /// otherwise. Called with every step once, in order, from 0 on. Allocates nothing.
  double at(std::int64_t step, double source_value) {
    sample(step, source_value);
    return deliver(step);
  }
  /// The two halves of `at`, each called with every step once. Where the delay is at least a step
  /// they may be called in either order: a value can then be delivered before the one that is
  /// sampled is known.
  void sample(std::int64_t step, double source_value) {
    if (mean_) {
      sum_ += source_value;
      ++summed_;
    }
    if (schedule_.due(step)) take(step, source_value);
  }
  double deliver(std::int64_t step) {
    while (under_way_ > 0 && ring_[first_].arrival <= step) arrive();
    return output_;
  }
  /// Whether a sample arrives in a later step than that in which it was taken.
  bool delayed() const { return delay_ > 0; }
  /// Whether the output of every step is the source's value of that step: a copy does as well, and
  /// the line then carries nothing.
  bool copies() const { return passes() && noise_ == 0.; }
  /// The step of the last sample, when `step` has been; -1 before the first.
  std::int64_t last_sample(std::int64_t step) const {
    if (passes()) return step;
    return schedule_.count() == 0 ? -1 : schedule_.step_of(schedule_.count() - 1);
  }
  /// The output of the last step.
  double output() const { return output_; }

  /// The state as numbers, for records from which a run is resumed: `state_size()` of them, the
  /// same for the life of the line: samples taken, output, samples under way, then the n-th sample
  /// at n modulo the ring's size; of a mean the sum since the last sample and of how many steps.
  /// None where every step's value is the output of that step: its samples are as many as there
  /// were steps.
  std::size_t state_size() const { return passes() ? 0 : 3 + ring_.size() + (mean_ ? 2 : 0); }
  /// The names of these numbers.
  std::string state_layout() const;
  void save(std::span<double> state) const;
  /// As after `step`, of which the numbers are. Where there are none `output` is that of the next
  /// step on.
  void restore(std::int64_t step, std::span<const double> state);

 private:
  struct Sample {
    std::int64_t arrival;  // step
    double value;
  };

  void take(std::int64_t step, double source_value);
  void arrive();
  bool passes() const { return delay_ == 0 && schedule_.every_step(); }

  Schedule schedule_;
  RandomStream stream_;
  double noise_;
  std::int64_t delay_;  // steps
  double output_;
  bool mean_;                // of more than one step
  double sum_ = 0.;          // since the last sample
  std::int64_t summed_ = 0;  // of so many steps
  // Samples under way: a ring, the n-th sample at n modulo its size, oldest at first_.
  std::vector<Sample> ring_;
  std::size_t first_ = 0, under_way_ = 0;
};

}  // namespace hookpoint::control
