// Tables of other programs: loggers, spreadsheets, motion capture, OpenSim, ROS. What stands above
// the numbers is recognised by its layout and, where a format has rules of its own, by the format.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/csv_reader.h"

namespace hookpoint::text {

/// What stands above a column of numbers.
struct Column {
  std::string title;  ///< as it is written, "z [m]"; without titles its number, "3", from 1
  std::string name;   ///< the title without its unit
  std::string unit;   ///< "mm"; "" where nothing says one
  std::string group;  ///< what rows above the titles say, "Left foot"; "" without such rows

  /// "Left foot X", or the name alone.
  std::string full_name() const { return group.empty() ? name : group + ' ' + name; }
};

struct ForeignTable {
  std::string format;  ///< "OpenSim", "a table of ROS"; "" of no format of its own
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< as many fields each as there are columns
  std::vector<std::size_t> lines;              ///< line of the text on which each row begins
  char separator = ',';                        ///< ' ': blanks
  bool has_titles = true;
  bool has_times = true;    ///< false: the format has rows at its rate, without a column of times
  double sample_rate = 0.;  ///< that the lines above the numbers say [Hz]; 0: none
  std::string time_unit;    ///< that the format prescribes where no title says one: "s"; "": none
  bool in_degrees = false;  ///< OpenSim's `inDegrees=yes`: its angles are in degrees

  std::vector<std::string> titles() const;
};

/// The tables of a text, one unless a format has several, as Vicon Nexus has one a section; nothing
/// with the fault. Understood are: a byte-order mark, UTF-16, a last line without its end, `sep=;`;
/// comment lines (#, %, //), of which the last is the row of titles where no other is; title
/// lines and key-value lines above the table; several rows of titles; a row of units below them;
/// no titles. Fields are separated by semicolons, tabs, commas or blanks: the first of these that
/// makes a table. But for commas as separators, a comma in a number is a decimal comma, unless
/// another number of the table has a decimal point; fields then have a point.
std::optional<std::vector<ForeignTable>> read_foreign(std::string_view text, Fault& fault);

/// A title in its parts: "z [m]", "z (m)" and "z / m" are z in m. What stands in parentheses or
/// behind the stroke and is no unit belongs to the name.
struct ColumnTitle {
  std::string name, unit;
};
ColumnTitle parts_of(const std::string& title);

/// Whether a column counts rows or frames: its name is "Frame", "Sub Frame", "index", "" ...
bool counts_rows(const Column& column);
/// Whether a column is called a time: "Time", "t", "timestamp", "time_ms" ...
bool is_called_time(const Column& column);
/// The unit with which the name of a column of times ends, "ms" of "time_ms"; "" without one.
std::string unit_in_name(const std::string& name);

/// The text of a file that may hold tables; nothing with the problem: it cannot be read, is of
/// another format, or is no text.
std::optional<std::string> text_of_table(const std::filesystem::path& file, std::string& problem);

/// A unit as programs write it, as units.h has it: "Seconds" is s, "Nm" N.m, "m/s²" m/s^2, "°" deg.
/// What is none comes back as it is.
std::string usual_unit(std::string_view unit);

/// The finite number that is the whole field; nothing for any other text.
std::optional<double> number_in(std::string_view field);

/// Whether a field stands for a missing value: it is empty, or says NaN, NA, N/A, null or none.
bool is_gap(std::string_view field);

}  // namespace hookpoint::text
