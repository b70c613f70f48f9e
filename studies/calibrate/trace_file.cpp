#include "studies/calibrate/trace_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "language/names.h"
#include "output/file.h"
#include "output/text/csv.h"
#include "output/text/number.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Position;

/// "z [m]" in its parts.
struct ColumnTitle {
  std::string name, unit;
};

ColumnTitle parts_of(const std::string& title) {
  const std::size_t open = title.rfind(" [");
  if (open == std::string::npos || !title.ends_with(']')) return {title, ""};
  return {title.substr(0, open), title.substr(open + 2, title.size() - open - 3)};
}

/// The column of that title, or the only one of that name.
std::optional<std::size_t> column_of(const output::CsvTable& table, const std::string& wanted,
                                     const TraceRequest& request, const Position& place,
                                     Diagnostics& diagnostics) {
  std::optional<std::size_t> named;
  bool several = false;
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    if (table.header[i] == wanted) return i;
    if (parts_of(table.header[i]).name != wanted) continue;
    several = several || named;
    named = i;
  }
  if (named && !several) return named;
  diagnostics.error(place, fmt::format("{} has {} column `{}`{}", request.file.string(),
                                       several ? "more than one" : "no", wanted,
                                       several ? std::string(": say its unit, too")
                                               : language::did_you_mean(wanted, table.header)));
  return std::nullopt;
}

std::optional<language::Unit> unit_of_column(const output::CsvTable& table, std::size_t column,
                                             const TraceRequest& request, const Position& place,
                                             Diagnostics& diagnostics) {
  const ColumnTitle title = parts_of(table.header[column]);
  const auto unit = language::parse_unit(title.unit);
  if (!unit)
    diagnostics.error(place, fmt::format("{}: `{}` of the column `{}` is no unit",
                                         request.file.string(), title.unit, title.name));
  return unit;
}

std::optional<double> number_of(const std::string& text) {
  double value = 0.;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// Turns a table's rows into samples.
class TraceRows {
 public:
  TraceRows(const TraceRequest& request, const output::CsvTable& table, std::size_t time,
            std::size_t value, Diagnostics& diagnostics)
      : request_(request), table_(table), time_(time), value_(value), diagnostics_(diagnostics) {}

  bool read(const language::Unit& time_unit, MeasuredTrace& trace) {
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      if (table_.rows[row][value_].empty()) continue;
      const auto time = field(row, time_), value = field(row, value_);
      if (!time || !value) return false;
      const double seconds = *time * time_unit.numerator / time_unit.denominator;
      if (seconds < 0.) return wrong(row, "begins before 0 s, where the scene does");
      if (!trace.time.empty() && !(seconds > trace.time.back()))
        return wrong(row, fmt::format("its time, {} s, is not after that of the sample before it",
                                      output::shortest(seconds)));
      trace.time.push_back(seconds);
      trace.value.push_back(*value * trace.unit.numerator / trace.unit.denominator);
    }
    if (trace.time.size() >= 2) return true;
    diagnostics_.error(request_.column_place,
                       fmt::format("{}: fewer than two samples in the column `{}`",
                                   request_.file.string(), table_.header[value_]));
    return false;
  }

 private:
  std::optional<double> field(std::size_t row, std::size_t column) {
    const std::string& text = table_.rows[row][column];
    const auto value = number_of(text);
    if (!value)
      wrong(row, fmt::format("`{}` in the column `{}` is not a finite number", text,
                             table_.header[column]));
    return value;
  }
  bool wrong(std::size_t row, const std::string& what) {
    constexpr std::size_t first_row = 2;  // behind the header, counted from 1
    diagnostics_.error(request_.file_place, fmt::format("{}, row {}: {}", request_.file.string(),
                                                        row + first_row, what));
    return false;
  }

  const TraceRequest& request_;
  const output::CsvTable& table_;
  std::size_t time_, value_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<MeasuredTrace> read_trace(const TraceRequest& request, Diagnostics& diagnostics) {
  const auto text = output::read_file(request.file);
  if (!text) {
    diagnostics.error(request.file_place, "cannot read " + request.file.string());
    return std::nullopt;
  }
  const auto table = output::parse_csv(text->ends_with('\n') ? *text : *text + "\n");
  if (!table || table->header.empty()) {
    diagnostics.error(request.file_place,
                      request.file.string() +
                          " is no table: a header, and rows with as many fields, between commas");
    return std::nullopt;
  }
  const auto value = column_of(*table, request.column, request, request.column_place, diagnostics);
  const auto time = request.time.empty()
                        ? std::optional<std::size_t>(0)
                        : column_of(*table, request.time, request, request.time_place, diagnostics);
  if (!value || !time) return std::nullopt;
  const auto value_unit =
      unit_of_column(*table, *value, request, request.column_place, diagnostics);
  const auto time_unit = unit_of_column(*table, *time, request, request.time_place, diagnostics);
  if (!value_unit || !time_unit) return std::nullopt;
  if (time_unit->dimension != language::Dimension{0, 0, 1, 0}) {
    diagnostics.error(request.time_place,
                      fmt::format("{}: the column `{}` is no time: its title says the unit, as "
                                  "`time [s]` does",
                                  request.file.string(), table->header[*time]));
    return std::nullopt;
  }
  MeasuredTrace trace;
  trace.unit = *value_unit;
  if (!TraceRows(request, *table, *time, *value, diagnostics).read(*time_unit, trace))
    return std::nullopt;
  return trace;
}

}  // namespace hookpoint::studies
