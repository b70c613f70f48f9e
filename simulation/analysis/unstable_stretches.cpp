#include "simulation/analysis/unstable_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "simulation/analysis/joint_loops.h"
#include "simulation/analysis/stability.h"
#include "simulation/wiring/components.h"

namespace hookpoint::simulation {
namespace {

constexpr int intervals = 16, bisections = 7;

Experiment with_value(const Experiment& experiment, const ComponentValue& at, double value) {
  Experiment changed = experiment;
  changed.components[at.component].values.emplace_back(at.index, value);
  return changed;
}

/// Of each loop: proportional, derivative, integral gain, filter time.
std::vector<std::array<double, 4>> gains_of(const Experiment& experiment) {
  std::vector<std::array<double, 4>> gains;
  for (const JointLoop& loop : wired_control(experiment).loops)
    gains.push_back({loop.gains.proportional, loop.gains.derivative, loop.gains.integral,
                     loop.gains.filter_time});
  return gains;
}

bool is_unstable(const Experiment& experiment) {
  const StabilityBound bound = stability_bound(experiment);
  return experiment.deltat > bound.step && experiment.deltat <= bound.without_controllers;
}

}  // namespace

std::vector<Stretch> unstable_stretches(const Experiment& experiment, const MovedValue& moved,
                                        const std::atomic<bool>& stop) {
  const std::optional<ComponentValue> at = Components(experiment).find(moved.trail);
  const auto [least, greatest] = moved.range;
  if (!at || at->computed || !(least < greatest) || (moved.logarithmic && !(least > 0.))) return {};
  const auto with = [&](double value) { return with_value(experiment, *at, value); };
  if (gains_of(with(least)) == gains_of(with(greatest))) return {};

  const auto value_at = [&](double way) {
    if (way <= 0.) return least;
    if (way >= 1.) return greatest;
    return moved.logarithmic ? least * std::pow(greatest / least, way)
                             : least + way * (greatest - least);
  };
  /// Between two ways of which one alone is unstable.
  const auto crossing = [&](double below, double above, bool unstable_below) {
    for (int i = 0; i < bisections && !stop; ++i) {
      const double middle = 0.5 * (below + above);
      (is_unstable(with(value_at(middle))) == unstable_below ? below : above) = middle;
    }
    return value_at(unstable_below ? below : above);
  };

  std::vector<Stretch> stretches;
  bool before = false;
  for (int i = 0; i <= intervals && !stop; ++i) {
    const double way = static_cast<double>(i) / intervals;
    const bool unstable = is_unstable(with(value_at(way)));
    if (unstable && !before)
      stretches.push_back(
          {i == 0 ? least : crossing(way - 1. / intervals, way, false), value_at(way)});
    else if (unstable)
      stretches.back().greatest = value_at(way);
    else if (before)
      stretches.back().greatest = crossing(way - 1. / intervals, way, true);
    before = unstable;
  }
  return stretches;
}

}  // namespace hookpoint::simulation
