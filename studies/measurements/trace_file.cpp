#include "studies/measurements/trace_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "language/names.h"
#include "output/files/file.h"
#include "text/formats.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Position;

std::optional<language::Unit> unit_of_column(const text::Table& table, std::size_t column,
                                             const TraceRequest& request, const Position& place,
                                             Diagnostics& diagnostics) {
  const ColumnTitle title = parts_of(table.header[column]);
  const auto unit = language::parse_unit(title.unit);
  if (!unit)
    diagnostics.error(place, fmt::format("{}: `{}` of the column `{}` is no unit",
                                         request.file.string(), title.unit, title.name));
  return unit;
}

/// The columns of a request in its table.
struct TraceColumns {
  std::size_t time = 0;
  std::vector<std::size_t> values;
  std::optional<std::size_t> of_case;
  language::Unit time_unit;
  std::vector<language::Unit> units;
};

double in_si(double value, const language::Unit& unit) {
  return value * unit.numerator / unit.denominator;
}

/// Turns a table's rows into samples.
class TraceRows {
 public:
  TraceRows(const TraceRequest& request, const text::Table& table, const TraceColumns& columns,
            Diagnostics& diagnostics)
      : request_(request), table_(table), columns_(columns), diagnostics_(diagnostics) {}

  bool read(std::map<std::string, MeasuredTrace>& traces) {
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      const std::vector<std::string>& fields = table_.rows[row];
      if (std::ranges::any_of(columns_.values, [&](auto column) { return fields[column].empty(); }))
        continue;
      MeasuredTrace& trace = traces[columns_.of_case ? fields[*columns_.of_case] : ""];
      trace.width = columns_.values.size();
      trace.unit = columns_.units.front();
      if (!add_sample(row, trace)) return false;
    }
    for (const auto& [name, trace] : traces)
      if (trace.time.size() < 2) return too_few(name);
    return !traces.empty() || too_few("");
  }

 private:
  bool add_sample(std::size_t row, MeasuredTrace& trace) {
    const auto time = field(row, columns_.time);
    if (!time) return false;
    const double seconds = in_si(*time, columns_.time_unit) - request_.offset;
    if (seconds < 0. && !request_.may_be_early)
      return wrong(row, request_.offset == 0.
                            ? std::string("begins before 0 s, where the scene does")
                            : fmt::format("begins before the scene does: the clock's {} s less the "
                                          "offset of {} s",
                                          text::rounded(seconds + request_.offset, 6),
                                          text::rounded(request_.offset, 6)));
    if (seconds > latest_sample)
      return wrong(row, fmt::format("its time, {} s, is beyond {} s: no run is that long",
                                    text::rounded(seconds, 6), text::rounded(latest_sample, 6)));
    if (!trace.time.empty() && !(seconds > trace.time.back()))
      return wrong(row, fmt::format("its time, {} s, is not after that of the sample before it",
                                    text::shortest(seconds)));
    trace.time.push_back(seconds);
    for (std::size_t i = 0; i < columns_.values.size(); ++i) {
      const auto value = field(row, columns_.values[i]);
      if (!value) return false;
      trace.value.push_back(in_si(*value, columns_.units[i]));
    }
    return true;
  }
  std::optional<double> field(std::size_t row, std::size_t column) {
    return number_at(table_, row, column, request_.file, request_.file_place, diagnostics_);
  }
  bool wrong(std::size_t row, const std::string& what) {
    tell_wrong_row(request_.file, table_, row, what, request_.file_place, diagnostics_);
    return false;
  }
  bool too_few(const std::string& name) {
    diagnostics_.error(
        request_.column_place,
        fmt::format("{}: fewer than two samples in the column `{}`{}", request_.file.string(),
                    table_.header[columns_.values.front()],
                    name.empty() ? "" : fmt::format(" of {} {}", request_.case_column, name)));
    return false;
  }

  const TraceRequest& request_;
  const text::Table& table_;
  const TraceColumns& columns_;
  Diagnostics& diagnostics_;
};

