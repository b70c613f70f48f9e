// Comma-separated tables: UTF-8, one header row of `name [unit]`, \n line ends, fields quoted only
// where they must be.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/file.h"

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

/// The table that `text` holds. Nothing when a quote is left open or a row has not the header's
/// number of fields; a last line without its end does not count, so that a run that was cut off is
/// read up to its last whole row.
std::optional<CsvTable> parse_csv(std::string_view text);

/// The whole table or nothing. Throws FileError.
void write_csv(const std::filesystem::path& path, const CsvTable& table);

/// A channel of a trace: its trail and unit.
struct TraceColumn {
  std::string trail;  ///< "w.block.base.location.x"
  std::string unit;   ///< "m"; "" for none
};

/// `trace.csv` of a run, row by row while the run goes on. Columns `time [s]`, then one a trail.
/// Until `close` it is named `<path>.partial`; however the run ends, that holds every row so far,
/// whole lines all. A row costs no heap allocation.
class TraceWriter {
 public:
  /// Throws FileError.
  TraceWriter(const std::filesystem::path& path, const std::vector<TraceColumn>& columns);
  /// `values`: one a column, in its unit. `time` [s].
  /// Throws FileError.
  void row(double time, std::span<const double> values);
  void close();
  const std::filesystem::path& partial() const { return file_.partial(); }

 private:
  PartialFile file_;
  std::string line_;
};

}  // namespace hookpoint::output
