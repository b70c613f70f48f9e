#include "text/csv_reader.h"

#include <algorithm>
#include <utility>

namespace hookpoint::text {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Reads a text field by field.
class Reader {
 public:
  Reader(std::string_view text, const Dialect& dialect, Fault& fault)
      : text_(text), dialect_(dialect), fault_(fault) {
    table_.separator = dialect.separator;
  }

  std::optional<Table> read() {
    while (at_ < text_.size()) {
      if (dialect_.comments && skips_line()) continue;
      const std::size_t first = line_;
      auto row = next_row();
      if (!row) break;
      if (!add(std::move(*row), first)) return std::nullopt;
    }
    if (quoted_) return fail(Fault::Kind::open_quote, quote_line_);
    if (table_.header.empty()) return fail(Fault::Kind::empty, 1);
    return std::move(table_);
  }

 private:
  bool skips_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::size_t first = text_.find_first_not_of(blanks, at_);
    if (first < end && text_[first] != '#') return false;
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return true;
  }

  /// The fields up to the next line end outside quotes; nothing where the text ends before one.
  std::optional<std::vector<std::string>> next_row() {
    std::vector<std::string> row;
    std::string field;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      const bool more = at_ + 1 < text_.size();
      if (c == '\n') ++line_;
      if (c == '\r' && !quoted_ && more && text_[at_ + 1] == '\n') continue;
      if (quoted_ && c == '"' && more && text_[at_ + 1] == '"') {
        field += text_[++at_];
      } else if (c == '"') {
        quoted_ = !quoted_;
        quote_line_ = line_;
      } else if (quoted_ || (c != dialect_.separator && c != '\n')) {
        field += c;
      } else {
        row.push_back(std::exchange(field, {}));
        if (c != '\n') continue;
        ++at_;
        return row;
      }
    }
    return std::nullopt;
  }

  bool add(std::vector<std::string> row, std::size_t line) {
    if (dialect_.comments)
      for (std::string& field : row) field = trimmed(field);
    if (table_.header.empty()) {
      table_.header = std::move(row);
      table_.header_line = line;
      return true;
    }
    if (row.size() != table_.header.size()) {
      fail(Fault::Kind::field_count, line);
      fault_.expected = table_.header.size();
      fault_.found = row.size();
      return false;
    }
    table_.rows.push_back(std::move(row));
    table_.lines.push_back(line);
    return true;
  }

  std::nullopt_t fail(Fault::Kind kind, std::size_t line) {
    fault_ = {kind, line, 0, 0, dialect_.separator};
    return std::nullopt;
  }

  std::string_view text_;
  const Dialect& dialect_;
  Fault& fault_;
  std::size_t at_ = 0, line_ = 1, quote_line_ = 1;
  bool quoted_ = false;
  Table table_;
};

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

void replace_decimal_commas(Table& table) {
  for (const auto& row : table.rows)
    for (const std::string& field : row)
      if (place_of_mark(field, '.') != std::string::npos) return;
  for (auto& row : table.rows) {
    for (std::string& field : row) {
      const std::size_t comma = place_of_mark(field, ',');
      if (comma != std::string::npos) field[comma] = '.';
    }
  }
}

}  // namespace

std::string_view separators(char separator) {
  return separator == ';' ? "semicolons" : separator == '\t' ? "tabs" : "commas";
}

std::string Fault::text() const {
  if (kind == Kind::empty) return "it is empty";
  if (kind == Kind::open_quote) return "a quote is not closed";
  std::string words = "expected " + std::to_string(expected) +
                      (expected == 1 ? " field" : " fields") + ", found " + std::to_string(found) +
                      ", separated by ";
  words += separators(separator);
  if (separator == ',' && found > expected)
    words += "; where commas stand in numbers, separate the fields by semicolons";
  return words;
}

std::optional<Table> read(std::string_view text, const Dialect& dialect, Fault& fault) {
  return Reader(text, dialect, fault).read();
}

std::optional<Table> read_foreign(std::string_view text, Fault& fault) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  const std::string whole = text.ends_with('\n') ? std::string(text) : std::string(text) + '\n';
  std::optional<Fault> first;
  for (const char separator : {';', '\t', ','}) {
    const Dialect dialect{separator, true};
    auto table = Reader(whole, dialect, fault).read();
    // One column is a table where the header has no separator.
    if (table && (table->header.size() > 1 || (separator == ',' && !first))) {
      if (separator != ',') replace_decimal_commas(*table);
      return table;
    }
    // Where no separator fits, the fault of the first that the header has is the one to mend.
    const bool has = !table && fault.kind == Fault::Kind::field_count && fault.expected > 1;
    if (has && !first) first = fault;
  }
  if (first) fault = *first;
  return std::nullopt;
}

}  // namespace hookpoint::text
