#include "apps/python/tables.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// The number that a cell holds: NaN when it is empty, nothing when it is a word.
std::optional<double> number_of(const std::string& cell) {
  if (cell.empty()) return std::nan("");
  double value = 0.;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? std::optional(value)
                                                                  : std::nullopt;
}

/// "foot_slip_seeds [m]": the numbers of several runs.
bool holds_seeds(const std::string& title) {
  return title.substr(0, title.find(" [")).ends_with("_seeds");
}

/// Columns of words, should one be empty throughout or hold names that read as numbers.
bool holds_words(const std::string& title) {
  constexpr std::array words{
      "subject", "engine",   "law",         "integrator", "settings", "study",      "regime",
      "metric",  "scene",    "truth",       "unit",       "allowed",  "ok",         "status",
      "stage",   "feasible", "recommended", "objective",  "constant", "identified", "at_end",
      "reason",  "other",    "held_out",    "trace",      "port"};
  return title.ends_with("_ok") || holds_seeds(title) ||
         std::ranges::find(words, title) != words.end();
}

/// A column of the table: numbers where all cells are, else words.
py::object column_of(const output::CsvTable& table, std::size_t column) {
  const auto rows = static_cast<py::ssize_t>(table.rows.size());
  py::array_t<double> numbers(rows);
  py::list words;
  bool all_numbers = !holds_words(table.header[column]);
  for (py::ssize_t row = 0; row < rows; ++row) {
    const std::string& cell = table.rows[static_cast<std::size_t>(row)][column];
    const std::optional<double> number = number_of(cell);
    if (number) numbers.mutable_at(row) = *number;
    all_numbers = all_numbers && number.has_value();
    words.append(cell);
  }
  if (all_numbers) return numbers;
  return py::array(words);
}

py::object object_of(const output::CsvTable& table) {
  py::dict columns;
  for (std::size_t i = 0; i < table.header.size(); ++i)
    columns[py::str(table.header[i])] = column_of(table, i);
  return columns;
}

py::object object_of(const studies::Pivot& pivot) {
  const auto rows = static_cast<py::ssize_t>(pivot.rows.size());
  const auto columns = static_cast<py::ssize_t>(pivot.columns.size());
  py::array_t<double> values({rows, columns});
  double* value = values.mutable_data();
  for (const studies::PivotCell& cell : pivot.cells) *value++ = cell.mean.value_or(std::nan(""));
  py::dict made;
  made["title"] = pivot.title;
  made["note"] = pivot.note;
  made["down"] = pivot.down;
  made["across"] = pivot.across;
  made["metric"] = pivot.metric;
  made["rows"] = pivot.rows;
  made["columns"] = pivot.columns;
  made["values"] = values;
  return made;
}

py::object object_of(const std::vector<studies::IdleBlock>& blocks) {
  py::list list;
  for (const studies::IdleBlock& block : blocks) {
    py::dict entry;
    entry["kind"] = block.kind;
    entry["name"] = block.name;
    entry["why"] = block.idleness.why;
    entry["fault"] = block.idleness.idle == studies::Idle::fault;
    list.append(entry);
  }
  return list;
}

py::object object_of(bool value) { return py::bool_(value); }
py::object object_of(int value) { return py::int_(value); }
py::object object_of(const std::string& text) { return py::str(text); }
py::object object_of(const std::vector<std::string>& texts) { return py::cast(texts); }
py::object object_of(const studies::ResultValues& values) { return dict_of(values); }

py::object object_of(const std::vector<studies::ResultValues>& entries) {
  py::list list;
  for (const studies::ResultValues& entry : entries) list.append(dict_of(entry));
  return list;
}

py::object object_of(const studies::JsonText& json) {
  return py::module_::import("json").attr("loads")(json.text);
}

}  // namespace

py::dict dict_of(const studies::ResultValues& values) {
  py::dict made;
  for (const auto& [name, value] : values)
    made[py::str(name)] =
        std::visit([](const auto& one) { return object_of(one); }, value.any->value);
  return made;
}

}  // namespace hookpoint::python
