// A measured curve as its file has it: one column over time of a table like those that a run
// leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/units.h"

namespace hookpoint::studies {

/// What is asked of a file; where each was asked for.
struct TraceRequest {
  std::filesystem::path file;
  std::string column;  ///< "z [m]", or the name alone where one column has it
  std::string time;    ///< the same; "": the first column
  language::Position file_place, column_place, time_place;
};

/// Samples in SI, in order of time; all finite.
struct MeasuredTrace {
  std::vector<double> time;   ///< [s], rising, not before 0
  std::vector<double> value;  ///< in SI
  language::Unit unit;        ///< that the column is written in
};

/// Nothing after errors, which say file, line and column. A sample whose field is empty is left
/// out.
std::optional<MeasuredTrace> read_trace(const TraceRequest& request,
                                        language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
