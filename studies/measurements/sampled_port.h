// A port of a run, held against what was measured of it while the run goes by.
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/experiment/experiment.h"
#include "simulation/wiring/ports.h"
#include "studies/measurements/trace_plan.h"

namespace hookpoint::studies {

class SampledPort {
 public:
  /// `trace` and what `ports` point to outlive it. `offset` [s]: what the trace's clock reads at
  /// time 0 of the run; samples before that are compared with the run's first state. Throws
  /// simulation::ExperimentError where the run has no such port.
  SampledPort(const TracePlan& trace, const simulation::Experiment& experiment,
              const std::vector<simulation::Port>& ports, double offset = 0.);

  /// Once at time 0 and once after every step of `step`, in seconds. Samples that lie at or before
  /// `time` are then held against the line that joins this step and the one before.
  void observe(double time, double step);
  /// How many samples have been reached; they are reached in order.
  std::size_t samples() const { return next_; }
  bool complete() const { return next_ == trace_.measured.time.size(); }
  /// Of the samples reached, as set_residuals lays them out; of the others 0.
  const std::vector<double>& residuals() const { return residuals_; }

 private:
  void stay_on_one_side();

  const TracePlan& trace_;
  double offset_;
  std::vector<const double*> parts_;
  std::vector<double> value_, last_, model_;  ///< in SI, one a part
  double time_ = 0.;
  std::size_t next_ = 0;
  std::vector<double> residuals_;
};

}  // namespace hookpoint::studies
