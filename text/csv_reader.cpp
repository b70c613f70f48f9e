#include "text/csv_reader.h"

#include <algorithm>
#include <utility>

#include "text/letters.h"

namespace hookpoint::text {
namespace {

constexpr std::string_view blanks = " \t\r";

/// Reads a text field by field.
class Reader {
 public:
  Reader(std::string_view text, const Dialect& dialect, Fault& fault)
      : text_(text), dialect_(dialect), fault_(fault) {}

  std::optional<std::vector<Record>> read() {
    std::vector<Record> records;
    while (at_ < text_.size()) {
      if (dialect_.comments && skips_line()) continue;
      const std::size_t first = line_;
      auto row = next_row();
      if (!row) break;
      if (dialect_.comments)
        for (std::string& field : *row) field = std::string(trimmed(field));
      records.push_back({std::move(*row), first});
    }
    if (!quoted_) return records;
    fault_ = {Fault::Kind::open_quote, quote_line_, 0, 0, dialect_.separator};
    return std::nullopt;
  }

 private:
  bool skips_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::size_t first = text_.find_first_not_of(blanks, at_);
    const std::string_view line = first < end ? text_.substr(first, end - first) : "";
    if (!line.empty() && line[0] != '#' && line[0] != '%' && !line.starts_with("//")) return false;
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return true;
  }

  /// The fields up to the next line end outside quotes; nothing where the text ends before one.
  std::optional<std::vector<std::string>> next_row() {
    std::vector<std::string> row;
    std::string field;
    const bool of_blanks = dialect_.separator == ' ';
    const auto separates = [&](char c) {
      return of_blanks ? c == ' ' || c == '\t' : c == dialect_.separator;
    };
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
      } else if (quoted_ || (!separates(c) && c != '\n')) {
        field += c;
      } else {
        if (!of_blanks || !field.empty()) row.push_back(std::exchange(field, {}));
        if (c != '\n') continue;
        ++at_;
        return row;
      }
    }
    return std::nullopt;
  }

  std::string_view text_;
  const Dialect& dialect_;
  Fault& fault_;
  std::size_t at_ = 0, line_ = 1, quote_line_ = 1;
  bool quoted_ = false;
};

}  // namespace

std::string_view separators(char separator) {
  return separator == ';'    ? "semicolons"
         : separator == '\t' ? "tabs"
         : separator == ' '  ? "blanks"
                             : "commas";
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

std::optional<std::vector<Record>> read_records(std::string_view text, const Dialect& dialect,
                                                Fault& fault) {
  return Reader(text, dialect, fault).read();
}

std::optional<Table> read(std::string_view text, const Dialect& dialect, Fault& fault) {
  auto records = read_records(text, dialect, fault);
  if (!records) return std::nullopt;
  const auto fail = [&](Fault::Kind kind, std::size_t line) {
    fault = {kind, line, 0, 0, dialect.separator};
    return std::nullopt;
  };
  if (records->empty()) return fail(Fault::Kind::empty, 1);
  Table table;
  table.separator = dialect.separator;
  table.header = std::move(records->front().fields);
  table.header_line = records->front().line;
  for (std::size_t i = 1; i < records->size(); ++i) {
    Record& record = (*records)[i];
    if (record.fields.size() != table.header.size()) {
      fail(Fault::Kind::field_count, record.line);
      fault.expected = table.header.size();
      fault.found = record.fields.size();
      return std::nullopt;
    }
    table.rows.push_back(std::move(record.fields));
    table.lines.push_back(record.line);
  }
  return table;
}

}  // namespace hookpoint::text
