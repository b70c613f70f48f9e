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
#include "output/text/csv.h"

namespace hookpoint::studies {

/// What is asked of a file; where each was asked for.
struct TraceRequest {
  std::filesystem::path file;
  std::vector<std::string> columns;  ///< "z [m]", or the name alone where one column has it
  std::string time;                  ///< the same; "": the first column
  std::string case_column;           ///< that says which case a row is of; "": all are of one
  language::Position file_place, column_place, time_place;
};

/// Samples in SI, in order of time; all finite.
struct MeasuredTrace {
  std::vector<double> time;   ///< [s], rising, not before 0
  std::vector<double> value;  ///< in SI, `width` a sample
  std::size_t width = 1;      ///< columns
  language::Unit unit;        ///< that the first column is written in

  const double* sample(std::size_t number) const { return value.data() + number * width; }
};

/// A table with its header; nothing after an error at `place`.
std::optional<output::CsvTable> read_table(const std::filesystem::path& file,
                                           const language::Position& place,
                                           language::Diagnostics& diagnostics);

/// The column of that title, or the only one of that name; nothing after an error at `place`.
std::optional<std::size_t> column_of(const output::CsvTable& table, const std::string& wanted,
                                     const std::filesystem::path& file,
                                     const language::Position& place,
                                     language::Diagnostics& diagnostics);

/// "z [m]" in its parts.
struct ColumnTitle {
  std::string name, unit;
};
ColumnTitle parts_of(const std::string& title);

/// What a table's row has wrong: "FILE, row 3: WHAT", at `place`.
void tell_wrong_row(const std::filesystem::path& file, std::size_t row, const std::string& what,
                    const language::Position& place, language::Diagnostics& diagnostics);

/// The finite number in a field; nothing after an error at `place`.
std::optional<double> number_at(const output::CsvTable& table, std::size_t row, std::size_t column,
                                const std::filesystem::path& file, const language::Position& place,
                                language::Diagnostics& diagnostics);

/// One trace a case, by the text in the case's column; without such a column one, of the name "".
/// Nothing after errors, which say file, line and column. A sample of which a field is empty is
/// left out.
std::optional<std::map<std::string, MeasuredTrace>> read_traces(const TraceRequest& request,
                                                                language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
