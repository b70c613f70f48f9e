#include "control/data/table.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "text/csv_reader.h"
#include "text/formats.h"
namespace hookpoint::control {
namespace {

/// "force [N]" -> "force".
std::string without_unit(const std::string& title) {
  const std::size_t open = title.rfind(" [");
  if (open == std::string::npos || title.back() != ']') return title;
  return title.substr(0, title.find_last_not_of(' ', open) + 1);
}

/// The text of a file. Refuses another format, and what no text editor wrote, by its first bytes.
std::string file_text(const std::filesystem::path& path) {
  if (const std::string refusal = text::refusal(path, text::Use::series); !refusal.empty())
    throw std::runtime_error(path.string() + ": " + refusal);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw std::runtime_error(path.string() + ": reading it failed");
  constexpr std::size_t most = 1024;
  const bool readable = std::ranges::all_of(text.substr(0, most), [](char c) {
    const bool blank = c == '\t' || c == '\r' || c == '\n';
    return blank || static_cast<unsigned char>(c) >= ' ';
  });
  if (!readable) throw std::runtime_error(path.string() + ": this is not a text file");
  return text;
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

void read_header(const std::vector<std::string>& titles, const std::string& where, Table& table) {
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

void read_row(const std::vector<std::string>& fields, const std::string& where, Table& table) {
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
  const auto where = [&](std::size_t line) { return path.string() + ":" + std::to_string(line); };
  text::Fault fault;
  const auto text = text::read_foreign(file_text(path), fault);
  if (!text && fault.kind == text::Fault::Kind::empty)
    throw std::runtime_error(path.string() + ": holds no row of numbers");
  if (!text) throw std::runtime_error(where(fault.line) + ": " + fault.text());
  Table table;
  read_header(text->header, where(text->header_line), table);
  for (std::size_t i = 0; i < text->rows.size(); ++i)
    read_row(text->rows[i], where(text->lines[i]), table);
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
