#include "text/series.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "text/letters.h"
#include "text/number.h"

namespace hookpoint::text {
namespace {

constexpr Dimension time_dimension{0, 0, 1, 0};
/// No count of seconds is as large (the year 5138) [s].
constexpr double most_seconds = 1e11;

bool is_sub_frame(const Column& column) {
  return lower_case(column.name) == "sub frame" || lower_case(column.name) == "subframe";
}

/// Of OpenSim's columns those that are no angles, by the names that it gives them.
bool is_linear(const std::string& name) {
  const std::string words = lower_case(name);
  for (const std::string_view end : {"_tx", "_ty", "_tz", "_vx", "_vy", "_vz", "_px", "_py", "_pz"})
    if (words.ends_with(end) || words.find(std::string(end) + '/') != std::string::npos)
      return true;
  for (const std::string_view word : {"force", "torque", "moment", "length", "activation"})
    if (words.find(word) != std::string::npos) return true;
  return false;
}

/// A time as the file has it. Whole numbers are kept whole: nanoseconds since 1970 do not fit into a
/// double.
struct Stamp {
  std::optional<std::int64_t> whole;
  double number = 0.;
};

std::optional<Stamp> stamp_in(const std::string& field) {
  const auto number = number_in(field);
  if (!number) return std::nullopt;
  Stamp stamp{std::nullopt, *number};
  std::int64_t whole = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), whole);
  if (error == std::errc{} && end == field.data() + field.size()) stamp.whole = whole;
  return stamp;
}

double difference(const Stamp& later, const Stamp& earlier) {
  if (later.whole && earlier.whole && *later.whole >= 0 && *earlier.whole >= 0)
    return static_cast<double>(*later.whole - *earlier.whole);
  return later.number - earlier.number;
}

/// Reads what a request asks of one table.
class SeriesReader {
 public:
  SeriesReader(const ForeignTable& table, const SeriesRequest& request, SeriesFault& fault)
      : table_(table), request_(request), fault_(fault) {}

  std::optional<SeriesTable> read() {
    if (table_.rows.empty()) return fail(0, "holds no row of numbers");
    if (!find_time() || !find_values()) return std::nullopt;
    for (std::size_t row = 0; row < table_.rows.size(); ++row)
      if (!add(row)) return std::nullopt;
    for (auto& [name, samples] : result_.cases)
      if (!fill(samples)) return std::nullopt;
    if (frames_) note("rows are taken as " + shortest(rate_) + " a second, the first at 0 s");
    if (dated_) note(dated_clock_notice);
    if (repeated_ > 0)
      note(std::to_string(repeated_) + (repeated_ == 1 ? " row has" : " rows have") +
           " the time of the row before, the first in line " + std::to_string(repeated_line_) +
           ": of rows with the same time the last counts");
    return std::move(result_);
  }

 private:
  std::nullopt_t fail(std::size_t line, std::string text,
                      SeriesFault::About about = SeriesFault::About::file) {
    fault_ = {about, line, std::move(text), "", ""};
    return std::nullopt;
  }
  /// Of all of the file.
  bool fails(std::string text, SeriesFault::About about = SeriesFault::About::file) {
    fail(0, std::move(text), about);
    return false;
  }
  bool wrong(std::size_t row, std::string text) {
    fail(table_.lines[row], std::move(text));
    return false;
  }
  void note(std::string text) { result_.notices.push_back(std::move(text)); }

  bool find_time() {
    const std::vector<Column>& columns = table_.columns;
    rate_ = request_.sample_rate;
    if (!request_.time.empty()) {
      if (rate_ > 0.)
        return fails("rows are by `time` or by `sample_rate`, not by both",
                     SeriesFault::About::time);
      time_ = find_column(table_, request_.time, fault_);
      if (!time_) fault_.about = SeriesFault::About::time;
      return time_ && find_time_unit();
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (is_sub_frame(columns[i])) sub_frame_ = i;
      if (counts_rows(columns[i]) && !frame_) frame_ = i;
    }
    if (frame_ != std::size_t{0}) frame_.reset();
    if (rate_ == 0. && !frame_ && table_.has_times) {
      time_ = 0;
    } else {
      const auto named = std::ranges::find_if(columns, is_called_time);
      if (named != columns.end()) time_ = static_cast<std::size_t>(named - columns.begin());
    }
    if (rate_ > 0. || !time_) {
      frames_ = true;
      if (rate_ == 0.) rate_ = table_.sample_rate;
      if (rate_ > 0.) return true;
      return fails(
          "its rows are counted, not timed: `sample_rate = 100 Hz` says how often they "
          "are; " +
              words_of_columns(table_),
          SeriesFault::About::time);
    }
    return find_time_unit();
  }

