#include "studies/calibrate/model.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "simulation/run/world.h"

namespace hookpoint::studies {
namespace {

/// One trace's port, read at the times of its samples while the run goes by.
class SampledPort {
 public:
  SampledPort(const TracePlan& trace, const simulation::Port& port)
      : trace_(trace), value_(port.value) {
    residuals_.reserve(trace.measured.time.size());
  }

  /// Times are multiples of the step, rounded: a sample at a step is of that step.
  void observe(double time, double step) {
    const double value = *value_ * trace_.unit_of_port;
    const std::vector<double>& times = trace_.measured.time;
    for (; next_ < times.size() && times[next_] <= time + 1e-9 * step; ++next_) {
      const double part = time > time_ ? std::min((times[next_] - time_) / (time - time_), 1.) : 1.;
      const double model = last_ + part * (value - last_);
      residuals_.push_back(trace_.weight * (model - trace_.measured.value[next_]));
    }
    time_ = time;
    last_ = value;
  }
  bool complete() const { return next_ == trace_.measured.time.size(); }
  const Residuals& residuals() const { return residuals_; }

 private:
  const TracePlan& trace_;
  const double* value_;
  double time_ = 0., last_ = 0.;
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
    for (const TracePlan& trace : one.traces)
      sampled.emplace_back(trace, simulation::find_port(experiment, ports, trace.port));
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
