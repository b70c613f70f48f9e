#include "control/data/table.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "formats/formats.h"

namespace hookpoint::control {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Fields of one line; "" inside quotes is a quote.
std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      const bool doubled = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (doubled) fields.back() += line[i++];
      if (!doubled) quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

/// "force [N]" -> "force".
std::string without_unit(const std::string& title) {
  const std::size_t open = title.rfind(" [");
  return open != std::string::npos && title.back() == ']' ? trimmed(title.substr(0, open)) : title;
}

/// Refuses another format, and what no text editor wrote, by its first bytes.
void check_text(std::ifstream& file, const std::string& name) {
  const std::string refusal = formats::refusal(name, formats::Use::series);
  if (!refusal.empty()) throw std::runtime_error(name + ": " + refusal);
  char bytes[1024];
  file.read(bytes, sizeof bytes);
  const bool text = std::all_of(bytes, bytes + file.gcount(), [](char c) {
    const bool blank = c == '\t' || c == '\r' || c == '\n';
    return blank || static_cast<unsigned char>(c) >= ' ';
  });
  if (!text) throw std::runtime_error(name + ": this is not a text file");
  file.clear();
  file.seekg(0);
}

/// A field as it may be shown: short and printable.
std::string shown(const std::string& text) {
  constexpr std::size_t most = 30;
  std::string printable = text.substr(0, most);
  for (char& c : printable) {
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '?';
  }
  return "'" + printable + (text.size() > most ? "...'" : "'");
}

double parse_number(const std::string& text, const std::string& where, const std::string& column) {
  double number = 0.;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || !std::isfinite(number)) {
    throw std::runtime_error(where + ": " + shown(text) + " in column " + shown(column) +
                             " is not a finite number");
  }
  return number;
}

void read_header(const std::string& line, const std::string& where, Table& table) {
  std::vector<std::string> titles = split_fields(line);
  if (titles.size() < 2) {
    throw std::runtime_error(where +
                             ": expected a time column and at least one more, separated by commas");
  }
  double number = 0.;
  if (std::from_chars(titles[0].data(), titles[0].data() + titles[0].size(), number).ec ==
      std::errc{}) {
    throw std::runtime_error(where + ": expected a row of column names before the numbers");
  }
  for (std::size_t i = 1; i < titles.size(); ++i) table.names.push_back(without_unit(titles[i]));
  table.columns.resize(table.names.size());
}

void read_row(const std::string& line, const std::string& where, Table& table) {
  const std::vector<std::string> fields = split_fields(line);
  if (fields.size() != table.columns.size() + 1) {
    throw std::runtime_error(where + ": expected " + std::to_string(table.columns.size() + 1) +
                             " fields, found " + std::to_string(fields.size()));
  }
  const double time = parse_number(fields[0], where, "time");
  if (!table.time.empty() && time <= table.time.back()) {
    throw std::runtime_error(where + ": time " + fields[0] +
                             " is not after that of the row before");
  }
  table.time.push_back(time);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    table.columns[i].push_back(parse_number(fields[i + 1], where, table.names[i]));
  }
}

}  // namespace

Table read_csv_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  check_text(file, path.string());
  Table table;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const std::string where = path.string() + ":" + std::to_string(number);
    const std::string text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    if (table.columns.empty()) {
      read_header(text, where, table);
    } else {
      read_row(text, where, table);
    }
  }
  if (file.bad()) throw std::runtime_error(path.string() + ": reading it failed");
  if (table.time.empty()) throw std::runtime_error(path.string() + ": holds no row of numbers");
  return table;
}

Series read_csv_series(const std::filesystem::path& path, const std::string& column) {
  Table table = read_csv_table(path);
  const auto place = std::find(table.names.begin(), table.names.end(), column);
  if (place == table.names.end()) {
    throw std::runtime_error(path.string() + ": no column '" + column + "'; there are " +
                             list_of_names(table.names));
  }
  return {std::move(table.time), std::move(table.columns[place - table.names.begin()])};
}

std::string list_of_names(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += (i == 0 ? "" : ", ") + shown(names[i]);
  if (names.size() > most) list += " and " + std::to_string(names.size() - most) + " more";
  return list;
}

void check_increasing(const std::vector<double>& time, const std::string& where) {
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(time[i])) {
      throw std::runtime_error(where + ": element " + std::to_string(i + 1) + " is not finite");
    }
    if (i > 0 && time[i] <= time[i - 1]) {
      throw std::runtime_error(where + ": element " + std::to_string(i + 1) +
                               " is not after the one before");
    }
  }
}

std::size_t row_at(const std::vector<double>& rows, double time) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), time);
  return after == rows.begin() ? 0 : static_cast<std::size_t>(after - rows.begin()) - 1;
}

}  // namespace hookpoint::control
