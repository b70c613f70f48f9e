// Tables of numbers against time, read from files: what Data and Controller.Trajectory look values
// up in. Their common fields stand here once; text/series.h reads the tables.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "control/component.h"
#include "text/series.h"

namespace hookpoint::control {

/// Columns over time.
struct Table {
  std::vector<std::string> names;            ///< of the columns, without units
  std::vector<text::SeriesColumn> units;     ///< of the columns
  std::vector<double> time;                  ///< [s], strictly increasing
  std::vector<std::vector<double>> columns;  ///< in SI: columns[i][row]
  std::vector<std::string> notices;          ///< what was assumed of the file, for the user
};

/// Reads what `request` asks of a table as a text file (text/foreign_table.h). Throws
/// std::runtime_error with file and line: another format, no rows, a row of other length, not a
/// finite number, times that do not rise, no such column (with those that there are).
Table read_csv_table(const std::filesystem::path& path, const text::SeriesRequest& request = {});

/// The vector that `request` names in a MAT file (v5 or 7.3) against its vector `time`. "run.force"
/// is a field of the structure `run`, and the time then the field `time` of the same structure if
/// there is one. A structure with a field `data`, a channel of a record, stands for that field, in
/// the unit that a field `unit` beside it says. Throws std::runtime_error with file and variable.
Table read_mat_table(const std::filesystem::path& path, const text::SeriesRequest& request);

/// What a component that reads a table says of it after `start`.
struct TableReport {
  struct Unit {
    std::string output;  ///< "goal"
    std::size_t element = 0;
    std::string written;  ///< as the table has it: "kN"
    text::Dimension dimension;
  };
  std::vector<Unit> units;           ///< of the elements of outputs whose unit is known
  std::vector<std::string> notices;  ///< what was assumed of the file, beginning with its name
  double first = 0., last = 0.;      ///< row of the table, as a time of the simulation [s]
  bool repeats = false;              ///< so that it holds at all times
};

class ReadsTable {
 public:
  virtual ~ReadsTable() = default;
  const TableReport& report() const { return report_; }

 protected:
  TableReport report_;
};

/// How a table is to be read: the fields of every component that reads one.
struct TableFields {
  explicit TableFields(Component& owner);

  /// Reads these columns of the file (none: all but the times), and fills the report but for its
  /// units, which are of the component's own outputs. Throws as read_csv_table and read_mat_table.
  Table read(const std::vector<std::string>& columns, TableReport& report) const;

  Text file, time, time_unit, unit, gaps;
  Parameter sample_rate, start, offset;

 private:
  text::SeriesRequest request(const std::vector<std::string>& columns) const;
};

/// The last row i whose time is not after `time`, as far as there are rows: 0 before the first.
/// `time` is not empty. O(log n).
std::size_t row_at(const std::vector<double>& rows, double time);

}  // namespace hookpoint::control
