#include "studies/calibrate/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "simulation/run/loop.h"
#include "simulation/run/world.h"
#include "studies/measurements/sampled_port.h"

namespace hookpoint::studies {
namespace {

/// Squares of residuals below this, and sums of them, are numbers.
constexpr double largest_residual_to_square = 1e150;

}  // namespace

std::vector<ConstantSetting> CalibrationModel::settings_at(const UnitPoint& point) const {
  std::vector<ConstantSetting> settings;
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (plan_.offset_of(subject_.constants[i]) != nullptr) continue;
    const VariedConstant& constant = plan_.varied[subject_.constants[i]];
    settings.push_back(constant.setting(exact_value(constant, point[i])));
  }
  return settings;
}

double CalibrationModel::offset_at(const UnitPoint& point, const TracePlan& trace) const {
  for (const FittedOffset& offset : plan_.offsets) {
    if (offset.trace != trace.name) continue;
    const VariedConstant& constant = plan_.varied[offset.constant];
    const auto found = std::ranges::find(subject_.constants, offset.constant);
    const auto index = static_cast<std::size_t>(found - subject_.constants.begin());
    return constant.unit.to_si(index < point.size() ? exact_value(constant, point[index])
                                                    : *plan_.own[offset.constant]);
  }
  return 0.;
}

std::optional<Residuals> CalibrationModel::residuals(const UnitPoint& point,
                                                     std::span<const std::size_t> cases,
                                                     std::string* why) const {
  Residuals all;
  std::string problem;
  for (const std::size_t one : cases) {
    if (add_case(point, plan_.cases[one], all, problem)) continue;
    if (why != nullptr) *why = std::move(problem);
    return std::nullopt;
  }
  return all;
}

bool CalibrationModel::add_case(const UnitPoint& point, const CalibrationCase& one,
                                Residuals& residuals, std::string& why) const {
  std::vector<ConstantSetting> settings = settings_at(point);
  settings.insert(settings.end(), one.settings.begin(), one.settings.end());
  language::Diagnostics found;
  auto scene = subject_.scene->load(settings, 1, found);
  if (!scene) {
    why = found.first_error();
    return false;
  }
  simulation::Experiment& experiment = scene->experiment;
  std::vector<double> offsets;
  experiment.duration = 0.;
  for (const TracePlan& trace : one.traces) {
    offsets.push_back(offset_at(point, trace));
    experiment.duration =
        std::max(experiment.duration, trace.measured.time.back() - offsets.back());
  }
  try {
    simulation::World world(experiment, engines_.at(experiment.engine).make(experiment));
    const std::vector<simulation::Port> ports = world.ports();
    std::vector<SampledPort> sampled;
    for (std::size_t i = 0; i < one.traces.size(); ++i)
      sampled.emplace_back(one.traces[i], experiment, ports, offsets[i]);
    const auto observe = [&] {
      for (SampledPort& port : sampled) port.observe(world.state().time, experiment.deltat);
    };
    const auto complete = [&] {
      for (const SampledPort& port : sampled)
        if (!port.complete()) return false;
      return true;
    };
    observe();
    const simulation::RunEnd end = simulation::run_until(
        world, std::numeric_limits<std::int64_t>::max(),
        [&] { return !complete() && !stop_.load(std::memory_order_relaxed); }, observe);
    if (!complete()) {
      if (end.interrupted()) throw CalibrationInterrupted{};
      why = end.failed() ? "stopped " + simulation::failure_text(end.status)
                         : "ended before the last sample: " + end.why;
      return false;
    }
    for (std::size_t i = 0; i < sampled.size(); ++i) {
      const std::vector<double>& of_trace = sampled[i].residuals();
      if (std::ranges::any_of(of_trace, [](double residual) {
            return !(std::abs(residual) < largest_residual_to_square);
          })) {
        why = fmt::format("the residuals of {} are too large to be squared", one.traces[i].name);
        return false;
      }
      residuals.insert(residuals.end(), of_trace.begin(), of_trace.end());
    }
    return true;
  } catch (const simulation::ExperimentError& error) {
    why = error.what();
    return false;
  }
}

}  // namespace hookpoint::studies
