// Columns of numbers over time: the one reader of tables for Data, Controller.Trajectory and Trace.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/foreign_table.h"
#include "text/units.h"

namespace hookpoint::text {

/// What becomes of a missing value: an empty field, or NaN.
enum class Gaps {
  error,       ///< it is refused
  leave_out,   ///< the row does not count
  hold,        ///< it is the value before it
  interpolate  ///< it lies on the line between its neighbours
};

/// What a table is to give.
struct SeriesRequest {
  /// By title, name, full name or number; empty: all but the time.
  std::vector<std::string> columns;
  std::string time;         ///< the same; "": the table's own time
  std::string time_unit;    ///< of the times; "": as the table says
  std::string unit;         ///< of the columns; "": as the table says
  std::string case_column;  ///< that says which case a row is of; "": all are of one
  double sample_rate = 0.;  ///< rows are this often [Hz], whatever times they have; 0: as the times
  std::optional<double> offset;  ///< what the clock of the times reads at time 0 [s]
  Gaps gaps = Gaps::error;
  /// Whether times that nothing gives a unit are refused instead of taken as seconds.
  bool unit_of_time_needed = false;
};

/// A column that was read.
struct SeriesColumn {
  std::string title;
  std::string unit;  ///< that the table or the request says, "kN"; "" of none
  Unit scale;        ///< what it means
};

/// The rows of one case, in order of time.
struct Samples {
  std::vector<double> time;                  ///< [s], strictly increasing
  std::vector<std::vector<double>> columns;  ///< in SI: columns[i][row]
  std::vector<std::size_t> lines;            ///< line of each row in the file
};

struct SeriesTable {
  std::vector<SeriesColumn> columns;
  std::map<std::string, Samples> cases;  ///< by the text in the case's column; "" without one
  std::vector<std::string> notices;      ///< what was assumed, for the user
};

/// Why a table does not give it.
struct SeriesFault {
  enum class About { file, column, time };
  About about = About::file;
  std::size_t line = 0;  ///< of the file, from 1; 0: it is about all of it
  std::string problem;
  std::string wanted;   ///< the column that there is not, "" of other faults
  std::string columns;  ///< that there are, as words, where that helps

  std::string text() const { return problem + (columns.empty() ? "" : "; " + columns); }
};

/// The index of the column that `wanted` is: its title, its name, its full name or the words of that
/// which tell it from others, or, from 1, its number; nothing with the fault (none or several of
/// that name).
std::optional<std::size_t> find_column(const ForeignTable& table, std::string_view wanted,
                                       SeriesFault& fault);

/// The columns in SI over their times, of the first table of `tables` that has them. Times are those
/// of the column `time`, else of the first column, unless that counts rows or frames: then the
/// column called time, else the frames at the rate that the table or the request states. A clock
/// that begins at 1e8 s or later, without `offset`, begins at the first row. Of rows with the same
/// time the last counts. Nothing with the fault.
std::optional<SeriesTable> read_series(const std::vector<ForeignTable>& tables,
                                       const SeriesRequest& request, SeriesFault& fault);

/// Whether a clock that reads so at its first row [s] counts from a date, not from the begin of a
/// measurement: from 1e8 s on, which is 1973. Such a clock begins at that row, which the notice says.
constexpr bool counts_from_date(double first) { return first >= 1e8; }
inline constexpr const char* dated_clock_notice =
    "its clock counts from a date: the first row is taken as 0 s; `offset` says otherwise";

/// Gives each NaN of `values` a number: on the line between its neighbours, or the one before it;
/// before the first number and after the last these hold. False where there is no number.
bool fill_gaps(const std::vector<double>& time, std::vector<double>& values, Gaps gaps);

/// "the columns are `t [s]`, `z`, separated by commas".
std::string words_of_columns(const ForeignTable& table);

}  // namespace hookpoint::text
