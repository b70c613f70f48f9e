#include "studies/calibrate/model.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "simulation/run/world.h"
#include "studies/calibrate/trace_residual.h"

namespace hookpoint::studies {
namespace {

/// One trace's port, read at the times of its samples while the run goes by.
class SampledPort {
 public:
  SampledPort(const TracePlan& trace, const simulation::Experiment& experiment,
              const std::vector<simulation::Port>& ports)
      : trace_(trace),
        value_(trace.parts.size()),
        last_(trace.parts.size()),
        model_(trace.parts.size()),
        residuals_(trace.residuals()) {
    for (const std::string& part : trace.parts)
      parts_.push_back(simulation::find_port(experiment, ports, part).value);
  }

  /// Times are multiples of the step, rounded: a sample at a step is of that step.
  void observe(double time, double step) {
    for (std::size_t i = 0; i < parts_.size(); ++i) value_[i] = *parts_[i] * trace_.unit_of_port;
    if (trace_.is_orientation()) stay_on_one_side();
    const std::vector<double>& times = trace_.measured.time;
    for (; next_ < times.size() && times[next_] <= time + 1e-9 * step; ++next_) {
      const double part = time > time_ ? std::min((times[next_] - time_) / (time - time_), 1.) : 1.;
      for (std::size_t i = 0; i < value_.size(); ++i)
        model_[i] = last_[i] + part * (value_[i] - last_[i]);
      set_residuals(trace_, next_, model_, residuals_);
    }
    time_ = time;
    last_ = value_;
  }
  bool complete() const { return next_ == trace_.measured.time.size(); }
  const Residuals& residuals() const { return residuals_; }

 private:
  /// q and -q are one orientation, and an engine may go over from one to the other.
  void stay_on_one_side() {
    double side = 0.;
    for (std::size_t i = 0; i < value_.size(); ++i) side += value_[i] * last_[i];
    if (side < 0.)
      for (double& part : value_) part = -part;
  }

  const TracePlan& trace_;
  std::vector<const double*> parts_;
  std::vector<double> value_, last_, model_;  ///< in SI, one a part
  double time_ = 0.;
  std::size_t next_ = 0;
  Residuals residuals_;
};

}  // namespace

std::vector<ConstantSetting> CalibrationModel::settings_at(const Shares& place) const {
  std::vector<ConstantSetting> settings;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const VariedConstant& constant = plan_.varied[subject_.constants[i]];
    settings.push_back(constant.setting(exact_value(constant, place[i])));
  }
  return settings;
}

std::optional<Residuals> CalibrationModel::residuals(std::span<const ConstantSetting> constants,
                                                     std::span<const std::size_t> cases,
                                                     std::string* why) const {
  Residuals all;
  std::string problem;
  for (const std::size_t one : cases) {
    if (add_case(constants, plan_.cases[one], all, problem)) continue;
    if (why != nullptr) *why = std::move(problem);
    return std::nullopt;
  }
  return all;
}

bool CalibrationModel::add_case(std::span<const ConstantSetting> constants,
                                const CalibrationCase& one, Residuals& residuals,
                                std::string& why) const {
  std::vector<ConstantSetting> settings(constants.begin(), constants.end());
  settings.insert(settings.end(), one.settings.begin(), one.settings.end());
  language::Diagnostics found;
  auto scene = subject_.scene->load(settings, 1, found);
  if (!scene) {
    why = first_error_of(found);
    return false;
  }
  simulation::Experiment& experiment = scene->experiment;
  experiment.duration = one.duration();
  try {
    simulation::World world(experiment, engines_.at(experiment.engine).make(experiment));
    const std::vector<simulation::Port> ports = world.ports();
    std::vector<SampledPort> sampled;
    for (const TracePlan& trace : one.traces) sampled.emplace_back(trace, experiment, ports);
    const auto observe = [&] {
      for (SampledPort& port : sampled) port.observe(world.state().time, experiment.deltat);
    };
    const auto complete = [&] {
      for (const SampledPort& port : sampled)
        if (!port.complete()) return false;
      return true;
    };
    for (observe(); !complete(); observe()) {
      if (stop_.load(std::memory_order_relaxed)) throw CalibrationInterrupted{};
      const std::int64_t before = world.state().step;
      const simulation::StepStatus status = world.step();
      if (status.ok() && world.state().step > before) continue;
      why = status.ok() ? "ended before the last sample: " + world.ended()
                        : fmt::format("stopped at {:.6g} s: {}", status.time, status.advice);
      return false;
    }
    for (const SampledPort& port : sampled)
      residuals.insert(residuals.end(), port.residuals().begin(), port.residuals().end());
    return true;
  } catch (const simulation::ExperimentError& error) {
    why = error.what();
    return false;
  }
}

}  // namespace hookpoint::studies