  bool find_time_unit() {
    const Column& column = table_.columns[*time_];
    std::string unit = request_.time_unit;
    if (unit.empty()) unit = column.unit;
    if (unit.empty()) unit = unit_in_name(column.name);
    if (unit.empty()) unit = table_.time_unit;
    time_unit_is_stated_ = !unit.empty();
    if (unit.empty() && request_.unit_of_time_needed)
      return fails("the column `" + shown(column.title) +
                       "` is no time: its title says the unit, as `time [s]` does, or "
                       "`time_unit = \"ms\"` says it",
                   SeriesFault::About::time);
    const auto parsed = parse_unit(unit.empty() ? "s" : usual_unit(unit));
    if (parsed && parsed->dimension == time_dimension) {
      time_unit_ = *parsed;
      return true;
    }
    if (!parsed)
      return fails("`" + shown(unit) + "` of the column `" + shown(column.name) + "` is no unit",
                   SeriesFault::About::time);
    return fails("the column `" + shown(column.title) +
                     "` is no time: its title says the unit, as "
                     "`time [s]` does; `time` names the column of the times",
                 SeriesFault::About::time);
  }

  bool find_values() {
    using About = SeriesFault::About;
    if (!request_.case_column.empty()) {
      case_ = find_column(table_, request_.case_column, fault_);
      if (!case_) fault_.about = About::column;
      if (!case_) return false;
    }
    for (const std::string& wanted : request_.columns) {
      const auto column = find_column(table_, wanted, fault_);
      if (!column) fault_.about = About::column;
      if (!column || !add_column(*column)) return false;
    }
    if (!request_.columns.empty()) return true;
    for (std::size_t i = 0; i < table_.columns.size(); ++i)
      if (i != time_ && !(frames_ && (i == frame_ || i == sub_frame_)) && !add_column(i))
        return false;
    return !values_.empty() ||
           fails("expected a column beside the times; " + words_of_columns(table_), About::file);
  }

  bool add_column(std::size_t index) {
    const Column& column = table_.columns[index];
    std::string unit = request_.unit.empty() ? column.unit : request_.unit;
    if (unit.empty() && table_.in_degrees && !is_linear(column.name)) unit = "deg";
    const auto parsed = parse_unit(usual_unit(unit));
    if (!parsed)
      return fails("`" + shown(unit) + "` of the column `" + shown(column.name) +
                       "` is no unit: `unit = \"N\"` states the one that is meant",
                   SeriesFault::About::column);
    values_.push_back(index);
    result_.columns.push_back({column.title, unit, *parsed});
    return true;
  }

  std::optional<double> time_of(std::size_t row, const std::string& of_case) {
    const std::vector<std::string>& fields = table_.rows[row];
    if (frames_) return frame_time(row);
    const auto stamp = stamp_in(fields[*time_]);
    if (!stamp)
      return fail(table_.lines[row], "`" + shown(fields[*time_]) + "` in the column `" +
                                         shown(table_.columns[*time_].title) +
                                         "` is not a finite number; rows without times of their "
                                         "own have a `sample_rate`");
    const auto in_seconds = [&](double value) {
      return value * time_unit_.numerator / time_unit_.denominator;
    };
    const Stamp& first = first_.emplace(of_case, *stamp).first->second;
    if (!time_unit_is_stated_ && std::abs(first.number) >= most_seconds) {
      const double n = std::abs(first.number);
      const char* unit = n < 1e14 ? "ms" : n < 1e17 ? "us" : "ns";
      return fail(table_.lines[row], "its time, " + shown(fields[*time_]) +
                                         ", is no count of seconds: `time_unit = \"" + unit +
                                         "\"` says what it counts");
    }
    if (request_.offset) return in_seconds(stamp->number) - *request_.offset;
    if (!counts_from_date(in_seconds(first.number))) return in_seconds(stamp->number);
    dated_ = true;
    return in_seconds(difference(*stamp, first));
  }

