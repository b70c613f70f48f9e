// A table of numbers against time, read from a file: what Data and Controller.Trajectory look
// values up in.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::control {

/// A CSV file: a header row of `name` or `name [unit]`, then numbers; the first column is the time
/// [s], strictly increasing.
struct Table {
  std::vector<std::string> names;            ///< of the columns after the time, without units
  std::vector<double> time;                  ///< [s]
  std::vector<std::vector<double>> columns;  ///< columns[i][row]
};

/// Reads the whole table, separated by commas, semicolons or tabs (text/csv_reader.h). Empty
/// lines and lines that begin with # are skipped; fields may stand in quotes. Throws
/// std::runtime_error with file and line: no header, no rows, a row of other length, not a finite
/// number, time that does not increase.
Table read_csv_table(const std::filesystem::path& path);

/// Values of one column against time.
struct Series {
  std::vector<double> time;  ///< [s], strictly increasing
  std::vector<double> value;
};

/// The column `column` of a CSV file against its first. Throws std::runtime_error: what
/// read_csv_table throws, and a column that there is not (with those that there are).
Series read_csv_series(const std::filesystem::path& path, const std::string& column);

/// The vector `column` of a MAT file (v5 or 7.3) against its vector `time`. "run.force" is a field
/// of the structure `run`, and the time then the field `time` of the same structure if there is
/// one. A structure with a field `data`, a channel of a record, stands for that field. Throws
/// std::runtime_error with file and variable.
Series read_mat_series(const std::filesystem::path& path, const std::string& column);

/// "'a', 'b' and 7 more".
std::string list_of_names(const std::vector<std::string>& names);

/// Throws std::runtime_error unless `time` is finite and increases strictly; `where` begins the
/// message, as "x.mat: 'time'".
void check_increasing(const std::vector<double>& time, const std::string& where);

/// The last row i whose time is not after `time`, as far as there are rows: 0 before the first.
/// `time` is not empty. O(log n).
std::size_t row_at(const std::vector<double>& rows, double time);

}  // namespace hookpoint::control
