// Reader of comma-separated values: text to records of fields. foreign_table.h makes tables of what
// other programs write.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::text {

/// A header, and rows with as many fields.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< line of the text on which each row begins, from 1
  std::size_t header_line = 0;     ///< the same of the header
  char separator = ',';
};

/// The fields between two line ends outside quotes.
struct Record {
  std::vector<std::string> fields;
  std::size_t line = 0;  ///< on which it begins, from 1
};

/// What a text separates its fields by, and whether it was written by hand or by another program.
struct Dialect {
  char separator = ',';  ///< ' ': any number of blanks and tabs
  /// Empty lines and lines that begin with #, % or // are no records; blanks around a field are not
  /// part of it.
  bool comments = false;
};

/// Why a text is no table.
struct Fault {
  enum class Kind { empty, open_quote, field_count };
  Kind kind = Kind::empty;
  std::size_t line = 0;  ///< from 1
  std::size_t expected = 0, found = 0;
  char separator = ',';

  /// "expected 2 fields, found 3, separated by semicolons"; what to do where commas stand in
  /// numbers.
  std::string text() const;
};

/// The table in this dialect, or nothing with the fault. Lines end in \n or \r\n; fields may be in
/// quotes, "" inside is a quote. A last line without its end does not count: a file that was cut
/// off is read up to its last whole row.
std::optional<Table> read(std::string_view text, const Dialect& dialect, Fault& fault);

/// The same text record by record, whatever their numbers of fields; nothing with the fault where a
/// quote is not closed.
std::optional<std::vector<Record>> read_records(std::string_view text, const Dialect& dialect,
                                                Fault& fault);

/// "semicolons", "tabs", "blanks", "commas".
std::string_view separators(char separator);

}  // namespace hookpoint::text
