#include "studies/measurements/trace_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hookpoint::studies {

using language::Object;

namespace {

std::string unit_words(const std::string& unit) { return unit.empty() ? "no unit" : unit; }

}  // namespace

const std::vector<std::string>* trace_parts(std::size_t columns) {
  static const std::map<std::size_t, std::vector<std::string>> parts{
      {1, {""}}, {3, {".x", ".y", ".z"}}, {4, {".w", ".x", ".y", ".z"}}};
  const auto found = parts.find(columns);
  return found == parts.end() ? nullptr : &found->second;
}

std::optional<std::map<std::string, TracePlan>> TraceReader::read(
    const Object& block, const std::string& case_column) const {
  TracePlan trace;
  trace.name = block.name;
  trace.file = source_.file(block, "file");
  const language::Field& column = *block.find("column");
  if (trace.file.empty() || !find_ports(block, column.words.size(), trace)) return std::nullopt;
  trace.column = column.words.front();
  TraceRequest request{
      trace.file,
      column.words,
      block.given("time") ? block.word("time") : "",
      case_column,
      block.find("file")->position,
      column.position,
      block.given("time") ? block.find("time")->position : block.find("file")->position};
  const bool fitted = !block.children_of("Vary").empty();
  if (block.given("offset") && !fitted) request.offset = block.number("offset");
  request.may_be_early = fitted;
  auto measured = read_traces(request, source_.diagnostics);
  if (!measured || !units_agree(block, measured->begin()->second.unit, trace)) return std::nullopt;
  trace.weight = block.given("weight") ? block.number("weight") : 1.;
  if (!(trace.weight > 0.)) {
    source_.diagnostics.error(block.find("weight")->position, "a weight is greater than 0");
    return std::nullopt;
  }
  if (!weight_suits(block, *measured, trace)) return std::nullopt;
  if (!block.given("offset") && !fitted) report_late_clock(block, *measured);
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
  for (const Object* trace : block.children_of("Trace")) {
    if (!trace->children_of("Fix").empty()) {
      source_.diagnostics.error(trace->position,
                                "what the cases of a table are set to stands in the table");
      good = false;
    }
    auto traces = read(*trace, block.word("case"));
    good = good && traces;
    for (std::size_t i = 0; traces && i < cases.size(); ++i) {
      const auto measured = traces->find(cases[i].name);
      if (measured == traces->end()) {
        source_.diagnostics.error(
            trace->find("file")->position,
            fmt::format("no row is of {} {}", block.word("case"), cases[i].name));
        good = false;
        break;
      }
      found[i].push_back(std::move(measured->second));
    }
  }
  return good ? std::optional(std::move(found)) : std::nullopt;
}

/// Squares of residuals, and their sums, must be numbers.
bool TraceReader::weight_suits(const Object& block,
                               const std::map<std::string, MeasuredTrace>& measured,
                               const TracePlan& trace) const {
  constexpr double greatest_residual = 1e100;
  double greatest = 1.;
  for (const auto& [name, one] : measured)
    for (const double value : one.value) greatest = std::max(greatest, std::abs(value));
  if (greatest * trace.weight <= greatest_residual) return true;
  source_.diagnostics.error(
      block.find(block.given("weight") ? "weight" : "column")->position,
      fmt::format("the weight {:.6g} times measured values up to {:.6g} (in SI) is too large to be "
                  "squared: a weight is 1 over the error of a sample",
                  trace.weight, greatest));
  return false;
}

/// A clock that begins much later than the scene does: by more than two intervals of its samples
/// and by a tenth of what it measures.
void TraceReader::report_late_clock(const Object& block,
                                    const std::map<std::string, MeasuredTrace>& measured) const {
  constexpr double intervals = 2., part = 0.1;
  for (const auto& [name, one] : measured) {
    const double first = one.time.front(), span = one.time.back() - first;
    const double interval = span / static_cast<double>(one.time.size() - 1);
    if (!(first > std::max(intervals * interval, part * span))) continue;
    source_.diagnostics.warning(
        block.find("file")->position,
        fmt::format(
            "the clock of {}{} begins at {:.6g} s, {:.6g} s before its last sample, and the "
            "scene at 0 s: if both begin together, say `offset = {:.6g} s;`, or fit it; "
            "`offset = 0 s;` if the scene is measured from {:.6g} s on",
            block.name, name.empty() ? "" : " " + name, first, span, first, first));
    return;
  }
}

/// One column is held against a port, three against a vector's parts, four against an
/// orientation's.
bool TraceReader::find_ports(const Object& block, std::size_t columns, TracePlan& trace) const {
  const std::vector<std::string>* suffixes = trace_parts(columns);
  if (suffixes == nullptr) {
    source_.diagnostics.error(
        block.find("column")->position,
        "a Trace has one column, the three of a vector, or the four of an orientation");
    return false;
  }
  for (const std::string& suffix : *suffixes) {
    std::string why;
    const auto port = source_.port(block.word("of") + suffix, why);
    if (!port) {
      source_.diagnostics.error(block.find("of")->position, why);
      return false;
    }
    trace.parts.push_back(port->trail);
    trace.port_unit = port->unit;
  }
  const std::string& first = trace.parts.front();
  trace.port = first.substr(0, first.size() - suffixes->front().size());
  return true;
}

bool TraceReader::units_agree(const Object& block, const language::Unit& measured,
                              TracePlan& trace) const {
  if (trace.port_unit == "?") trace.port_unit = language::unit_text(measured.dimension);
  const language::Unit port = language::parse_unit(trace.port_unit).value_or(language::Unit{});
  trace.unit_of_port = port.numerator / port.denominator;
  if (measured.dimension != port.dimension) {
    source_.diagnostics.error(
        block.find("column")->position,
        fmt::format("the column `{}` of {} is in {}, {} in {}", trace.column, trace.file.string(),
                    language::describe_dimension(measured.dimension), trace.port,
                    unit_words(trace.port_unit)));
    return false;
  }
  if (!block.given("weight")) return true;
  const language::Dimension radians{0, 0, 0, 1};
  const language::Dimension& of = trace.is_orientation() ? radians : port.dimension;
  const language::Dimension inverse{-of.mass, -of.length, -of.time, -of.angle};
  const language::Field& weight = *block.find("weight");
  if (language::fits(weight.dimension, inverse)) return true;
  source_.diagnostics.error(
      weight.position,
      fmt::format("a weight is 1 over what one takes for an error, so in {}, not {}",
                  language::describe_dimension(inverse),
                  language::describe_dimension(weight.dimension)));
  return false;
}

}  // namespace hookpoint::studies
