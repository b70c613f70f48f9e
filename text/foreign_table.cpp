#include "text/foreign_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "text/formats.h"
#include "text/letters.h"
#include "text/units.h"

namespace hookpoint::text {
namespace {

using Records = std::vector<Record>;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the mark between the whole part and the fraction of a number stands: of "-1,5e3" 2. npos
/// where the field is no such number.
std::size_t place_of_mark(std::string_view field, char mark) {
  std::size_t at = field.find_first_of("+-") == 0 ? 1 : 0;
  while (at < field.size() && is_digit(field[at])) ++at;
  const std::size_t place = at;
  if (at == field.size() || field[at] != mark) return std::string_view::npos;
  for (++at; at < field.size() && is_digit(field[at]);) ++at;
  if (at == place + 1) return std::string_view::npos;
  if (at < field.size() && (field[at] == 'e' || field[at] == 'E')) {
    ++at;
    if (at < field.size() && (field[at] == '+' || field[at] == '-')) ++at;
    const std::size_t digits = at;
    while (at < field.size() && is_digit(field[at])) ++at;
    if (at == digits) return std::string_view::npos;
  }
  return at == field.size() ? place : std::string_view::npos;
}

void replace_decimal_commas(std::vector<std::vector<std::string>>& rows) {
  for (const auto& row : rows)
    for (const std::string& field : row)
      if (place_of_mark(field, '.') != std::string::npos) return;
  for (auto& row : rows) {
    for (std::string& field : row) {
      const std::size_t comma = place_of_mark(field, ',');
      if (comma != std::string::npos) field[comma] = '.';
    }
  }
}

/// UTF-8 of a text of UTF-16, of the byte order that its mark says; a text without one as it is.
std::string in_utf8(std::string_view text) {
  const bool little = text.starts_with("\xFF\xFE"), big = text.starts_with("\xFE\xFF");
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (!little && !big) return std::string(text.substr(text.starts_with(mark) ? mark.size() : 0));
  const auto unit = [&](std::size_t at) -> char32_t {
    const auto first = static_cast<unsigned char>(text[at]);
    const auto second = static_cast<unsigned char>(text[at + 1]);
    return little ? first | second << 8U : first << 8U | second;
  };
  std::string result;
  for (std::size_t at = 2; at + 1 < text.size(); at += 2) {
    char32_t point = unit(at);
    if (point >= 0xD800 && point < 0xDC00 && at + 3 < text.size()) {
      at += 2;
      point = 0x10000 + ((point - 0xD800) << 10U) + ((unit(at) - 0xDC00) & 0x3FFU);
    }
    const auto tail = [&](unsigned shift) {
      result += static_cast<char>(0x80U | (point >> shift & 0x3FU));
    };
    if (point < 0x80) {
      result += static_cast<char>(point);
    } else if (point < 0x800) {
      result += static_cast<char>(0xC0U | point >> 6U);
      tail(0);
    } else if (point < 0x10000) {
      result += static_cast<char>(0xE0U | point >> 12U);
      tail(6), tail(0);
    } else {
      result += static_cast<char>(0xF0U | point >> 18U);
      tail(12), tail(6), tail(0);
    }
  }
  return result;
}

/// The lines of a text, without their ends.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool is_letter_of_word(char c) { return c >= 'a' && c <= 'z'; }

/// Where the key stands as a word: "rate" in "Sampling rate" and "SampleRate", not in "generated".
std::size_t place_of_key(const std::string& words, std::string_view key) {
  const std::size_t at = words.find(key), end = at + key.size();
  if (at == std::string::npos) return at;
  const std::string_view before = std::string_view(words).substr(0, at);
  bool begins = at == 0 || !is_letter_of_word(before.back());
  for (const std::string_view word : {"sample", "sampling", "frame", "data", "scan"})
    begins = begins || before.ends_with(word);
  const bool ends = end == words.size() || !is_letter_of_word(words[end]);
  return begins && ends ? at : std::string::npos;
}

/// A rate that a line states: the number above 0 behind the word rate or frequency [Hz]; else 0.
double rate_in(std::string_view line) {
  const std::string words = lower_case(line);
  for (const std::string_view key : {"rate", "frequency"}) {
    const std::size_t at = place_of_key(words, key);
    if (at == std::string::npos) continue;
    const std::size_t begin = words.find_first_of("0123456789", at);
    if (begin == std::string::npos) continue;
    double rate = 0.;
    std::from_chars(words.data() + begin, words.data() + words.size(), rate);
    const double kilo = words.find("khz", at) == std::string::npos ? 1. : 1000.;
    if (rate > 0. && std::isfinite(rate)) return kilo * rate;
  }
  return 0.;
}

/// What a format's own lines, above its table, say.
struct Preamble {
  std::string format, time_unit, unit;
  std::size_t lines = 0;  ///< that do not belong to the table
  double sample_rate = 0.;
  bool in_degrees = false;
  std::vector<std::string> names;  ///< of markers, where the format lists them; three columns each
};

/// OpenSim's .mot and .sto (and SIMM's motions): keys up to the line `endheader`.
std::optional<Preamble> opensim(const std::vector<std::string_view>& lines) {
  constexpr std::size_t most = 200;
  Preamble preamble{"OpenSim", "s", "", 0, 0., false, {}};
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) {
    const std::string line = lower_case(trimmed(lines[i]));
    if (line.starts_with("indegrees")) preamble.in_degrees = line.find("yes") != std::string::npos;
    if (line != "endheader") continue;
    preamble.lines = i + 1;
    return preamble;
  }
  return std::nullopt;
}

std::vector<std::string> fields_of(std::string_view line) {
  Fault fault;
  const auto records = read_records(std::string(line) + '\n', {'\t', false}, fault);
  return records && !records->empty() ? records->front().fields : std::vector<std::string>{};
}

/// A .trc of markers: a line of keys and one of their values, `DataRate` and `Units` among them.
std::optional<Preamble> trc(const std::vector<std::string_view>& lines) {
  if (lines.size() < 4 || !lines[0].starts_with("PathFileType")) return std::nullopt;
  Preamble preamble{"TRC", "s", "", 3, 0., false, {}};
  const std::vector<std::string> keys = fields_of(lines[1]), values = fields_of(lines[2]);
  for (std::size_t i = 0; i < std::min(keys.size(), values.size()); ++i) {
    const std::string_view key = trimmed(keys[i]);
    if (key == "DataRate") preamble.sample_rate = number_in(trimmed(values[i])).value_or(0.);
    if (key == "Units") preamble.unit = trimmed(values[i]);
  }
  return preamble;
}

/// A .tsv of Qualisys: keys down to the table, whose titles are the markers' names where it has
/// none of its own; millimetres.
std::optional<Preamble> qualisys(const std::vector<std::string_view>& lines) {
  if (lines.empty() || !lines[0].starts_with("NO_OF_FRAMES")) return std::nullopt;
  Preamble preamble{"Qualisys", "s", "mm", 0, 0., false, {}};
  for (const std::string_view line : lines) {
    std::vector<std::string> fields = fields_of(line);
    const bool is_key =
        !fields.empty() && fields[0].size() > 1 &&
        std::ranges::all_of(fields[0], [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
    if (!is_key) break;
    ++preamble.lines;
    if (fields[0] == "FREQUENCY" && fields.size() > 1)
      preamble.sample_rate = number_in(trimmed(fields[1])).value_or(0.);
    if (fields[0] == "MARKER_NAMES") preamble.names.assign(fields.begin() + 1, fields.end());
  }
  return preamble;
}

/// A line without the empty fields at its end.
std::string_view without_empty_fields(std::string_view line) {
  line = trimmed(line);
  return line.substr(0, line.find_last_not_of(",\t;") + 1);
}

/// The words with which Vicon Nexus begins a section; a line with its rate follows.
bool begins_section(const std::vector<std::string_view>& lines, std::size_t at) {
  constexpr std::array words{"Trajectories",  "Devices",  "Joints",
                             "Model Outputs", "Segments", "Events"};
  if (at + 1 >= lines.size()) return false;
  return std::ranges::find(words, without_empty_fields(lines[at])) != words.end() &&
         number_in(without_empty_fields(lines[at + 1])).has_value();
}

std::optional<Preamble> vicon(const std::vector<std::string_view>& lines) {
  if (!begins_section(lines, 0)) return std::nullopt;
  Preamble preamble{"Vicon Nexus", "s", "", 2, 0., false, {}};
  preamble.sample_rate = number_in(without_empty_fields(lines[1])).value_or(0.);
  return preamble;
}

Preamble preamble_of(const std::vector<std::string_view>& lines) {
  for (const auto& format : {opensim, trc, qualisys, vicon})
    if (auto preamble = format(lines)) return *std::move(preamble);
  Preamble preamble;
  if (!lines.empty() && lines[0].starts_with("Format Version")) preamble.format = "Motive";
  return preamble;
}

/// Whether a field counts as a number in a table separated so: a decimal comma is none between
/// commas.
bool is_number(const std::string& field, char separator) {
  double value = 0.;  // that is infinite, or not a number, too: a row of numbers has wrong ones
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool whole = error == std::errc{} && end == field.data() + field.size();
  return whole || number_in(field).has_value() ||
         (separator != ',' && place_of_mark(field, ',') != std::string::npos);
}

/// Fields up to the last that is not empty.
std::size_t used(const Record& record) {
  std::size_t count = record.fields.size();
  while (count > 0 && record.fields[count - 1].empty()) --count;
  return count;
}

bool is_clock(const Column& column) { return counts_rows(column) || is_called_time(column); }

/// Finds the table among the records of a section.
class Layout {
 public:
  Layout(Records records, char separator) : records_(std::move(records)), separator_(separator) {
    if (separator == ' ') join_units();
  }

  /// Whether there are two columns or more with numbers, or, of `narrow`, one.
  bool find(bool narrow) {
    for (const bool numbers_first : {true, false}) {
      for (first_ = 0; first_ < records_.size(); ++first_) {
        if (begins_body(first_, numbers_first, narrow)) return true;
      }
    }
    return false;
  }

  /// The table; nothing with the fault where a row has another number of fields.
  std::optional<ForeignTable> table(const std::vector<std::string>& comment_titles, Fault& fault) {
    ForeignTable table;
    table.separator = separator_;
    std::size_t width = records_[first_].fields.size();
    std::vector<std::string> titles, units, groups(width);
    if (const auto above = titles_above(first_)) {
      titles = records_[*above].fields;
      if (*above + 1 < first_) units = records_[*above + 1].fields;
      width = std::max(used(records_[*above]), std::min(titles.size(), most_used()));
      groups.resize(width);
      for (std::size_t i = *above; i > 0 && is_group_row(i - 1, titles, width); --i)
        add_groups(records_[i - 1].fields, titles, groups);
    } else if (first_ > 0 && used(records_[first_ - 1]) > 1 && is_words(records_[first_ - 1])) {
      return fail(fault, records_[first_ - 1].fields.size(), first_);
    } else if (comment_titles.size() == width) {
      titles = comment_titles;
    }
    table.has_titles = !titles.empty();
    titles.resize(width), units.resize(width), groups.resize(width);
    for (std::size_t i = 0; i < width; ++i)
      table.columns.push_back(column(titles[i], units[i], groups[i], i, table.has_titles));
    for (std::size_t i = first_; i < records_.size(); ++i) {
      Record& record = records_[i];
      const std::size_t filled = used(record);
      if (filled == 0 && record.fields.size() != 1) continue;
      if (filled > width || record.fields.size() < width) return fail(fault, width, i);
      record.fields.resize(width);
      table.rows.push_back(std::move(record.fields));
      table.lines.push_back(record.line);
    }
    if (separator_ != ',') replace_decimal_commas(table.rows);
    return table;
  }

  /// The table whose titles are the first record, where nothing shows numbers.
  std::optional<ForeignTable> plain_table(Fault& fault) {
    if (records_.empty()) {
      fault = {Fault::Kind::empty, 1, 0, 0, separator_};
      return std::nullopt;
    }
    first_ = 1;
    ForeignTable table;
    table.separator = separator_;
    const std::vector<std::string> titles = records_[0].fields;
    for (std::size_t i = 0; i < titles.size(); ++i)
      table.columns.push_back(column(titles[i], "", "", i, true));
    for (std::size_t i = 1; i < records_.size(); ++i) {
      Record& record = records_[i];
      if (record.fields.size() != titles.size()) return fail(fault, titles.size(), i);
      table.rows.push_back(std::move(record.fields));
      table.lines.push_back(record.line);
    }
    return table;
  }

  std::size_t first_line() const {
    return first_ < records_.size() ? records_[first_].line : std::size_t(-1);
  }
  std::size_t header_width() const { return records_.empty() ? 0 : records_[0].fields.size(); }

 private:
  /// "time [s] z [m]" between blanks is two titles: a unit in brackets belongs to the field before.
  void join_units() {
    for (Record& record : records_) {
      std::vector<std::string> fields;
      for (std::string& field : record.fields) {
        const bool is_unit = field.size() > 2 && (field.front() == '[' || field.front() == '(') &&
                             (field.back() == ']' || field.back() == ')');
        if (is_unit && !fields.empty() && fields.back().back() != ']' &&
            fields.back().back() != ')')
          fields.back() += ' ' + field;
        else
          fields.push_back(std::move(field));
      }
      record.fields = std::move(fields);
    }
  }

  std::nullopt_t fail(Fault& fault, std::size_t expected, std::size_t record) const {
    fault = {Fault::Kind::field_count, records_[record].line, expected,
             records_[record].fields.size(), separator_};
    return std::nullopt;
  }

  bool number(const std::string& field) const { return is_number(field, separator_); }
  bool has_number(const Record& record) const {
    return std::ranges::any_of(record.fields, [&](const auto& field) { return number(field); });
  }
  bool is_words(const Record& record) const { return !has_number(record); }

  /// A row that begins with a number, or with words and has a number further on.
  bool is_row(const Record& record, bool numbers_first) const {
    if (record.fields.empty()) return false;
    return numbers_first ? number(record.fields[0]) : has_number(record);
  }

  bool begins_body(std::size_t at, bool numbers_first, bool narrow) const {
    const Record& record = records_[at];
    if (!is_row(record, numbers_first) || (used(record) < 2 && record.fields.size() < 2) == !narrow)
      return false;
    const std::size_t width = record.fields.size();
    const auto above = titles_above(at);
    if (above && !is_row(records_[*above], numbers_first)) return true;
    if (!numbers_first) return false;
    return at + 1 == records_.size() ||
           (is_row(records_[at + 1], numbers_first) && records_[at + 1].fields.size() == width);
  }

  /// Where the titles of a body that begins at `at` stand: above it, or above its units.
  std::optional<std::size_t> titles_above(std::size_t at) const {
    const Record& row = records_[at];
    if (at > 1 && is_units_row(records_[at - 1]) && are_titles(records_[at - 2], row))
      return at - 2;
    if (at > 0 && are_titles(records_[at - 1], row)) return at - 1;
    return std::nullopt;
  }

  /// Words, as many as the row has fields; either may end in empty fields.
  bool are_titles(const Record& record, const Record& row) const {
    const bool words = std::ranges::any_of(
        record.fields, [&](const auto& field) { return !field.empty() && !number(field); });
    return words && used(record) <= row.fields.size() && record.fields.size() >= used(row);
  }

  /// Every field that is not empty names a unit, with or without brackets; one field at least.
  static bool is_units_row(const Record& record) {
    bool any = false;
    for (const std::string& field : record.fields) {
      if (field.empty()) continue;
      const std::string unit = bare_unit(field);
      if (!unit.empty() && !parse_unit(unit)) return false;
      any = true;
    }
    return any;
  }

  /// "[mm]", "(mm)" and "mm" are mm; "-" is no unit.
  static std::string bare_unit(const std::string& field) {
    std::string_view text = field;
    if (text.size() > 1 && ((text.front() == '[' && text.back() == ']') ||
                            (text.front() == '(' && text.back() == ')')))
      text = text.substr(1, text.size() - 2);
    return usual_unit(text);
  }

  /// A further row of titles: several words over the table's columns, or a row that names itself in
  /// its second column.
  bool is_group_row(std::size_t at, const std::vector<std::string>& titles,
                    std::size_t width) const {
    const Record& record = records_[at];
    const bool has_label = !record.fields[0].empty();
    const bool sits_above = !has_label || (is_words(record) && width > 2 &&
                                           (titles[0].empty() || used(record) == width));
    const bool adjoins = record.line + 1 == records_[at + 1].line;
    return sits_above && adjoins && used(record) > 1 && used(record) <= width;
  }

  /// Words that stand over several columns stand over the first of them.
  static void add_groups(const std::vector<std::string>& row, std::vector<std::string>& titles,
                         std::vector<std::string>& groups) {
    std::string over;
    for (std::size_t i = 0; i < titles.size(); ++i) {
      const std::string& field = i < row.size() ? row[i] : "";
      if (!field.empty()) over = field;
      if (titles[i].empty()) {
        titles[i] = field;
      } else if (!over.empty() && i < groups.size()) {
        groups[i] = groups[i].empty() ? over : over + ' ' + groups[i];
      }
    }
  }

  std::size_t most_used() const {
    std::size_t most = 0;
    for (std::size_t i = first_; i < records_.size(); ++i) most = std::max(most, used(records_[i]));
    return most;
  }

  static Column column(const std::string& title, const std::string& unit, const std::string& group,
                       std::size_t number, bool titled) {
    if (!titled) {
      const std::string name = std::to_string(number + 1);
      return {name, name, bare_unit(unit), group};
    }
    const ColumnTitle parts = parts_of(title);
    Column column{title, parts.name, parts.unit.empty() ? bare_unit(unit) : parts.unit, group};
    if (is_clock(column)) column.group.clear();
    return column;
  }

  Records records_;
  char separator_;
  std::size_t first_ = 0;  ///< record of the first row of numbers
};

/// The fields of the last comment above the first row, where it may be a row of titles.
std::vector<std::string> titles_in_comment(const std::vector<std::string_view>& lines,
                                           std::size_t row, char separator) {
  for (std::size_t i = std::min(row - 1, lines.size()); i-- > 0;) {
    std::string_view line = trimmed(lines[i]);
    if (line.empty()) continue;
    const std::size_t marks = line.find_first_not_of("#%/");
    if (marks == 0 || marks == std::string_view::npos) return {};
    Fault fault;
    line = trimmed(line.substr(marks));
    const auto records = read_records(std::string(line) + '\n', {separator, true}, fault);
    return records && !records->empty() ? records->front().fields : std::vector<std::string>{};
  }
  return {};
}

/// Reads one section of a text.
class Section {
 public:
  explicit Section(std::string_view text) : lines_(lines_of(text)), preamble_(preamble_of(lines_)) {
    if (!lines_.empty() && lines_[0].starts_with("sep=") && trimmed(lines_[0]).size() == 5) {
      stated_separator_ = trimmed(lines_[0])[4];
      preamble_.lines = 1;
    }
    // The lines of the preamble stay as empty ones, so that rows know their lines.
    body_.assign(preamble_.lines, '\n');
    for (std::size_t i = preamble_.lines; i < lines_.size(); ++i) {
      body_ += lines_[i];
      body_ += '\n';
    }
  }

  std::optional<ForeignTable> read(Fault& fault) {
    std::optional<Fault> first;
    bool found = false;
    for (const char separator : {';', '\t', ',', ' '}) {
      if (stated_separator_ != 0 && separator != stated_separator_) continue;
      if (separator != ' ' && body_.find(separator) == std::string::npos) continue;
      // Where commas make a table but for a row of it, blanks are not what separates.
      if (found && separator == ' ') break;
      auto records = read_records(body_, {separator, true}, fault);
      if (!records) return std::nullopt;
      Layout layout(*std::move(records), separator);
      if (layout.find(false)) {
        found = true;
        const auto in_comment = titles_in_comment(lines_, layout.first_line(), separator);
        if (auto table = layout.table(in_comment, fault)) return finished(*std::move(table));
      } else if (layout.header_width() < 2 || separator == ' ') {
        continue;
      } else if (auto table = layout.plain_table(fault)) {
        return finished(*std::move(table));
      }
      if (!first) first = fault;
    }
    if (first) {
      fault = *first;
      return std::nullopt;
    }
    return one_column(fault);
  }

 private:
  std::optional<ForeignTable> one_column(Fault& fault) {
    auto records = read_records(body_, {',', true}, fault);
    if (!records) return std::nullopt;
    Layout layout(*std::move(records), ',');
    auto table = layout.find(true)
                     ? layout.table(titles_in_comment(lines_, layout.first_line(), ','), fault)
                     : layout.plain_table(fault);
    return table ? std::optional(finished(*std::move(table))) : std::nullopt;
  }

  ForeignTable finished(ForeignTable table) const {
    table.format = preamble_.format;
    table.time_unit = preamble_.time_unit;
    table.sample_rate = preamble_.sample_rate;
    table.in_degrees = preamble_.in_degrees;
    const std::size_t first = table.lines.empty() ? lines_.size() + 1 : table.lines[0];
    for (std::size_t i = 0; i + 1 < first && i < lines_.size() && table.sample_rate == 0.; ++i)
      table.sample_rate = rate_in(lines_[i]);
    if (!table.has_titles && table.columns.size() == 3 * preamble_.names.size())
      name_by_markers(table);
    if (is_of_ros(first)) {
      table.format = "a table of ROS";
      table.time_unit = "ns";
    }
    for (Column& column : table.columns)
      if (column.unit.empty() && !is_clock(column)) column.unit = preamble_.unit;
    return table;
  }

  void name_by_markers(ForeignTable& table) const {
    constexpr std::array axes{"X", "Y", "Z"};
    table.has_titles = true;
    table.has_times = false;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      Column& column = table.columns[i];
      column.title = column.name = preamble_.names[i / 3] + ' ' + axes[i % 3];
    }
  }

  /// `rostopic echo -p` writes `%time` and nanoseconds.
  bool is_of_ros(std::size_t first_row) const {
    for (std::size_t i = 0; i + 1 < first_row && i < lines_.size(); ++i)
      if (lines_[i].starts_with("%time,")) return true;
    return false;
  }

  std::vector<std::string_view> lines_;
  Preamble preamble_;
  std::string body_;
  char stated_separator_ = 0;
};

/// "time_ms" -> "time" and "ms"; an empty unit where the name ends in no unit of time.
ColumnTitle parts_of_clock(const std::string& name) {
  for (const std::string_view unit : {"s", "ms", "us", "ns"})
    if (name.size() > unit.size() && name.ends_with(unit) &&
        name[name.size() - unit.size() - 1] == '_')
      return {name.substr(0, name.size() - unit.size() - 1), std::string(unit)};
  return {name, ""};
}

/// "kNm" is kN.m, "N-m" N.m: what programs write for the product of a force and a length.
void replace_torque(std::string& unit, std::string_view written) {
  const std::size_t at = unit.find(written);
  if (at != std::string::npos) unit.replace(at, written.size(), written == "Nmm" ? "N.mm" : "N.m");
}

}  // namespace

std::vector<std::string> ForeignTable::titles() const {
  std::vector<std::string> titles;
  for (const Column& column : columns) titles.push_back(column.title);
  return titles;
}

std::optional<std::vector<ForeignTable>> read_foreign(std::string_view given, Fault& fault) {
  const std::string text = in_utf8(given);
  const std::vector<std::string_view> lines = lines_of(text);
  std::vector<ForeignTable> tables;
  std::size_t begin = 0, line = 0;
  const auto read_up_to = [&](std::size_t end) {
    auto table = Section(std::string_view(text).substr(begin, end - begin)).read(fault);
    if (!table) fault.line += line;
    if (!table) return false;
    for (std::size_t& row : table->lines) row += line;
    tables.push_back(*std::move(table));
    return true;
  };
  const bool has_sections = begins_section(lines, 0);
  for (std::size_t i = 1; has_sections && i < lines.size(); ++i) {
    if (!begins_section(lines, i)) continue;
    const auto end = static_cast<std::size_t>(lines[i].data() - text.data());
    if (!read_up_to(end)) return std::nullopt;
    begin = end;
    line = i;
  }
  if (!read_up_to(text.size())) return std::nullopt;
  return tables;
}

ColumnTitle parts_of(const std::string& title) {
  for (const auto& [opening, closing] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t open = title.rfind(opening);
    if (open == std::string::npos || open == 0 || !title.ends_with(closing)) continue;
    // "a[0]" is an element; a unit stands apart, or is one.
    const std::string inside =
        usual_unit(std::string_view(title).substr(open + 1, title.size() - open - 2));
    const bool apart = title[open - 1] == ' ';
    if ((closing == ')' || !apart) && (inside.empty() || !parse_unit(inside))) continue;
    return {std::string(trimmed(std::string_view(title).substr(0, open))), inside};
  }
  const std::size_t stroke = title.rfind(" / ");
  if (stroke != std::string::npos && stroke > 0) {
    const std::string unit = usual_unit(std::string_view(title).substr(stroke + 3));
    if (!unit.empty() && parse_unit(unit)) return {title.substr(0, stroke), unit};
  }
  return {title, ""};
}

std::string usual_unit(std::string_view given) {
  std::string unit(trimmed(given));
  const auto replace = [&](std::string_view from, std::string_view by) {
    for (std::size_t at = 0; (at = unit.find(from, at)) != std::string::npos; at += by.size())
      unit.replace(at, from.size(), by);
  };
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> signs{{{"²", "^2"},
                                                                                {"³", "^3"},
                                                                                {"·", "."},
                                                                                {"⋅", "."},
                                                                                {"*", "."},
                                                                                {"°", "deg"},
                                                                                {"µ", "u"},
                                                                                {"μ", "u"},
                                                                                {"⁻¹", "^-1"}}};
  for (const auto& [from, by] : signs) replace(from, by);
  if (unit == "-" || unit == "--" || unit == "1") return "";
  for (const std::string_view torque : {"Nmm", "Nm", "N-m", "N m"}) replace_torque(unit, torque);
  if (parse_unit(unit)) return unit;
  constexpr std::array<std::pair<std::string_view, std::string_view>, 22> words{
      {{"sec", "s"},           {"secs", "s"},         {"second", "s"},        {"seconds", "s"},
       {"msec", "ms"},         {"millisecond", "ms"}, {"milliseconds", "ms"}, {"usec", "us"},
       {"microseconds", "us"}, {"degree", "deg"},     {"degrees", "deg"},     {"radian", "rad"},
       {"radians", "rad"},     {"meter", "m"},        {"meters", "m"},        {"metre", "m"},
       {"metres", "m"},        {"millimeters", "mm"}, {"millimetres", "mm"},  {"centimeters", "cm"},
       {"newton", "N"},        {"newtons", "N"}}};
  // Factor by factor: "deg/sec", "Nm/rad".
  std::string result;
  for (std::size_t at = 0; at <= unit.size();) {
    const std::size_t end = std::min(unit.find_first_of("./^", at), unit.size());
    const std::string factor = unit.substr(at, end - at), word = lower_case(trimmed(factor));
    const auto* const found =
        std::ranges::find(words, word, [](const auto& pair) { return pair.first; });
    result += found == words.end() ? factor : std::string(found->second);
    if (end < unit.size()) result += unit[end];
    at = end + 1;
  }
  return parse_unit(result) ? result : unit;
}

bool counts_rows(const Column& column) {
  constexpr std::array names{"",       "frame",  "frame#",    "frames",    "frame number",
                             "index",  "sample", "samples",   "sub frame", "subframe",
                             "number", "no",     "no.",       "nr",        "#",
                             "row",    "item",   "unnamed: 0"};
  return std::ranges::find(names, lower_case(column.name)) != names.end();
}

bool is_called_time(const Column& column) {
  constexpr std::array names{"time", "t",     "%time", "__time",       "timestamp",
                             "zeit", "temps", "clock", "elapsed time", "time stamp"};
  const std::string name = parts_of_clock(lower_case(column.name)).name;
  return std::ranges::find(names, name) != names.end();
}

std::string unit_in_name(const std::string& name) { return parts_of_clock(name).unit; }

std::optional<std::string> text_of_table(const std::filesystem::path& file, std::string& problem) {
  problem = refusal(file, Use::series);
  if (!problem.empty()) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream.is_open() || stream.bad()) {
    problem = "cannot be read";
    return std::nullopt;
  }
  constexpr std::size_t most = 1024;
  const bool wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  const bool readable = wide || std::ranges::all_of(text.substr(0, most), [](char c) {
                          const bool blank = c == '\t' || c == '\r' || c == '\n';
                          return blank || static_cast<unsigned char>(c) >= ' ';
                        });
  if (readable) return text;
  problem = "this is not a text file";
  return std::nullopt;
}

std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+') && field.size() > 1 && field[1] != '-') field.remove_prefix(1);
  double value = 0.;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

bool is_gap(std::string_view field) {
  constexpr std::array<std::string_view, 7> missing{"", "nan", "-nan", "na", "n/a", "null", "none"};
  return std::ranges::find(missing, lower_case(trimmed(field))) != missing.end();
}

}  // namespace hookpoint::text
