#include "simulation/run/expectation.h"

#include <algorithm>
#include <cmath>

#include "simulation/engine.h"

namespace hookpoint::simulation {

const std::vector<std::string>& reduction_names() {
  static const std::vector<std::string> names{"final", "maximum", "minimum", "mean",   "rms",
                                              "range", "change",  "slope",   "time_at"};
  return names;
}

std::optional<Reduction> find_reduction(std::string_view name) {
  const auto& names = reduction_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Reduction>(found - names.begin());
}

bool ExpectationSpec::covers(std::string_view law, std::string_view integrator) const {
  const auto holds = [](const std::vector<std::string>& list, std::string_view word) {
    return std::ranges::find(list, word) != list.end();
  };
  return (laws.empty() || holds(laws, law)) && !holds(except_laws, law) &&
         (integrators.empty() || holds(integrators, integrator));
}

bool ExpectationSpec::covers(const Experiment& experiment) const {
  if (experiment.engine != "dts") return laws.empty() && integrators.empty();
  return covers(experiment.contact, experiment.integrator);
}

/// Where the straight line between two samples crosses the level.
void Reducer::find_crossing(double time, double value) {
  if (crossing_) return;
  if (value == level_) crossing_ = time;
  if (count_ == 0 || (last_ - level_) * (value - level_) >= 0.) return;
  crossing_ = last_time_ + (time - last_time_) * (level_ - last_) / (value - last_);
}

void Reducer::observe(double time, double value) {
  if (time < from_ || (to_ && time > *to_)) return;
  find_crossing(time, value);
  ++count_;
  if (count_ == 1) {
    first_time_ = time;
    first_ = least_ = greatest_ = value;
  }
  least_ = std::min(least_, value);
  greatest_ = std::max(greatest_, value);
  const double n = static_cast<double>(count_);
  const double time_step = time - mean_time_;
  mean_time_ += time_step / n;
  time_square_ += time_step * (time - mean_time_);
  product_ += time_step * (value - mean_) * (n - 1.) / n;
  mean_ += (value - mean_) / n;
  square_mean_ += (value * value - square_mean_) / n;
  last_time_ = time;
  last_ = value;
}

std::optional<double> Reducer::value() const {
  if (count_ == 0) return std::nullopt;
  switch (take_) {
    case Reduction::final:
      return last_;
    case Reduction::maximum:
      return greatest_;
    case Reduction::minimum:
      return least_;
    case Reduction::mean:
      return mean_;
    case Reduction::rms:
      return std::sqrt(square_mean_);
    case Reduction::range:
      return greatest_ - least_;
    case Reduction::change:
      return last_ - first_;
    case Reduction::slope:
      return time_square_ > 0. ? std::optional(product_ / time_square_) : std::nullopt;
    case Reduction::time_at:
      return crossing_;
  }
  return std::nullopt;
}

std::optional<double> ExpectationResult::error() const {
  if (!measured) return std::nullopt;
  const double difference = std::abs(*measured - spec->expected);
  const bool relative = spec->tolerance > 0. && spec->expected != 0.;
  return relative ? difference / std::abs(spec->expected) : difference;
}

bool ExpectationResult::ok() const {
  if (!measured) return false;
  return std::abs(*measured - spec->expected) <=
         std::max(spec->within, spec->tolerance * std::abs(spec->expected));
}

Expectations::Expectations(const Experiment& experiment, const std::vector<Port>& ports) {
  for (const ExpectationSpec& spec : experiment.expectations) {
    if (!spec.covers(experiment)) continue;
    watched_.push_back({&spec, find_port(experiment, ports, spec.trail).value, Reducer(spec)});
  }
}

void Expectations::observe(double time) {
  for (Watched& watched : watched_) watched.reducer.observe(time, *watched.value);
}

std::vector<ExpectationResult> Expectations::results() const {
  std::vector<ExpectationResult> results;
  for (const Watched& watched : watched_)
    results.push_back({watched.spec, watched.reducer.value()});
  return results;
}

}  // namespace hookpoint::simulation
