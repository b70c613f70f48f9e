#include "studies/measurements/trace_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "language/names.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Position;

std::string row_words(const std::filesystem::path& file, std::size_t line) {
  return line == 0 ? file.string() : fmt::format("{}, row {}", file.string(), line);
}

/// The error of a table that does not give what a field wants, at that field.
void report(const text::SeriesFault& fault, const text::ForeignTable& table,
            const std::filesystem::path& file, const Position& place, Diagnostics& diagnostics) {
  const std::string nearest =
      fault.wanted.empty() ? "" : language::did_you_mean(fault.wanted, table.titles());
  const bool is_sentence = fault.line == 0 && fault.problem.starts_with("has ");
  diagnostics.error(
      place, fmt::format("{}{}{}{}{}{}", row_words(file, fault.line), is_sentence ? " " : ": ",
                         fault.problem, nearest, fault.columns.empty() ? "" : "; ", fault.columns));
}

/// Turns samples into what a fit compares with.
class TraceSamples {
 public:
  TraceSamples(const TraceRequest& request, const text::SeriesTable& series,
               Diagnostics& diagnostics)
      : request_(request), series_(series), diagnostics_(diagnostics) {}

  std::optional<std::map<std::string, MeasuredTrace>> read() {
    const text::Dimension& first = series_.columns.front().scale.dimension;
    for (std::size_t i = 1; i < series_.columns.size(); ++i) {
      if (series_.columns[i].scale.dimension == first) continue;
      diagnostics_.error(
          request_.column_place,
          fmt::format("{}: `{}` and `{}` are of different dimensions", request_.file.string(),
                      request_.columns.front(), request_.columns[i]));
      return std::nullopt;
    }
    std::map<std::string, MeasuredTrace> traces;
    for (const auto& [name, samples] : series_.cases) {
      if (!times_suit(samples)) return std::nullopt;
      if (samples.time.size() < 2) return too_few(name);
      traces[name] = trace_of(samples);
    }
    if (traces.empty()) return too_few("");
    return traces;
  }

 private:
  MeasuredTrace trace_of(const text::Samples& samples) const {
    MeasuredTrace trace{samples.time, {}, samples.columns.size(), series_.columns.front().scale};
    for (std::size_t row = 0; row < samples.time.size(); ++row)
      for (const std::vector<double>& column : samples.columns) trace.value.push_back(column[row]);
    return trace;
  }

  bool times_suit(const text::Samples& samples) {
    for (std::size_t i = 0; i < samples.time.size(); ++i) {
      const double seconds = samples.time[i], offset = request_.offset.value_or(0.);
      if (seconds < 0. && !request_.may_be_early)
        return wrong(samples.lines[i],
                     offset == 0. ? std::string("begins before 0 s, where the scene does: `offset` "
                                                "is what the clock reads at the scene's time 0")
                                  : fmt::format("begins before the scene does: the clock's {} s "
                                                "less the offset of {} s",
                                                text::rounded(seconds + offset, 6),
                                                text::rounded(offset, 6)));
      if (seconds > latest_sample)
        return wrong(samples.lines[i],
                     fmt::format("its time, {} s, is beyond {} s: no run is that long",
                                 text::rounded(seconds, 6), text::rounded(latest_sample, 6)));
    }
    return true;
  }
  bool wrong(std::size_t line, const std::string& what) {
    diagnostics_.error(request_.file_place,
                       fmt::format("{}: {}", row_words(request_.file, line), what));
    return false;
  }
  std::nullopt_t too_few(const std::string& name) {
    diagnostics_.error(
        request_.column_place,
        fmt::format("{}: fewer than two samples in the column `{}`{}", request_.file.string(),
                    series_.columns.front().title,
                    name.empty() ? "" : fmt::format(" of {} {}", request_.case_column, name)));
    return std::nullopt;
  }

  const TraceRequest& request_;
  const text::SeriesTable& series_;
  Diagnostics& diagnostics_;
};

}  // namespace

void tell_wrong_row(const std::filesystem::path& file, const text::ForeignTable& table,
                    std::size_t row, const std::string& what, const Position& place,
                    Diagnostics& diagnostics) {
  diagnostics.error(place, fmt::format("{}: {}", row_words(file, table.lines[row]), what));
}

std::optional<double> number_at(const text::ForeignTable& table, std::size_t row,
                                std::size_t column, const std::filesystem::path& file,
                                const Position& place, Diagnostics& diagnostics) {
  const std::string& text = table.rows[row][column];
  if (const auto value = text::number_in(text)) return value;
  tell_wrong_row(file, table, row,
                 fmt::format("`{}` in the column `{}` is not a finite number", text,
                             table.columns[column].title),
                 place, diagnostics);
  return std::nullopt;
}

std::optional<std::size_t> column_of(const text::ForeignTable& table, const std::string& wanted,
                                     const std::filesystem::path& file, const Position& place,
                                     Diagnostics& diagnostics) {
  text::SeriesFault fault;
  const auto column = text::find_column(table, wanted, fault);
  if (!column) report(fault, table, file, place, diagnostics);
  return column;
}

std::optional<std::vector<text::ForeignTable>> read_tables(const std::filesystem::path& file,
                                                           const Position& place,
                                                           Diagnostics& diagnostics) {
  std::string problem;
  const auto text = text::text_of_table(file, problem);
  if (!text) {
    diagnostics.error(place, fmt::format("{}: {}", file.string(), problem));
    return std::nullopt;
  }
  text::Fault fault;
  auto tables = text::read_foreign(*text, fault);
  if (!tables)
    diagnostics.error(place, fault.kind == text::Fault::Kind::empty
                                 ? file.string() + " is no table: it is empty"
                                 : fmt::format("{} is no table: row {}: {}", file.string(),
                                               fault.line, fault.text()));
  return tables;
}

std::optional<std::map<std::string, MeasuredTrace>> read_traces(const TraceRequest& request,
                                                                Diagnostics& diagnostics) {
  const auto tables = read_tables(request.file, request.file_place, diagnostics);
  if (!tables) return std::nullopt;
  text::SeriesRequest wanted;
  wanted.columns = request.columns;
  wanted.time = request.time;
  wanted.time_unit = request.time_unit;
  wanted.unit = request.unit;
  wanted.case_column = request.case_column;
  wanted.sample_rate = request.sample_rate;
  wanted.offset = request.offset;
  wanted.gaps = text::Gaps::leave_out;
  wanted.unit_of_time_needed = true;
  text::SeriesFault fault;
  const auto series = text::read_series(*tables, wanted, fault);
  if (!series) {
    using About = text::SeriesFault::About;
    const Position& place = fault.about == About::column ? request.column_place
                            : fault.about == About::time ? request.time_place
                                                         : request.file_place;
    report(fault, tables->front(), request.file, place, diagnostics);
    return std::nullopt;
  }
  for (const std::string& notice : series->notices)
    diagnostics.note(request.file_place, fmt::format("{}: {}", request.file.string(), notice));
  return TraceSamples(request, *series, diagnostics).read();
}

}  // namespace hookpoint::studies
