// Trace blocks: curves that were measured, each one's columns against the port that they are of.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/fields.h"
#include "studies/blocks/case_table.h"
#include "studies/measurements/trace_plan.h"

namespace hookpoint::studies {

/// A Trace block as its file has it.
struct TraceBlock {
  language::Placed<std::string> file;
  language::Placed<std::vector<std::string>> column;
  language::Placed<std::string> time, time_unit, unit, of;
  language::Placed<double> sample_rate, offset, weight;
  bool may_be_empty = false;
};

/// Traces of a Calibrate, which adds them up, each by its weight, and of Cases, which may be of a
/// Study.
void add_trace_classes(language::Schema& schema);
TraceBlock trace_block(const language::Object& block);

/// A port that something may have been measured of.
struct TracePort {
  std::string trail;  ///< as a run knows it
  std::string unit;   ///< "m"; "?" where its class leaves it open
};

/// What Trace blocks are read from.
struct TraceSource {
  /// The file that a field names; empty after an error.
  std::function<std::filesystem::path(const language::Placed<std::string>& name)> file;
  /// Nothing, with `why`, where the scene has no such port.
  std::function<std::optional<TracePort>(const std::string& trail, std::string& why)> port;
  language::Diagnostics& diagnostics;
};

/// How the parts of a port that is measured by so many columns are called behind its trail: "" of
/// one; .x .y .z of three; .w .x .y .z of four. Null for another number.
const std::vector<std::string>* trace_parts(std::size_t columns);

class TraceReader {
 public:
  /// `source` outlives it.
  explicit TraceReader(const TraceSource& source) : source_(source) {}

  /// By what the case's column calls each; without one ("") the single trace is called "". A trace
  /// whose block has no `weight` has 1. Times are the clock's less the block's `offset`; where that
  /// is fitted (a Vary), the clock's. Nothing after errors: no such file, column or port; columns
  /// of another dimension than the port; a weight that is not 1 over an error, or too large. Warns
  /// of a clock that begins late.
  std::optional<std::map<std::string, TracePlan>> read(const language::Object& block,
                                                       const std::string& case_column) const;

  /// The traces of each of `cases`, of a Cases block, in the order of its Trace blocks, by which
  /// they are called. Nothing after errors: as above, and a case that a table has no row of.
  std::optional<std::vector<std::vector<TracePlan>>> read_cases(
      const language::Object& block, const std::vector<CaseRow>& cases) const;

 private:
  bool find_ports(const TraceBlock& block, TracePlan& trace) const;
  bool units_agree(const TraceBlock& block, const language::Unit& measured, TracePlan& trace) const;
  bool weight_suits(const TraceBlock& block, const std::map<std::string, MeasuredTrace>& measured,
                    const TracePlan& trace) const;
  void report_late_clock(const TraceBlock& block, const std::string& name,
                         const std::map<std::string, MeasuredTrace>& measured) const;

  const TraceSource& source_;
};

}  // namespace hookpoint::studies
