#include "simulation/analysis/automatic_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "simulation/analysis/stability.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Of controllers, wires, records and movies [Hz].
std::vector<double> rates_of(const Experiment& experiment) {
  std::vector<double> rates;
  const auto add = [&](const auto& parts) {
    for (const auto& part : parts) {
      if (part.rate) rates.push_back(*part.rate);
    }
  };
  add(experiment.components);
  add(experiment.wires);
  add(experiment.records);
  add(experiment.movies);
  return rates;
}

/// At least the greatest angular velocity of a body at time 0: the base's and the rates of the
/// joints that carry a body, added [rad/s].
double greatest_angular_speed(const Experiment& experiment) {
  double fastest = 0.;
  for (const RobotSpec& robot : experiment.robots) {
    std::vector<double> speeds{robot.mobile ? norm(robot.angular_velocity) : 0.};
    for_each_link(robot, [&](const TreeLink& at) {
      const bool turns_link = at.link.joint == JointKind::revolute;
      speeds.push_back(speeds[at.parent] + (turns_link ? std::abs(at.link.rate) : 0.));
    });
    fastest = std::max(fastest, std::ranges::max(speeds));
  }
  return fastest;
}

bool divides(double step, const std::vector<double>& rates) {
  return std::ranges::all_of(rates, [&](double rate) {
    const double steps = 1. / (rate * step);
    return steps > 0.5 && std::abs(steps - std::round(steps)) < 1e-9 * steps;
  });
}

/// The `n`-th of 1, 2, 5, 10, 20 ... [s]; exact as a decimal fraction reads.
double round_step(int n) {
  constexpr const char* digits[] = {"1", "2", "5"};
  const int decade = n >= 0 ? n / 3 : -((2 - n) / 3);
  const std::string text = fmt::format("{}e{}", digits[n - 3 * decade], decade);
  double step = 0.;
  std::from_chars(text.data(), text.data() + text.size(), step);
  return step;
}

bool is_adaptive(const Experiment& experiment) {
  const integrators::StepperDescription* stepper = integrators::find_stepper(experiment.integrator);
  return stepper != nullptr && stepper->adaptive();
}

/// Largest stable step under engine dts [s].
double bound_under_dts(const Experiment& experiment) {
  if (is_adaptive(experiment)) return HUGE_VAL;
  if (experiment.engine == Experiment{}.engine) return stability_bound(experiment).step;
  Experiment ours = experiment;
  ours.engine = Experiment{}.engine;
  return stability_bound(ours).step;
}

}  // namespace

ChosenStep choose_step(const Experiment& experiment) {
  const double bound = bound_under_dts(experiment);
  double limit = largest_automatic_step;
  if (bound > 0.) limit = std::min(limit, safe_part * bound);
  if (!is_adaptive(experiment))
    limit = std::min(limit, largest_turn / greatest_angular_speed(experiment));
  const std::vector<double> rates = rates_of(experiment);
  int largest = static_cast<int>(std::ceil(3. * std::log10(limit))) + 3;
  while (round_step(largest) > limit) --largest;
  constexpr int tries = 6;  // two decades
  for (int n = largest; n > largest - tries; --n) {
    if (divides(round_step(n), rates)) return {round_step(n), bound};
  }
  return {round_step(largest), bound};
}

}  // namespace hookpoint::simulation
