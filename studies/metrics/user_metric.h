// Metrics that a study's Measure blocks define by a formula of ports or by what was measured, and
// those that the Expects of its scene are. All are reduced to one number by simulation's Reducer,
// which also judges an Expect that is run alone.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "language/values/formula.h"
#include "simulation/experiment/experiment.h"
#include "simulation/wiring/ports.h"
#include "studies/measure/metric.h"
#include "studies/measurements/trace_plan.h"

namespace hookpoint::studies {

struct UserMetric {
  std::string name, doc;
  std::string unit;       ///< of its values
  double scale = 1.;      ///< SI of one of them
  std::size_t index = 0;  ///< among the metrics of its study that are the user's
  /// Of an Expect of the scene, which then says all that follows, run by run; else empty.
  std::string expectation;
  /// Of the distance from a Trace of the study's Cases, at its samples: its name; else empty.
  std::string trace;
  std::shared_ptr<const language::Formula> of;         ///< of ports, at every step; null of a trace
  std::vector<std::string> trails;                     ///< of its names, as a run knows them
  simulation::ReductionSpec reduction;                 ///< SI; times of the run
  std::shared_ptr<const language::Formula> predicted;  ///< of what the scene has; may be null
  /// Under what its values are kept: another definition of the name has another.
  std::string key;
  MetricDefinition definition;  ///< of the above

  double in_unit(double si) const { return si / scale; }
};

/// The key of an Expect of that name.
std::string expectation_key(const std::string& name);

/// Sets `key` and `definition` from the rest, which stays as it is and where it is.
void complete(UserMetric& metric);

/// What was measured in a run, by the names of the Traces.
using MeasuredTraces = std::map<std::string, std::shared_ptr<const TracePlan>>;

/// `metric` of the run of `context`, whose `ports` and `traces` live as long. A port that the run
/// has not leaves a Metric without a value that says so.
std::unique_ptr<Metric> make_user_metric(const UserMetric& metric, const RunContext& context,
                                         const std::vector<simulation::Port>& ports,
                                         const MeasuredTraces& traces);

/// The Expect of that name where it covers a run of `experiment`; else null.
const simulation::ExpectationSpec* expectation_of(const simulation::Experiment& experiment,
                                                  const std::string& name);

}  // namespace hookpoint::studies