  /// Of a count of frames, less the first; else of the rows.
  std::optional<double> frame_time(std::size_t row) {
    const double offset = request_.offset.value_or(0.);
    if (!frame_ || table_.columns[*frame_].name.empty())
      return static_cast<double>(row) / rate_ - offset;
    const auto count = [&](std::size_t of_row, std::size_t column) {
      return number_in(table_.rows[of_row][column]);
    };
    const auto frame = count(row, *frame_), first = count(0, *frame_);
    if (!frame || !first)
      return fail(table_.lines[row], "`" + shown(table_.rows[row][*frame_]) + "` in the column `" +
                                         shown(table_.columns[*frame_].title) +
                                         "` is not a number");
    if (!sub_frame_) return (*frame - *first) / rate_ - offset;
    double most = 0.;
    for (std::size_t i = 0; sub_frames_ == 0. && i < table_.rows.size(); ++i)
      most = std::max(most, count(i, *sub_frame_).value_or(0.));
    if (sub_frames_ == 0.) sub_frames_ = most + 1.;
    const double sub = count(row, *sub_frame_).value_or(0.) - count(0, *sub_frame_).value_or(0.);
    return ((*frame - *first) * sub_frames_ + sub) / rate_ - offset;
  }

  bool add(std::size_t row) {
    const std::vector<std::string>& fields = table_.rows[row];
    const auto missing = [&](std::size_t column) { return is_gap(fields[column]); };
    if (request_.gaps == Gaps::leave_out && std::ranges::any_of(values_, missing)) return true;
    const std::string of_case = case_ ? fields[*case_] : "";
    Samples& samples = result_.cases[of_case];
    samples.columns.resize(values_.size());
    const auto time = time_of(row, of_case);
    if (!time) return false;
    if (!std::isfinite(*time)) return wrong(row, "its time is not finite in seconds");
    if (!samples.time.empty() && *time < samples.time.back())
      return wrong(row, "its time, " + shortest(*time) +
                            " s, is not after that of the row before: times rise");
    if (!samples.time.empty() && *time == samples.time.back()) {
      if (repeated_++ == 0) repeated_line_ = table_.lines[row];
      samples.time.pop_back(), samples.lines.pop_back();
      for (auto& column : samples.columns) column.pop_back();
    }
    samples.time.push_back(*time);
    samples.lines.push_back(table_.lines[row]);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const auto value = value_at(row, i);
      if (!value) return false;
      samples.columns[i].push_back(*value);
    }
    return true;
  }

  /// The number in SI; NaN of a gap that is to be filled.
  std::optional<double> value_at(std::size_t row, std::size_t value) {
    const std::string& field = table_.rows[row][values_[value]];
    const std::string& title = table_.columns[values_[value]].title;
    const Unit& unit = result_.columns[value].scale;
    if (const auto number = number_in(field)) {
      const double value_in_si = *number * unit.numerator / unit.denominator;
      if (std::isfinite(value_in_si)) return value_in_si;
    }
    if (!is_gap(field))
      return fail(table_.lines[row], "`" + shown(field) + "` in the column `" + shown(title) +
                                         "` is not a finite number");
    if (request_.gaps != Gaps::error) return std::nan("");
    return fail(table_.lines[row],
                "`" + shown(field) + "` in the column `" + shown(title) +
                    "` is not a finite number but a missing value: `gaps = interpolate` or `gaps = "
                    "hold` says what stands for it");
  }

  bool fill(Samples& samples) {
    for (std::size_t i = 0; i < samples.columns.size(); ++i)
      if (!fill_gaps(samples.time, samples.columns[i], request_.gaps))
        return fails("the column `" + shown(result_.columns[i].title) + "` holds no number",
                     SeriesFault::About::column);
    return true;
  }

  const ForeignTable& table_;
  const SeriesRequest& request_;
  SeriesFault& fault_;
  SeriesTable result_;
  std::optional<std::size_t> time_, frame_, sub_frame_, case_;
  std::vector<std::size_t> values_;
  Unit time_unit_;
  bool time_unit_is_stated_ = false, frames_ = false, dated_ = false;
  double rate_ = 0., sub_frames_ = 0.;
  std::map<std::string, Stamp> first_;  ///< of each case
  std::size_t repeated_ = 0, repeated_line_ = 0;
};

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!(text = trimmed(text)).empty()) {
    words.push_back(text.substr(0, text.find(' ')));
    text.remove_prefix(words.back().size());
  }
  return words;
}

