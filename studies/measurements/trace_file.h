// Measured curves as their file has them: columns over time of a table like those that a run
// leaves, of one case or of many.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/units.h"
#include "text/series.h"

namespace hookpoint::studies {

/// The columns of a file that a Trace names, and where it does.
struct TraceRequest {
  std::filesystem::path file;
  std::vector<std::string> columns;  ///< "z [m]", or the name alone where one column has it
  std::string time;                  ///< the same; "": the first column
  std::string case_column;           ///< that says which case a row is of; "": all are of one
  language::Position file_place, column_place, time_place;
  std::optional<double> offset = {};  ///< what the clock reads at time 0 of the scene [s]
  /// Whether samples may be earlier than time 0, as where the offset is fitted.
  bool may_be_early = false;
  std::string unit = {}, time_unit = {};  ///< of tables that do not say theirs
  double sample_rate = 0.;                ///< of tables without times [Hz]
};

/// Samples in SI, in order of time; all finite.
struct MeasuredTrace {
  std::vector<double> time;   ///< [s], rising: the clock's less the offset
  std::vector<double> value;  ///< in SI, `width` a sample
  std::size_t width = 1;      ///< columns
  language::Unit unit;        ///< that the first column is written in

  const double* sample(std::size_t number) const { return value.data() + number * width; }
};

/// Later samples would take a run of decades [s].
constexpr double latest_sample = 1e9;

/// The tables of a file, one but where its format has several; nothing after an error at `place`.
std::optional<std::vector<text::ForeignTable>> read_tables(const std::filesystem::path& file,
                                                           const language::Position& place,
                                                           language::Diagnostics& diagnostics);

/// The column of that title, name or number (text/series.h); nothing after an error at `place`.
std::optional<std::size_t> column_of(const text::ForeignTable& table, const std::string& wanted,
                                     const std::filesystem::path& file,
                                     const language::Position& place,
                                     language::Diagnostics& diagnostics);

/// Error in a row of a table: "FILE, row 3: WHAT" with the row's line in the file, at `place`.
void tell_wrong_row(const std::filesystem::path& file, const text::ForeignTable& table,
                    std::size_t row, const std::string& what, const language::Position& place,
                    language::Diagnostics& diagnostics);

/// The finite number in a field; nothing after an error at `place`.
std::optional<double> number_at(const text::ForeignTable& table, std::size_t row,
                                std::size_t column, const std::filesystem::path& file,
                                const language::Position& place,
                                language::Diagnostics& diagnostics);

/// One trace a case, by the text in the case's column; without such a column one, of the name "".
/// Nothing after errors, which say file, line and column: a sample before time 0 or after
/// latest_sample, times that do not rise. A sample of which a field is missing is left out.
std::optional<std::map<std::string, MeasuredTrace>> read_traces(const TraceRequest& request,
                                                                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
