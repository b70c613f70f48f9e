#include "studies/results/pivot.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <map>

#include "output/files/csv.h"
#include "studies/results/selection.h"
#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// One side of a table: the subjects, or the values of a sweep.
class PivotSide {
 public:
  PivotSide(const StudyResult& study, const std::string& name) : sweep_(sweep_index(study, name)) {
    if (!sweep_) {
      title = "subject";
      for (const SubjectInfo& subject : study.subjects) labels.push_back(subject.name);
      return;
    }
    const SweepColumn& column = study.sweeps[*sweep_];
    title = output::column_title(spoken(column.name), column.unit);
    values_ = column.values;
    for (const double value : values_) labels.push_back(label_of(column, value));
  }
  std::size_t place_of(const RunResult& row) const {
    if (!sweep_) return static_cast<std::size_t>(row.subject);
    const auto found = std::ranges::find_if(
        values_, [&](double value) { return same_value(value, row.parameters[*sweep_]); });
    return static_cast<std::size_t>(found - values_.begin());
  }

  std::string title;
  std::vector<std::string> labels;

 private:
  std::optional<std::size_t> sweep_;
  std::vector<double> values_;
};

/// What falls into a cell, as it is read.
struct CellSums {
  double measured = 0., predicted = 0.;
  int predictions = 0;
};

void add_value(PivotCell& cell, CellSums& sums, const MetricValue& value) {
  ++cell.rows;
  if (value.ok) ++(*value.ok ? cell.passed : cell.failed);
  if (!value.measured || !std::isfinite(*value.measured)) return;
  const double measured = *value.measured;
  cell.least = cell.values == 0 ? measured : std::min(cell.least, measured);
  cell.largest = cell.values == 0 ? measured : std::max(cell.largest, measured);
  ++cell.values;
  sums.measured += measured;
  if (!value.predicted) return;
  sums.predicted += *value.predicted;
  ++sums.predictions;
}

/// The values of a cell by their seeds; each seed's value is their mean.
class SeedMeans {
 public:
  void add(double seed, const std::optional<double>& value) {
    Sum& sum = sums_[seed];
    ++sum.runs;
    if (value && std::isfinite(*value)) {
      sum.value += *value;
    } else {
      whole_ = false;
    }
  }
  /// Nothing where a run has no value, or a seed has fewer runs than another.
  std::optional<MeanInterval> interval() const {
    std::vector<double> means;
    for (const auto& [seed, sum] : sums_) {
      if (!whole_ || sum.runs != sums_.begin()->second.runs) return std::nullopt;
      means.push_back(sum.value / sum.runs);
    }
    return mean_interval(means);
  }

 private:
  struct Sum {
    double value = 0.;
    int runs = 0;
  };
  std::map<double, Sum> sums_;
  bool whole_ = true;
};

/// Intervals over the seeds, and of the differences to the first subject.
class SeedIntervals {
 public:
  SeedIntervals(const StudyResult& study, std::size_t metric, std::size_t cells)
      : seed_(*study.seed_sweep), metric_(metric), values_(cells), differences_(cells) {}

  /// A run of the subject that others differ from.
  void add_first(const RunResult& row) { first_[row.parameters] = row.metrics[metric_].measured; }
  void add(std::size_t cell, const RunResult& row) {
    values_[cell].add(row.parameters[seed_], row.metrics[metric_].measured);
  }
  void add_difference(std::size_t cell, const RunResult& row) {
    const auto first = first_.find(row.parameters);
    if (first == first_.end()) return;
    const auto& value = row.metrics[metric_].measured;
    differences_[cell].add(row.parameters[seed_], value && first->second
                                                      ? std::optional(*value - *first->second)
                                                      : std::nullopt);
  }
  void put(std::vector<PivotCell>& cells) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i].interval = values_[i].interval();
      cells[i].difference = differences_[i].interval();
    }
  }

 private:
  std::size_t seed_, metric_;
  std::vector<SeedMeans> values_, differences_;
  std::map<std::vector<double>, std::optional<double>> first_;
};

/// Leaves out the lines that no run falls into.
void drop_empty_lines(Pivot& pivot) {
  std::vector<std::size_t> rows, columns;
  const auto occurs = [&](std::size_t row, std::size_t column) {
    return pivot.at(row, column).rows > 0;
  };
  for (std::size_t row = 0; row < pivot.rows.size(); ++row)
    for (std::size_t column = 0; column < pivot.columns.size(); ++column)
      if (occurs(row, column)) {
        if (rows.empty() || rows.back() != row) rows.push_back(row);
        if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
      }
  std::ranges::sort(columns);
  Pivot kept = pivot;
  kept.rows.clear();
  kept.columns.clear();
  kept.cells.clear();
  for (const std::size_t column : columns) kept.columns.push_back(pivot.columns[column]);
  for (const std::size_t row : rows) {
    kept.rows.push_back(pivot.rows[row]);
    for (const std::size_t column : columns) kept.cells.push_back(pivot.at(row, column));
  }
  pivot = std::move(kept);
}

