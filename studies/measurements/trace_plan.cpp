#include "studies/measurements/trace_plan.h"

#include <fmt/ranges.h>

#include "output/files/hash.h"

namespace hookpoint::studies {

std::string trace_hash(const TracePlan& trace) {
  output::Hash hash;
  for (const std::string& part : trace.parts) hash.add(part);
  hash.add(fmt::format("{} {}", trace.unit_of_port, trace.weight));
  hash.add(fmt::format("{}", fmt::join(trace.measured.time, " ")));
  hash.add(fmt::format("{}", fmt::join(trace.measured.value, " ")));
  return hash.text();
}

}  // namespace hookpoint::studies
