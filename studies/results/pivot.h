// A Table block as numbers: a metric over two of what the study varied, each cell the mean of its
// rows. The report, the terminal and the Table's CSV print the same one.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/results/result.h"
#include "studies/results/seed_means.h"
#include "studies/results/statistics.h"

namespace hookpoint::studies {

struct PivotCell {
  int rows = 0;                     ///< of the study that fall into it
  int values = 0;                   ///< of these, those with a finite measurement
  std::optional<double> mean;       ///< of these values
  double least = 0., largest = 0.;  ///< of the same
  std::optional<double> predicted;  ///< mean closed form, where every one of them has one
  int passed = 0, failed = 0;       ///< verdicts of the metric
  /// Of a study with seeds: the mean with its 95 % interval over the seeds, each seed's value the
  /// mean of its runs in the cell; nothing where a run has no value.
  std::optional<MeanInterval> interval;
  /// The same of the differences to the first subject's runs of equal swept values and seed.
  std::optional<MeanInterval> difference;
};

struct Pivot {
  std::string title;         ///< with the metric's unit
  std::string note;          ///< "mean over mu and dt; slope = 15 deg", "" for nothing to say
  std::string down, across;  ///< "subject", "slope [deg]"
  std::string metric, unit;  ///< "creep_speed [m/s]", "m/s"
  std::vector<std::string> rows, columns;  ///< labels
  std::vector<PivotCell> cells;            ///< row by row
  bool predicted = false;                  ///< some cell has a closed form
  bool several = false;                    ///< some cell has several values
  std::size_t seeds = 0;                   ///< runs of each row; 0 for the scene's own seed
  std::string first;  ///< subject that others differ from; "" where none is a row or column

  const PivotCell& at(std::size_t row, std::size_t column) const {
    return cells[row * columns.size() + column];
  }
};

/// Least and largest of the cell's values as text, to three digits; nothing where these are the
/// same.
std::optional<std::pair<std::string, std::string>> spread_of(const PivotCell& cell);

/// "1.25 ± 0.1": the mean and half the width of its interval.
std::string text_of(const MeanInterval& interval);
/// What the intervals of a Table are; "" for a study without seeds.
std::string interval_note(const Pivot& pivot);

/// The study's Tables; of one without, that varied one thing, its first metric by subject and
/// value: a worst or a median alone says nothing of how what was varied matters.
std::vector<TableSpec> shown_tables(const StudyResult& study);

/// Rows and columns that no run of the Table falls into are left out.
Pivot pivot_of(const StudyResult& study, const TableSpec& table);

}  // namespace hookpoint::studies
