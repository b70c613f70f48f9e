// Comma-separated tables: UTF-8, one header row of `name [unit]`, \n line ends, fields quoted only
// where they must be.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/files/file.h"

namespace hookpoint::output {

/// "creep_speed [m/s]"; a column without a unit is its bare name.
std::string column_title(std::string_view name, std::string_view unit);

/// A field as it stands in a file: in quotes when it holds a comma, a quote or a line end.
std::string csv_field(std::string_view text);

/// A table in memory. A number is its shortest round-trip text; an empty field is a value that
/// there is not.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  std::string text() const;
};

/// The table that `text`, which this program wrote, holds; lines end in \n or \r\n. Nothing when a
/// quote is left open or a row has not the header's number of fields; a last line without its end
/// does not count, so that a run that was cut off is read up to its last whole row.
std::optional<CsvTable> parse_csv(std::string_view text);

/// The whole table or nothing. Throws FileError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

/// A channel of a trace: its trail and unit.
struct TraceColumn {
  std::string trail;  ///< "w.block.base.location.x"
  std::string unit;   ///< "m"; "" for none
};

/// `trace.csv` of a run, row by row while the run continues. Columns `time [s]`, then one a trail.
/// Until `close` it is named `<path>.partial`. Rows go to the operating system in blocks: however
/// the process ends, that file holds whole lines, up to at most `block_bytes` and `block_time`
/// before the end. A row costs no heap allocation.
class TraceWriter {
 public:
  static constexpr std::size_t block_bytes = 4096;
  static constexpr double block_time = 0.05;  ///< [s], of the run

  /// Throws FileError.
  TraceWriter(const std::filesystem::path& path, const std::vector<TraceColumn>& columns);
  /// The rows that wait are written if they can be.
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// `values`: one a column, in its unit. `time` [s]. Throws FileError; the rows before the one
  /// that did not fit are in the file, and no row may follow.
  void row(double time, std::span<const double> values);
  void close();
  const std::filesystem::path& partial() const { return file_.partial(); }
  /// Rows in the file.
  std::int64_t written() const { return written_; }

 private:
  void write_block();
  /// Those that fit.
  void write_lines(std::string_view lines);

  PartialFile file_;
  std::string block_;  ///< rows that wait
  std::int64_t written_ = 0, waiting_ = 0;
  double last_block_ = -std::numeric_limits<double>::infinity();  ///< its time [s]
};

}  // namespace hookpoint::output
