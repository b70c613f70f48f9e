// What plots draw: every step's values of the ports that are plotted, for the whole run, in a
// bounded memory.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace hookpoint::view {

/// The least and the greatest of some values, in the order in which they came; NaN of none. What is
/// not a number does not count.
class Extremes {
 public:
  void add(double value);
  double first() const { return greatest_last_ ? least_ : greatest_; }
  double second() const { return greatest_last_ ? greatest_ : least_; }

 private:
  double least_ = std::numeric_limits<double>::quiet_NaN();
  double greatest_ = std::numeric_limits<double>::quiet_NaN();
  bool greatest_last_ = true;
};

/// Columns of samples over one row of instants. Where the room is used up, each stretch of samples
/// becomes two, a column's least and greatest value in their order, at the stretch's beginning and
/// middle: no extreme is ever lost, and its instant is right to within the stretch.
class Traces {
 public:
  /// Of a page's wishes together, with those of its plots: each costs memory at every instant.
  static constexpr std::size_t most_columns = 256;

  /// `most`: instants kept; even, at least 4.
  explicit Traces(std::size_t most = 500'000) : most_(most) {}

  /// Begins a column, whose earlier values are not known (NaN). False where it is there already.
  bool add(const std::string& trail);
  const std::vector<std::string>& trails() const { return trails_; }

  /// `values`: one a column, in their order. Amortised O(columns).
  void sample(double time, std::span<const double> values);
  /// Forgets what lies after `time`: the run continues from there.
  void cut(double time);
  /// Forgets all samples; the columns stay.
  void clear();

  struct Extract {
    std::vector<double> times;
    std::vector<std::vector<double>> values;  ///< one row a trail; NaN where it is not known
  };
  /// From `from` to `to` [s], at most about `points` instants: where there are more, each stretch
  /// of them gives two, as above. O(instants between them).
  Extract extract(const std::vector<std::string>& trails, double from, double to,
                  std::size_t points) const;

 private:
  void begin_stretch();
  void thin();

  std::size_t most_;
  std::vector<std::string> trails_;
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;
  std::size_t stretch_ = 1;  ///< samples that become two; 1: all are kept
  // The stretch under way.
  std::size_t waiting_ = 0;
  double begin_ = 0., middle_ = 0.;
  std::vector<Extremes> extremes_;
};

}  // namespace hookpoint::view
