#include "studies/compare/comparison_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "studies/run/run_folder.h"

namespace hookpoint::studies {
namespace {

using output::CsvTable;

std::vector<std::string> key_columns(const CsvTable& table) {
  const auto subject = std::ranges::find(table.header, "subject");
  if (subject == table.header.end())
    throw RunFolderError("a results.csv has no column `subject`: it is not a study's");
  return {table.header.begin(), subject + 1};
}

/// "slope [deg]" and "15" as "slope = 15 deg"; the subject alone.
std::string labelled(const std::string& column, const std::string& value) {
  if (column == "subject") return value;
  const auto bracket = column.find(" [");
  if (bracket == std::string::npos) return column + " = " + value;
  const std::string unit = column.substr(bracket + 2, column.size() - bracket - 3);
  return column.substr(0, bracket) + " = " + value + " " + unit;
}

std::vector<std::string> labels_of(const CsvTable& table, const std::vector<std::string>& columns) {
  std::vector<std::string> labels;
  for (const auto& row : table.rows) {
    std::string label;
    for (const std::string& column : columns) {
      const auto place = std::ranges::find(table.header, column) - table.header.begin();
      label += (label.empty() ? "" : ", ") + labelled(column, row[static_cast<std::size_t>(place)]);
    }
    labels.push_back(std::move(label));
  }
  return labels;
}

std::map<std::string, std::size_t> places_of(const std::vector<std::string>& labels,
                                             const std::vector<std::string>& own,
                                             const std::vector<std::string>& shared) {
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (places.emplace(labels[i], i).second) continue;
    throw RunFolderError(
        fmt::format("rows cannot be brought together: one run has several with {}; it varies {}, "
                    "and both vary {} only",
                    labels[i], fmt::join(own, ", "), fmt::join(shared, ", ")));
  }
  return places;
}

}  // namespace

RowJoin join_rows(const CsvTable& first, const CsvTable& second) {
  RowJoin join;
  const std::vector<std::string> first_keys = key_columns(first), second_keys = key_columns(second);
  for (const std::string& column : first_keys)
    if (std::ranges::find(second_keys, column) != second_keys.end()) join.columns.push_back(column);
  join.first_labels = labels_of(first, join.columns);
  join.second_labels = labels_of(second, join.columns);
  const auto in_first = places_of(join.first_labels, first_keys, join.columns);
  const auto in_second = places_of(join.second_labels, second_keys, join.columns);
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    const auto partner = in_second.find(join.first_labels[i]);
    if (partner == in_second.end())
      join.only_first.push_back(i);
    else
      join.pairs.emplace_back(i, partner->second);
  }
  for (std::size_t i = 0; i < second.rows.size(); ++i)
    if (!in_first.contains(join.second_labels[i])) join.only_second.push_back(i);
  return join;
}

}  // namespace hookpoint::studies
