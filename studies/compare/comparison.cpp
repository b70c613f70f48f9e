#include "studies/compare/comparison.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "studies/compare/comparison_rows.h"

namespace hookpoint::studies {
namespace {

using output::CsvTable;

/// Whether a setting is another whenever the same run is repeated.
bool changes_always(const std::string& trail) {
  return trail == "date" || trail == "file" || trail.starts_with("host.");
}

/// Settings whose values differ, in the first list's order, then those that only the second has.
std::vector<SettingDifference> differences(const SettingList& first, const SettingList& second) {
  const std::map<std::string, std::string> there(second.begin(), second.end());
  std::set<std::string> seen;
  std::vector<SettingDifference> result;
  for (const auto& [trail, value] : first) {
    if (!seen.insert(trail).second) continue;
    const auto other = there.find(trail);
    if (other == there.end())
      result.push_back({trail, value, std::nullopt});
    else if (other->second != value)
      result.push_back({trail, value, other->second});
  }
  for (const auto& [trail, value] : second)
    if (seen.insert(trail).second) result.push_back({trail, std::nullopt, value});
  return result;
}

std::optional<double> number(const std::string& text) {
  double value = 0.;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_verdict(const std::string& column) { return column == "ok" || column.ends_with("_ok"); }

/// Whether column `i` of a Wall's or a Matrix's table holds measurements: neither words about a row,
/// nor closed forms and what follows from them.
bool is_listed_metric(const std::vector<std::string>& header, std::size_t i) {
  static const std::set<std::string> others{"engine", "law",      "integrator", "settings", "unit",
                                            "status", "expected", "error",      "allowed",  "ok"};
  return !others.contains(header[i]);
}

/// Whether column `i` of a Study's table is a metric: its closed form and its verdict follow it.
/// Its name does not decide, which the user may have chosen.
bool is_metric_of_study(const std::vector<std::string>& header, std::size_t i) {
  const std::string& title = header[i];
  const std::size_t end = std::min(title.find(" ["), title.size());
  const std::string name = title.substr(0, end);
  return i + 2 < header.size() && header[i + 1] == name + "_predicted" + title.substr(end) &&
         header[i + 2] == name + "_ok";
}

/// Titles of the metrics of a results.csv, matrix.csv or timing.csv.
std::set<std::string> metrics_of(const std::vector<std::string>& header) {
  static const std::set<std::pair<std::string, std::string>> no_study{{"scene", "truth"},
                                                                      {"study", "regime"}};
  const bool listed = header.size() > 1 && no_study.contains({header[0], header[1]});
  std::set<std::string> titles;
  for (std::size_t i = 0; i < header.size(); ++i)
    if (listed ? is_listed_metric(header, i) : is_metric_of_study(header, i))
      titles.insert(header[i]);
  return titles;
}

bool differ(double first, double second, double tolerance) {
  const double scale = std::max(std::abs(first), std::abs(second));
  return scale > round_off && !(std::abs(second - first) <= tolerance * scale);
}

void add_value(MetricComparison& metric, const std::string& row, const std::string& first_text,
               const std::string& second_text, double tolerance) {
  const auto first = number(first_text), second = number(second_text);
  if (!first && !second) return;
  ++metric.rows;
  ValueDifference value{row, first, second};
  if (first && second) {
    const double scale = std::max(std::abs(*first), std::abs(*second));
    value.absolute = std::abs(*second - *first);
    value.relative = scale > round_off ? value.absolute / scale : 0.;
    metric.greatest_absolute = std::max(metric.greatest_absolute, value.absolute);
    metric.greatest_relative = std::max(metric.greatest_relative, value.relative);
    if (!differ(*first, *second, tolerance)) return;
  }
  metric.differences.push_back(std::move(value));
}

/// Compares the columns of the first table that the second has too.
void compare_tables(const CsvTable& first, const CsvTable& second, bool timing,
                    Comparison& comparison) {
  const RowJoin join = join_rows(first, second);
  const std::set<std::string> metrics = metrics_of(first.header);
  const auto subject = std::ranges::find(first.header, "subject") - first.header.begin();
  for (auto i = static_cast<std::size_t>(subject) + 1; i < first.header.size(); ++i) {
    const std::string& title = first.header[i];
    const auto other = std::ranges::find(second.header, title);
    if (other == second.header.end()) {
      if (metrics.contains(title)) comparison.only_first.push_back("metric " + title);
      continue;
    }
    const auto k = static_cast<std::size_t>(other - second.header.begin());
    MetricComparison metric;
    metric.title = title;
    metric.timing = timing;
    for (const auto& [a, b] : join.pairs) {
      const std::string& left = first.rows[a][i];
      const std::string& right = second.rows[b][k];
      if (metrics.contains(title))
        add_value(metric, join.first_labels[a], left, right, comparison.tolerance);
      else if (!timing && left != right && (is_verdict(title) || title == "status"))
        comparison.words.push_back({join.first_labels[a], title, left, right});
    }
    if (metrics.contains(title)) comparison.metrics.push_back(std::move(metric));
  }
  const std::set<std::string> second_metrics = metrics_of(second.header);
  for (const std::string& title : second.header)
    if (second_metrics.contains(title) &&
        std::ranges::find(first.header, title) == first.header.end() &&
        std::ranges::find(join.columns, title) == join.columns.end())
      comparison.only_second.push_back("metric " + title);
  if (timing) return;
  comparison.joined_by = join.columns;
  for (const std::size_t row : join.only_first)
    comparison.only_first.push_back("row " + join.first_labels[row]);
  for (const std::size_t row : join.only_second)
    comparison.only_second.push_back("row " + join.second_labels[row]);
}

}  // namespace

void compare_settings(const RunFolder& first, const RunFolder& second, Comparison& comparison) {
  comparison.experiment = differences(first.experiment, second.experiment);
  comparison.provenance = differences(first.provenance, second.provenance);
  std::erase_if(comparison.provenance,
                [](const SettingDifference& each) { return changes_always(each.trail); });
}

void compare_results(const RunFolder& first, const RunFolder& second, Comparison& comparison) {
  if (first.results.has_value() != second.results.has_value())
    throw RunFolderError((first.results ? second : first).path.string() + " is a single run and " +
                         (first.results ? first : second).path.string() +
                         " a study: compare two of a kind");
  if (first.results) compare_tables(*first.results, *second.results, false, comparison);
  if (first.timing && second.timing)
    compare_tables(*first.timing, *second.timing, true, comparison);
}

bool TrajectoryComparison::differs() const {
  return std::ranges::any_of(channels, [](const auto& each) { return each.parts_at.has_value(); });
}

bool Comparison::same() const {
  if (nothing_measured)
    return experiment.empty() && std::ranges::none_of(provenance, [](const auto& each) {
             return each.trail.starts_with("inputs.");
           });
  const bool metrics_agree = std::ranges::all_of(
      metrics, [](const auto& metric) { return metric.timing || metric.differences.empty(); });
  return metrics_agree && only_first.empty() && only_second.empty() && words.empty() &&
         std::ranges::none_of(trajectories, &TrajectoryComparison::differs);
}

Comparison compare_runs(const RunFolder& first, const RunFolder& second, double tolerance) {
  Comparison comparison;
  comparison.first = first.path.string();
  comparison.second = second.path.string();
  comparison.tolerance = tolerance;
  compare_settings(first, second, comparison);
  compare_results(first, second, comparison);
  compare_trajectories(first, second, comparison);
  for (const RunFolder* run : {&first, &second})
    for (const std::string& note : run->notes)
      comparison.notes.push_back(run->path.string() + ": " + note);
  comparison.nothing_measured = comparison.metrics.empty() && comparison.trajectories.empty() &&
                                comparison.only_first.empty() && comparison.only_second.empty();
  return comparison;
}

}  // namespace hookpoint::studies
