#include "control/data/table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hookpoint::control {
namespace {

/// The words of a choice as what they mean.
text::Gaps gaps_of(const std::string& words) {
  if (words == "hold") return text::Gaps::hold;
  return words == "interpolate" ? text::Gaps::interpolate : text::Gaps::error;
}

}  // namespace

TableFields::TableFields(Component& owner)
    : file(Text{owner, "file", "the table: text of columns, or a MAT file by the ending .mat"}
               .path()),
      time(owner, "time",
           "title, name or number of the column of the times; default: the first, unless it counts "
           "frames"),
      time_unit(owner, "time_unit", "of the times, \"ms\"; default: as the table says, else s"),
      unit(owner, "unit",
           "of the values, \"kN\"; default: as the table says, else that of what they drive"),
      gaps(Text{owner, "gaps", "what stands for a missing value, empty or NaN", "error"}.choices(
          {"error", "hold", "interpolate"})),
      sample_rate(Parameter{owner, "sample_rate", "Hz", 0.,
                            "rows are this often, for tables without times; 0: as the times say"}
                      .range(0., 1e9)),
      start(owner, "start", "s", 0., "time of the simulation at the table's time 0"),
      offset(
          owner, "offset", "s", 0.,
          "what the table's clock reads at its time 0; 0: a clock that counts from a date begins "
          "at the first row") {}

text::SeriesRequest TableFields::request(const std::vector<std::string>& columns) const {
  text::SeriesRequest request;
  request.columns = columns;
  request.time = time.value();
  request.time_unit = time_unit.value();
  request.unit = unit.value();
  request.sample_rate = sample_rate;
  if (offset != 0.) request.offset = offset;
  request.gaps = gaps_of(gaps.value());
  return request;
}

Table TableFields::read(const std::vector<std::string>& columns, TableReport& report) const {
  if (file.value().empty()) throw std::runtime_error("file is not given");
  const bool is_mat = file.value().ends_with(".mat");
  if (is_mat && columns.size() != 1)
    throw std::runtime_error(file.value() + ": of a MAT file `columns` names one variable");
  Table table = is_mat ? read_mat_table(file.value(), request(columns))
                       : read_csv_table(file.value(), request(columns));
  report = {};
  report.first = table.time.front() + start;
  report.last = table.time.back() + start;
  for (const std::string& notice : table.notices)
    report.notices.push_back(file.value() + ": " + notice);
  return table;
}

Table read_csv_table(const std::filesystem::path& path, const text::SeriesRequest& request) {
  const auto where = [&](std::size_t line) {
    return path.string() + (line == 0 ? "" : ":" + std::to_string(line)) + ": ";
  };
  text::Fault fault;
  std::string problem;
  const auto content = text::text_of_table(path, problem);
  if (!content) throw std::runtime_error(where(0) + problem);
  const auto tables = text::read_foreign(*content, fault);
  if (!tables && fault.kind == text::Fault::Kind::empty)
    throw std::runtime_error(where(0) + "holds no row of numbers");
  if (!tables) throw std::runtime_error(where(fault.line) + fault.text());
  text::SeriesFault wrong;
  auto series = text::read_series(*tables, request, wrong);
  if (!series) throw std::runtime_error(where(wrong.line) + wrong.text());
  text::Samples& samples = series->cases.begin()->second;
  Table table{{},
              series->columns,
              std::move(samples.time),
              std::move(samples.columns),
              std::move(series->notices)};
  for (const text::SeriesColumn& column : table.units)
    table.names.push_back(text::parts_of(column.title).name);
  return table;
}

std::size_t row_at(const std::vector<double>& rows, double time) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), time);
  return after == rows.begin() ? 0 : static_cast<std::size_t>(after - rows.begin()) - 1;
}

}  // namespace hookpoint::control
