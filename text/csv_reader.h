// Reader of comma-separated tables: those that the program writes, and those of other programs,
// with semicolons or tabs, comment lines and decimal commas.
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

/// What a text separates its fields by, and whether it was written by hand or by another program.
struct Dialect {
  char separator = ',';
  /// Empty lines and lines that begin with # are no rows; blanks around a field are not part of it.
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

/// The table of a text from elsewhere: with or without a byte-order mark and a last line end, with
/// comments, separated by semicolons, tabs or commas: the first of these with which the header has
/// several fields and every row as many. Between semicolons or tabs a comma in a number is a
/// decimal comma, unless another number of the table has a decimal point; fields then have a point.
std::optional<Table> read_foreign(std::string_view text, Fault& fault);

/// "semicolons", "tabs", "commas".
std::string_view separators(char separator);

}  // namespace hookpoint::text
