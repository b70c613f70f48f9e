#include "studies/blocks/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/blocks/block.h"

namespace hookpoint::studies {

using language::Object;

namespace {

/// A Calibrate needs the weight.
Fields<TraceBlock> trace_fields(bool weighted) {
  auto weight = number_field("weight", "?", &TraceBlock::weight,
                             "1 over what one takes for its error: 1 / (0.5 mm); of an "
                             "orientation 1 / (1 deg); a Calibrate needs it");
  return {
      required(text_field("file", &TraceBlock::file,
                          "the table: text of columns, with titles like `z [m]`")),
      required(
          words_field("column", 4, &TraceBlock::column,
                      "title of what was measured, \"z [m]\"; the three of a vector, or the four, "
                      "w, x, y, z, of an orientation")),
      text_field(
          "time", &TraceBlock::time,
          "title, name or number of the column of times; default: the first, unless it counts "
          "frames"),
      text_field("time_unit", &TraceBlock::time_unit,
                 "of the times, \"ms\"; default: as the table says"),
      text_field("unit", &TraceBlock::unit, "of the columns, \"mm\"; default: as the table says"),
      positive(number_field("sample_rate", "Hz", &TraceBlock::sample_rate,
                            "rows are this often, for tables without times")),
      required(words_field("of", 1, &TraceBlock::of,
                           "trail of the port that was measured; of a vector or an orientation "
                           "without its parts")),
      number_field("offset", "s", &TraceBlock::offset,
                   "what the clock of the times reads at time 0 of the scene; default: 0, and a "
                   "warning where the clock begins late. `Vary offset` of a Calibrate's Trace "
                   "fits it"),
      weighted ? required(std::move(weight)) : std::move(weight),
      may_be_empty_field(
          &TraceBlock::may_be_empty,
          "none of a Calibrate's constants changes it, where all its Traces say so")};
}

std::string unit_words(const std::string& unit) { return unit.empty() ? "no unit" : unit; }

}  // namespace

void add_trace_classes(language::Schema& schema) {
  for (const char* within : {"Calibrate", "Cases"}) {
    const bool weighted = within == std::string_view("Calibrate");
    language::ClassSchema trace = block_class(
        "Trace", "A curve that was measured: columns of a table over time.",
        schemas(trace_fields(weighted)),
        weighted ? std::vector<std::string>{"Fix", "Vary"} : std::vector<std::string>{"Fix"});
    trace.only_in = within;
    schema.add(std::move(trace));
  }
}

TraceBlock trace_block(const Object& block) {
  static const Fields<TraceBlock> fields = trace_fields(false);
  return load_fields(block, fields);
}

const std::vector<std::string>* trace_parts(std::size_t columns) {
  static const std::map<std::size_t, std::vector<std::string>> parts{
      {1, {""}}, {3, {".x", ".y", ".z"}}, {4, {".w", ".x", ".y", ".z"}}};
  const auto found = parts.find(columns);
  return found == parts.end() ? nullptr : &found->second;
}

std::optional<std::map<std::string, TracePlan>> TraceReader::read(
    const Object& object, const std::string& case_column) const {
  const TraceBlock block = trace_block(object);
  TracePlan trace;
  trace.name = object.name;
  trace.file = source_.file(block.file);
  if (trace.file.empty() || !find_ports(block, trace)) return std::nullopt;
  trace.column = block.column->front();
  TraceRequest request{trace.file,
                       *block.column,
                       block.time ? *block.time : "",
                       case_column,
                       block.file.position(),
                       block.column.position(),
                       block.time.position_or(block.file.position())};
  const bool fitted = !object.children_of("Vary").empty();
  // A clock that is fitted reads what it reads.
  if (block.offset || fitted) request.offset = fitted ? 0. : *block.offset;
  request.unit = block.unit ? *block.unit : "";
  request.time_unit = block.time_unit ? *block.time_unit : "";
  request.sample_rate = block.sample_rate ? *block.sample_rate : 0.;
  request.may_be_early = fitted;
  auto measured = read_traces(request, source_.diagnostics);
  if (!measured || !units_agree(block, measured->begin()->second.unit, trace)) return std::nullopt;
  trace.weight = block.weight.value.value_or(1.);
  trace.may_be_empty = block.may_be_empty;
  if (!(trace.weight > 0.)) {
    source_.diagnostics.error(block.weight.position(), "a weight is greater than 0");
    return std::nullopt;
  }
  if (!weight_suits(block, *measured, trace)) return std::nullopt;
  if (!block.offset && !fitted) report_late_clock(block, object.name, *measured);
  std::map<std::string, TracePlan> traces;
  for (auto& [name, one] : *measured) {
    traces[name] = trace;
    traces[name].measured = std::move(one);
  }
  return traces;
}

std::optional<std::vector<std::vector<TracePlan>>> TraceReader::read_cases(
    const Object& block, const std::vector<CaseRow>& cases) const {
  std::vector<std::vector<TracePlan>> found(cases.size());
  bool good = true;
  const std::string case_column = *cases_block(block).case_column;
  for (const Object* trace : block.children_of("Trace")) {
    if (!trace->children_of("Fix").empty()) {
      source_.diagnostics.error(trace->position,
                                "what the cases of a table are set to stands in the table");
      good = false;
    }
    auto traces = read(*trace, case_column);
    good = good && traces;
    for (std::size_t i = 0; traces && i < cases.size(); ++i) {
      const auto measured = traces->find(cases[i].name);
      if (measured == traces->end()) {
        source_.diagnostics.error(trace_block(*trace).file.position(),
                                  fmt::format("no row is of {} {}", case_column, cases[i].name));
        good = false;
        break;
      }
      found[i].push_back(std::move(measured->second));
    }
  }
  return good ? std::optional(std::move(found)) : std::nullopt;
}

/// Squares of residuals, and their sums, must be numbers.
bool TraceReader::weight_suits(const TraceBlock& block,
                               const std::map<std::string, MeasuredTrace>& measured,
                               const TracePlan& trace) const {
  constexpr double greatest_residual = 1e100;
  double greatest = 1.;
  for (const auto& [name, one] : measured)
    for (const double value : one.value) greatest = std::max(greatest, std::abs(value));
  if (greatest * trace.weight <= greatest_residual) return true;
  source_.diagnostics.error(
      block.weight.position_or(block.column.position()),
      fmt::format("the weight {:.6g} times measured values up to {:.6g} (in SI) is too large to be "
                  "squared: a weight is 1 over the error of a sample",
                  trace.weight, greatest));
  return false;
}

/// A clock that begins much later than the scene does: by more than two intervals of its samples
/// and by a tenth of what it measures.
void TraceReader::report_late_clock(const TraceBlock& block, const std::string& of_trace,
                                    const std::map<std::string, MeasuredTrace>& measured) const {
  constexpr double intervals = 2., part = 0.1;
  for (const auto& [name, one] : measured) {
    const double first = one.time.front(), span = one.time.back() - first;
    const double interval = span / static_cast<double>(one.time.size() - 1);
    if (!(first > std::max(intervals * interval, part * span))) continue;
    source_.diagnostics.warning(
        block.file.position(),
        fmt::format(
            "the clock of {}{} begins at {:.6g} s, {:.6g} s before its last sample, and the "
            "scene at 0 s: if both begin together, say `offset = {:.6g} s;`, or fit it; "
            "`offset = 0 s;` if the scene is measured from {:.6g} s on",
            of_trace, name.empty() ? "" : " " + name, first, span, first, first));
    return;
  }
}

/// One column is held against a port, three against a vector's parts, four against an
/// orientation's.
bool TraceReader::find_ports(const TraceBlock& block, TracePlan& trace) const {
  const std::vector<std::string>* suffixes = trace_parts(block.column->size());
  if (suffixes == nullptr) {
    source_.diagnostics.error(
        block.column.position(),
        "a Trace has one column, the three of a vector, or the four of an orientation");
    return false;
  }
  for (const std::string& suffix : *suffixes) {
    std::string why;
    const auto port = source_.port(*block.of + suffix, why);
    if (!port) {
      source_.diagnostics.error(block.of.position(), why);
      return false;
    }
    trace.parts.push_back(port->trail);
    trace.port_unit = port->unit;
  }
  const std::string& first = trace.parts.front();
  trace.port = first.substr(0, first.size() - suffixes->front().size());
  return true;
}

bool TraceReader::units_agree(const TraceBlock& block, const language::Unit& measured,
                              TracePlan& trace) const {
  if (trace.port_unit == "?") trace.port_unit = language::unit_text(measured.dimension);
  const language::Unit port = language::parse_unit(trace.port_unit).value_or(language::Unit{});
  trace.unit_of_port = port.numerator / port.denominator;
  if (measured.dimension != port.dimension) {
    source_.diagnostics.error(
        block.column.position(),
        fmt::format("the column `{}` of {} is in {}, {} in {}", trace.column, trace.file.string(),
                    language::describe_dimension(measured.dimension), trace.port,
                    unit_words(trace.port_unit)));
    return false;
  }
  if (!block.weight) return true;
  const language::Dimension radians{0, 0, 0, 1};
  const language::Dimension& of = trace.is_orientation() ? radians : port.dimension;
  const language::Dimension inverse{-of.mass, -of.length, -of.time, -of.angle};
  const language::Field& weight = *block.weight.field;
  if (language::fits(weight.dimension, inverse)) return true;
  source_.diagnostics.error(
      weight.position,
      fmt::format("a weight is 1 over what one takes for an error, so in {}, not {}",
                  language::describe_dimension(inverse),
                  language::describe_dimension(weight.dimension)));
  return false;
}

}  // namespace hookpoint::studies