/// The column whose full name has these words, in their order, and ends as they do: "Hand X" is "Rigid
/// body Hand 2 Position X". `several` says whether more than one has.
std::optional<std::size_t> column_in_words(const std::vector<Column>& columns,
                                           std::string_view wanted, bool& several) {
  const std::vector<std::string_view> words = words_of(wanted);
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].group.empty() || words.empty()) continue;
    const std::string full = columns[i].full_name();
    const std::vector<std::string_view> all = words_of(full);
    auto next = words.begin();
    for (const std::string_view word : all)
      if (next != words.end() && word == *next) ++next;
    if (next != words.end() || all.back() != words.back()) continue;
    several = found.has_value();
    found = i;
    if (several) return found;
  }
  return found;
}

}  // namespace

std::optional<std::size_t> find_column(const ForeignTable& table, std::string_view wanted,
                                       SeriesFault& fault) {
  const std::vector<Column>& columns = table.columns;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].title == wanted && std::ranges::count(columns, wanted, &Column::title) == 1)
      return i;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].full_name() == wanted && !columns[i].group.empty()) return i;
  std::optional<std::size_t> named;
  bool several = false;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].name != wanted) continue;
    several = several || named;
    named = i;
  }
  if (named && !several) return named;
  if (!named) {
    named = column_in_words(columns, wanted, several);
    if (named && !several) return named;
  }
  fault.line = 0;
  if (several) {
    fault.problem = "has more than one column `" + shown(wanted) + "`: say its ";
    fault.problem += columns[*named].group.empty() ? "unit, too" : "group, too";
    fault.columns = words_of_columns(table);
    return std::nullopt;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc{} && end == wanted.data() + wanted.size() && number >= 1 &&
      number <= columns.size())
    return number - 1;
  fault.problem = "has no column `" + shown(wanted) + "`";
  fault.wanted = wanted;
  fault.columns = words_of_columns(table);
  return std::nullopt;
}

bool fill_gaps(const std::vector<double>& t, std::vector<double>& y, Gaps gaps) {
  const auto first = std::ranges::find_if(y, [](double value) { return !std::isnan(value); });
  if (first == y.end()) return y.empty();
  std::fill(y.begin(), first, *first);
  for (std::size_t row = 1; row < y.size(); ++row) {
    if (!std::isnan(y[row])) continue;
    std::size_t next = row;
    while (next < y.size() && std::isnan(y[next])) ++next;
    const double from = y[row - 1], begin = t[row - 1];
    const bool between = gaps == Gaps::interpolate && next < y.size();
    for (; row < next; ++row)
      y[row] = between ? from + (y[next] - from) * (t[row] - begin) / (t[next] - begin) : from;
  }
  return true;
}

std::optional<SeriesTable> read_series(const std::vector<ForeignTable>& tables,
                                       const SeriesRequest& request, SeriesFault& fault) {
  const auto has_all = [&](const ForeignTable& table) {
    SeriesFault ignored;
    return std::ranges::all_of(request.columns, [&](const std::string& wanted) {
      return find_column(table, wanted, ignored).has_value();
    });
  };
  const auto found = std::ranges::find_if(tables, has_all);
  return SeriesReader(found == tables.end() ? tables.front() : *found, request, fault).read();
}

std::string words_of_columns(const ForeignTable& table) {
  constexpr std::size_t most = 20;
  const std::string of = table.format.empty() ? "" : " of " + table.format;
  if (!table.has_titles)
    return "the table" + of + " has no titles: its " + std::to_string(table.columns.size()) +
           " columns have the numbers from 1 on";
  std::string words;
  for (std::size_t i = 0; i < std::min(most, table.columns.size()); ++i) {
    const Column& column = table.columns[i];
    words += (i == 0 ? "`" : ", `") +
             shown(column.group.empty() ? column.title : column.full_name()) + "`";
  }
  if (table.columns.size() > most)
    words += ", " + std::to_string(table.columns.size() - most) + " more";
  if (table.columns.size() == 1)
    return "its one column" + of + " is " + words +
           ": fields are separated by commas, semicolons, tabs or blanks";
  return "its columns" + of + " are " + words + ", separated by " +
         std::string(separators(table.separator));
}

}  // namespace hookpoint::text
