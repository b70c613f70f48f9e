// Two runs side by side: what differs in their settings, metric by metric, trajectory by
// trajectory. Plain values, made from two folders; the same folders give the same text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/report/terminal_table.h"
#include "studies/run/run_folder.h"

namespace hookpoint::studies {

/// Two numbers a, b are the same when |a - b| <= tolerance * scale: for a metric its scale is the
/// greater magnitude of the two, for a channel of a trajectory the greatest magnitude that it has
/// in either run. Magnitudes under `round_off` count as zero.
constexpr double default_tolerance = 1e-9;
constexpr double round_off = 1e-16;  ///< SI, as in the grey strip of figures

struct SettingDifference {
  std::string trail;
  std::optional<std::string> first, second;  ///< none: it is not there
};

/// One row's value of one metric that differs.
struct ValueDifference {
  std::string row;                      ///< "slope = 15, mu = 0.8, ode_default"
  std::optional<double> first, second;  ///< none: not measured
  double absolute = 0., relative = 0.;  ///< |second - first|, and over the greater magnitude
};

/// A verdict or a status that is another in the second run.
struct WordChange {
  std::string row, what;  ///< what: "creep_speed_ok" or "status"
  std::string first, second;
};

struct MetricComparison {
  std::string title;    ///< "creep_speed [m/s]"
  bool timing = false;  ///< reported, but no reason to call runs different: no two are alike
  int rows = 0;         ///< where at least one run has a value
  std::vector<ValueDifference> differences;
  double greatest_absolute = 0., greatest_relative = 0.;  ///< over rows that both have
};

struct ChannelComparison {
  std::string title;                       ///< "world.block.position.x [m]"
  double greatest = 0., greatest_at = 0.;  ///< difference, and when [s]
  double allowed = 0.;
  std::optional<double> parts_at;  ///< first time of a difference above `allowed` [s]
};

struct TrajectoryComparison {
  std::string name;  ///< "trace.csv", or plot and row of a study
  std::size_t instants = 0;
  bool interpolated = false;  ///< no times in common: the second is taken linearly between its own
  std::vector<ChannelComparison> channels;
  bool differs() const;
};

struct Comparison {
  std::string first, second;  ///< the folders as given
  double tolerance = default_tolerance;
  std::vector<SettingDifference> experiment, provenance;
  std::vector<std::string> joined_by;
  std::vector<std::string> only_first, only_second;  ///< rows and trajectories of one run alone
  std::vector<MetricComparison> metrics;
  std::vector<WordChange> words;
  std::vector<TrajectoryComparison> trajectories;
  std::vector<std::string> notes;
  bool nothing_measured = false;  ///< neither rows nor trajectories: the experiments decide

  /// Whether results agree within the tolerance. Settings and speeds do not count.
  bool same() const;
};

/// Throws RunFolderError when one is a study and the other a single run, or when their rows cannot
/// be joined.
Comparison compare_runs(const RunFolder& first, const RunFolder& second, double tolerance);

// The three parts, each in its own file; they fill theirs of `comparison`.
void compare_settings(const RunFolder& first, const RunFolder& second, Comparison& comparison);
void compare_results(const RunFolder& first, const RunFolder& second, Comparison& comparison);
void compare_trajectories(const RunFolder& first, const RunFolder& second, Comparison& comparison);

std::string comparison_text(const Comparison& comparison, const TableStyle& style);
std::string comparison_json(const Comparison& comparison);

}  // namespace hookpoint::studies