/// What several rows of a cell differ in, then what the Table's Only blocks fix.
std::string note_of(const StudyResult& study, const TableSpec& table, bool several) {
  std::vector<std::string> over;
  std::string fixed;
  for (const SweepColumn& sweep : study.sweeps) {
    if (study.seed_sweep && &sweep == &study.sweeps[*study.seed_sweep]) continue;
    const auto admitted = std::ranges::find_if(
        table.where, [&](const auto& where) { return where.first == sweep.name; });
    const std::vector<double>& values =
        admitted == table.where.end() ? sweep.values : admitted->second;
    if (sweep.name == table.rows || sweep.name == table.columns) continue;
    if (values.size() > 1) over.push_back(spoken(sweep.name));
    if (values.size() == 1 && sweep.values.size() > 1)
      fixed += "; " + spoken(sweep.name) + " = " + label_of(sweep, values.front()) +
               (sweep.unit.empty() ? "" : " " + sweep.unit);
  }
  const std::size_t subjects =
      table.subjects.empty() ? study.subjects.size() : table.subjects.size();
  if (table.rows != "subject" && table.columns != "subject" && subjects > 1)
    over.insert(over.begin(), "subjects");
  std::string text;
  for (std::size_t i = 0; several && i < over.size(); ++i)
    text += (i == 0 ? "; mean over " : " and ") + over[i];
  text += fixed;
  return text.empty() ? "" : text.substr(2);
}

}  // namespace

namespace {

using Entering = std::vector<std::pair<std::size_t, const RunResult*>>;

void add_intervals(Pivot& pivot, const StudyResult& study, const TableSpec& table,
                   std::size_t metric, const Entering& entering) {
  pivot.seeds = study.sweeps[*study.seed_sweep].values.size();
  SeedIntervals intervals(study, metric, pivot.cells.size());
  const bool by_subject = table.rows == "subject" || table.columns == "subject";
  int first = INT_MAX, last = -1;
  for (const auto& [cell, row] : entering) {
    first = std::min(first, row->subject);
    last = std::max(last, row->subject);
  }
  const bool paired = by_subject && first < last;
  if (paired) pivot.first = study.subjects[static_cast<std::size_t>(first)].name;
  for (const auto& [cell, row] : entering)
    if (row->subject == first) intervals.add_first(*row);
  for (const auto& [cell, row] : entering) {
    intervals.add(cell, *row);
    if (paired && row->subject != first) intervals.add_difference(cell, *row);
  }
  intervals.put(pivot.cells);
}

}  // namespace

std::optional<std::pair<std::string, std::string>> spread_of(const PivotCell& cell) {
  if (cell.values < 2) return std::nullopt;
  std::pair spread{text::rounded(cell.least, 3), text::rounded(cell.largest, 3)};
  if (spread.first == spread.second) return std::nullopt;
  return spread;
}

std::string text_of(const MeanInterval& interval) {
  return text::rounded(interval.mean) + " ± " + text::rounded(interval.half_width, 2);
}

std::string interval_note(const Pivot& pivot) {
  if (pivot.seeds == 0) return "";
  return "± half the 95 % interval (Student's t) over " + std::to_string(pivot.seeds) + " seeds";
}

std::vector<TableSpec> shown_tables(const StudyResult& study) {
  constexpr std::size_t most_columns = 12;
  const auto metric = std::ranges::find(study.metrics, false, &MetricColumn::timing);
  if (!study.tables.empty() || study.sweeps.size() != 1 || metric == study.metrics.end())
    return study.tables;
  const std::size_t values = study.sweeps.front().values.size();
  if (values < 2 || values > most_columns) return {};
  return {{"", "", "subject", study.sweeps.front().name, metric->name, {}, {}}};
}

Pivot pivot_of(const StudyResult& table_study, const TableSpec& table) {
  const StudyResult& study = table_study.runs != nullptr ? *table_study.runs : table_study;
  const std::size_t metric = metric_index(study, table.value).value();
  const PivotSide down(study, table.rows), across(study, table.columns);
  Pivot pivot;
  pivot.title = output::column_title(table.title.empty() ? spoken(table.value) : table.title,
                                     study.metrics[metric].unit);
  pivot.down = down.title;
  pivot.across = across.title;
  pivot.unit = study.metrics[metric].unit;
  pivot.metric = output::column_title(table.value, pivot.unit);
  pivot.rows = down.labels;
  pivot.columns = across.labels;
  pivot.cells.resize(pivot.rows.size() * pivot.columns.size());
  std::vector<CellSums> sums(pivot.cells.size());
  std::vector<std::pair<std::size_t, const RunResult*>> entering;
  for (const RunResult& row : study.rows) {
    if (!table.subjects.empty() &&
        std::ranges::find(table.subjects, row.subject) == table.subjects.end())
      continue;
    if (metric >= row.metrics.size() || !admits(study, table.where, row)) continue;
    const std::size_t cell = down.place_of(row) * pivot.columns.size() + across.place_of(row);
    add_value(pivot.cells[cell], sums[cell], row.metrics[metric]);
    if (study.seed_sweep) entering.emplace_back(cell, &row);
  }
  if (study.seed_sweep) add_intervals(pivot, study, table, metric, entering);
  for (std::size_t i = 0; i < pivot.cells.size(); ++i) {
    PivotCell& cell = pivot.cells[i];
    if (cell.values == 0) continue;
    cell.mean = sums[i].measured / cell.values;
    if (sums[i].predictions == cell.values) cell.predicted = sums[i].predicted / cell.values;
    pivot.predicted |= cell.predicted.has_value();
    pivot.several |= cell.values > 1;
  }
  drop_empty_lines(pivot);
  pivot.note = note_of(study, table, pivot.several);
  return pivot;
}

}  // namespace hookpoint::studies