std::optional<TraceColumns> trace_columns(const TraceRequest& request, const text::Table& table,
                                          Diagnostics& diagnostics) {
  TraceColumns columns;
  const auto find = [&](const std::string& title, const Position& place) {
    return column_of(table, title, request.file, place, diagnostics);
  };
  for (const std::string& title : request.columns) {
    const auto column = find(title, request.column_place);
    if (!column) return std::nullopt;
    const auto unit = unit_of_column(table, *column, request, request.column_place, diagnostics);
    if (!unit) return std::nullopt;
    columns.values.push_back(*column);
    columns.units.push_back(*unit);
    if (unit->dimension == columns.units.front().dimension) continue;
    diagnostics.error(request.column_place,
                      fmt::format("{}: `{}` and `{}` are of different dimensions",
                                  request.file.string(), request.columns.front(), title));
    return std::nullopt;
  }
  if (!request.case_column.empty()) {
    columns.of_case = find(request.case_column, request.column_place);
    if (!columns.of_case) return std::nullopt;
  }
  const auto time =
      request.time.empty() ? std::optional<std::size_t>(0) : find(request.time, request.time_place);
  if (!time) return std::nullopt;
  columns.time = *time;
  const auto time_unit = unit_of_column(table, *time, request, request.time_place, diagnostics);
  if (!time_unit) return std::nullopt;
  columns.time_unit = *time_unit;
  if (time_unit->dimension == language::Dimension{0, 0, 1, 0}) return columns;
  diagnostics.error(
      request.time_place,
      fmt::format("{}: the column `{}` is no time: its title says the unit, as `time [s]` does",
                  request.file.string(), table.header[*time]));
  return std::nullopt;
}

/// "its columns are `time (s)`, `z`, separated by semicolons".
std::string columns_of(const text::Table& table) {
  constexpr std::size_t most = 20;
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < std::min(most, table.header.size()); ++i)
    titles.push_back("`" + table.header[i] + "`");
  if (table.header.size() > most)
    titles.push_back(fmt::format("{} more", table.header.size() - most));
  if (titles.size() == 1)
    return "its one column is " + titles.front() +
           ": fields are separated by commas, semicolons or tabs";
  return fmt::format("its columns are {}, separated by {}", language::join(titles, ", "),
                     text::separators(table.separator));
}

}  // namespace

void tell_wrong_row(const std::filesystem::path& file, const text::Table& table, std::size_t row,
                    const std::string& what, const Position& place, Diagnostics& diagnostics) {
  diagnostics.error(place, fmt::format("{}, row {}: {}", file.string(), table.lines[row], what));
}

std::optional<double> number_at(const text::Table& table, std::size_t row, std::size_t column,
                                const std::filesystem::path& file, const Position& place,
                                Diagnostics& diagnostics) {
  const std::string& text = table.rows[row][column];
  double value = 0.;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(value))
    return value;
  tell_wrong_row(
      file, table, row,
      fmt::format("`{}` in the column `{}` is not a finite number", text, table.header[column]),
      place, diagnostics);
  return std::nullopt;
}

ColumnTitle parts_of(const std::string& title) {
  for (const auto& [opening, closing] : {std::pair{" [", ']'}, std::pair{" (", ')'}}) {
    const std::size_t open = title.rfind(opening);
    if (open == std::string::npos || !title.ends_with(closing)) continue;
    const std::string inside = title.substr(open + 2, title.size() - open - 3);
    // A remark may stand between parentheses, too.
    if (closing == ')' && !language::parse_unit(inside)) continue;
    return {title.substr(0, open), inside};
  }
  return {title, ""};
}

std::optional<std::size_t> column_of(const text::Table& table, const std::string& wanted,
                                     const std::filesystem::path& file, const Position& place,
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
  if (several)
    diagnostics.error(place, fmt::format("{} has more than one column `{}`: say its unit, too",
                                         file.string(), wanted));
  else
    diagnostics.error(place,
                      fmt::format("{} has no column `{}`{}; {}", file.string(), wanted,
                                  language::did_you_mean(wanted, table.header), columns_of(table)));
  return std::nullopt;
}

std::optional<text::Table> read_table(const std::filesystem::path& file, const Position& place,
                                      Diagnostics& diagnostics) {
  const auto text = output::read_file(file);
  if (!text) {
    diagnostics.error(place, "cannot read " + file.string());
    return std::nullopt;
  }
  if (const std::string refusal = text::refusal(*text, file, text::Use::series); !refusal.empty()) {
    diagnostics.error(place, file.string() + ": " + refusal);
    return std::nullopt;
  }
  text::Fault fault;
  auto table = text::read_foreign(*text, fault);
  if (!table)
    diagnostics.error(place, fault.kind == text::Fault::Kind::empty
                                 ? file.string() + " is no table: it is empty"
                                 : fmt::format("{} is no table: row {}: {}", file.string(),
                                               fault.line, fault.text()));
  return table;
}

std::optional<std::map<std::string, MeasuredTrace>> read_traces(const TraceRequest& request,
                                                                Diagnostics& diagnostics) {
  const auto table = read_table(request.file, request.file_place, diagnostics);
  if (!table) return std::nullopt;
  const auto columns = trace_columns(request, *table, diagnostics);
  if (!columns) return std::nullopt;
  std::map<std::string, MeasuredTrace> traces;
  if (!TraceRows(request, *table, *columns, diagnostics).read(traces)) return std::nullopt;
  return traces;
}

}  // namespace hookpoint::studies
