#include "studies/measurements/sampled_port.h"

#include <algorithm>
#include <string>

#include "studies/measurements/trace_residual.h"

namespace hookpoint::studies {

SampledPort::SampledPort(const TracePlan& trace, const simulation::Experiment& experiment,
                         const std::vector<simulation::Port>& ports, double offset)
    : trace_(trace),
      offset_(offset),
      value_(trace.parts.size()),
      last_(trace.parts.size()),
      model_(trace.parts.size()),
      residuals_(trace.residuals()) {
  for (const std::string& part : trace.parts)
    parts_.push_back(simulation::find_port(experiment, ports, part).value);
}

void SampledPort::observe(double time, double step) {
  for (std::size_t i = 0; i < parts_.size(); ++i) value_[i] = *parts_[i] * trace_.unit_of_port;
  if (trace_.is_orientation()) stay_on_one_side();
  const std::vector<double>& times = trace_.measured.time;
  // Times are multiples of the step, rounded: a sample at a step is of that step.
  for (; next_ < times.size() && times[next_] - offset_ <= time + 1e-9 * step; ++next_) {
    const double sample = times[next_] - offset_;
    const double part = time > time_ ? std::min((sample - time_) / (time - time_), 1.) : 1.;
    for (std::size_t i = 0; i < value_.size(); ++i)
      model_[i] = last_[i] + part * (value_[i] - last_[i]);
    set_residuals(trace_, next_, model_, residuals_);
  }
  time_ = time;
  last_ = value_;
}

/// q and -q are one orientation, and an engine may go over from one to the other.
void SampledPort::stay_on_one_side() {
  double side = 0.;
  for (std::size_t i = 0; i < value_.size(); ++i) side += value_[i] * last_[i];
  if (side < 0.)
    for (double& part : value_) part = -part;
}

}  // namespace hookpoint::studies
