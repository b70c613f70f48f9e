// Trajectories of two runs: channel by channel, where both have a row.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "output/files/hash.h"
#include "studies/compare/comparison.h"
#include "studies/compare/comparison_rows.h"

namespace hookpoint::studies {
namespace {

using output::CsvTable;
using Column = std::vector<double>;

/// Numbers of a column, NaN for a cell that is none ("", a word).
Column column(const CsvTable& table, std::size_t index) {
  Column values;
  for (const auto& row : table.rows) {
    const char* const end = row[index].data() + row[index].size();
    double value = 0.;
    const auto [stopped, error] = std::from_chars(row[index].data(), end, value);
    const bool whole = error == std::errc{} && stopped == end;
    values.push_back(whole ? value : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

/// Which rows, or points between rows, of the second stand beside which rows of the first.
struct Alignment {
  struct Beside {
    std::size_t first, second;
    double part = 0.;  ///< of the way from row `second` to the next
  };
  std::vector<Beside> instants;
  bool interpolated = false;
};

bool same_time(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1e-6, std::abs(a), std::abs(b)});
}

Alignment align(const Column& first, const Column& second) {
  Alignment alignment;
  for (std::size_t i = 0, k = 0; i < first.size() && k < second.size();) {
    if (same_time(first[i], second[k]))
      alignment.instants.push_back({i++, k++});
    else
      ++(first[i] < second[k] ? i : k);
  }
  // At time 0 all runs have a row, which says nothing of where they go.
  if (alignment.instants.size() > 1 || first.size() < 2 || second.size() < 2) return alignment;
  alignment = {{}, true};
  for (std::size_t i = 0, k = 0; i < first.size(); ++i) {
    if (first[i] < second.front() || first[i] > second.back()) continue;
    while (k + 2 < second.size() && second[k + 1] < first[i]) ++k;
    const double span = second[k + 1] - second[k];
    alignment.instants.push_back({i, k, span > 0. ? (first[i] - second[k]) / span : 0.});
  }
  return alignment;
}

double greatest_magnitude(const Column& values) {
  double greatest = 0.;
  for (const double value : values)
    if (std::isfinite(value)) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

ChannelComparison compare_channel(const std::string& title, const Column& times,
                                  const Column& first, const Column& second,
                                  const Alignment& alignment, double tolerance) {
  ChannelComparison channel;
  channel.title = title;
  channel.allowed = std::max(
      round_off, tolerance * std::max(greatest_magnitude(first), greatest_magnitude(second)));
  for (const Alignment::Beside& at : alignment.instants) {
    const double before = second[at.second];
    const double other =
        at.part > 0. ? before + at.part * (second[at.second + 1] - before) : before;
    const double own = first[at.first];
    if (std::isnan(own) && std::isnan(other)) continue;
    const double difference = std::abs(other - own);
    if (!channel.parts_at && !(difference <= channel.allowed)) channel.parts_at = times[at.first];
    if (!(difference > channel.greatest)) continue;
    channel.greatest = difference;
    channel.greatest_at = times[at.first];
  }
  return channel;
}

void compare_one(const std::string& name, const CsvTable& first, const CsvTable& second,
                 Comparison& comparison) {
  TrajectoryComparison trajectory;
  trajectory.name = name;
  const Column times = column(first, 0);
  const Alignment alignment = align(times, column(second, 0));
  trajectory.instants = alignment.instants.size();
  trajectory.interpolated = alignment.interpolated;
  for (std::size_t i = 1; i < first.header.size(); ++i) {
    const std::string& title = first.header[i];
    const auto other = std::ranges::find(second.header, title);
    if (other == second.header.end()) {
      comparison.only_first.push_back("channel " + title + " of " + name);
      continue;
    }
    const auto k = static_cast<std::size_t>(other - second.header.begin());
    trajectory.channels.push_back(compare_channel(title, times, column(first, i), column(second, k),
                                                  alignment, comparison.tolerance));
  }
  for (const std::string& title : second.header)
    if (std::ranges::find(first.header, title) == first.header.end())
      comparison.only_second.push_back("channel " + title + " of " + name);
  if (first.rows.size() != second.rows.size())
    comparison.notes.push_back(
        fmt::format("{}: {} rows and {}", name, first.rows.size(), second.rows.size()));
  comparison.trajectories.push_back(std::move(trajectory));
}

std::string file_of_row(const std::string& plot, std::size_t row) {
  return fmt::format("{}_{:05}.csv", plot, row);
}

/// A study's traces are named by plot and row: the row's partner has another number where the
/// studies differ in their rows.
std::map<std::string, std::string> renamed_by_row(const RunFolder& run,
                                                  const std::vector<std::string>& labels) {
  std::map<std::string, std::string> names;
  for (const auto& [file, table] : run.trajectories) {
    const auto bar = file.rfind('_');
    std::size_t row = labels.size();
    if (bar != std::string::npos)
      std::from_chars(file.data() + bar + 1, file.data() + file.size(), row);
    const bool known = row < labels.size() && file == file_of_row(file.substr(0, bar), row);
    names[known ? file.substr(0, bar) + ", " + labels[row] : file] = file;
  }
  return names;
}

std::map<std::string, std::string> names_of(const RunFolder& run,
                                            const std::vector<std::string>& labels) {
  return run.results ? renamed_by_row(run, labels) : renamed_by_row(run, {});
}

/// Records that are no text have the same bytes or not.
void compare_records(const RunFolder& first, const RunFolder& second, Comparison& comparison) {
  for (const auto& [name, path] : first.records) {
    const auto other = second.records.find(name);
    if (other == second.records.end())
      comparison.only_first.push_back("record " + name);
    else if (output::hash_of_file(path) != output::hash_of_file(other->second))
      comparison.words.push_back({name, "bytes", "its own", "others"});
  }
  for (const auto& [name, path] : second.records)
    if (!first.records.contains(name)) comparison.only_second.push_back("record " + name);
}

}  // namespace

void compare_trajectories(const RunFolder& first, const RunFolder& second, Comparison& comparison) {
  const RowJoin join = first.results ? join_rows(*first.results, *second.results) : RowJoin{};
  const auto own = names_of(first, join.first_labels),
             others = names_of(second, join.second_labels);
  for (const auto& [name, file] : own) {
    const auto other = others.find(name);
    if (other == others.end())
      comparison.only_first.push_back("trajectory " + name);
    else
      compare_one(name, first.trajectories.at(file), second.trajectories.at(other->second),
                  comparison);
  }
  for (const auto& [name, file] : others)
    if (!own.contains(name)) comparison.only_second.push_back("trajectory " + name);
  compare_records(first, second, comparison);
}

}  // namespace hookpoint::studies
