#include "studies/calibrate/model.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "simulation/run/world.h"
#include "studies/measurements/sampled_port.h"

namespace hookpoint::studies {
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
