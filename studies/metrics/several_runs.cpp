// Metrics of which no run has a value by itself: of subjects at equal swept values, and of
// processor time, for which a run is made again alone.
#include <array>
#include <optional>
#include <span>

#include "studies/metrics/table.h"

namespace hookpoint::studies {
namespace {

std::optional<double> realtime_factor(double step_time, double deltat) {
  return step_time > 0. ? std::optional(deltat / step_time) : std::nullopt;
}
std::optional<double> time_of_a_step(double step_time, double) { return step_time; }

}  // namespace

std::span<const MetricDefinition> several_runs_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "peer_distance",
       .unit = "m",
       .doc =
           "greatest distance of the body's origin from that of another subject at equal swept values, median of the others; the matrix of all is in peer_distance.csv and in the report",
       .scope = MetricScope::subjects},
      {.name = "realtime_factor",
       .unit = "",
       .doc = "simulated time over processor time, median of five stretches, run alone",
       .scope = MetricScope::timing,
       .of_step_time = realtime_factor},
      {.name = "step_time",
       .unit = "s",
       .doc = "processor time of a step, median of five stretches, run alone",
       .scope = MetricScope::timing,
       .of_step_time = time_of_a_step},
  });
  return rows;
}

}  // namespace hookpoint::studies
