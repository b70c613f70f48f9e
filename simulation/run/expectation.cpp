#include "simulation/run/expectation.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "language/units.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

const std::vector<std::string>& reduction_names() {
  static const std::vector<std::string> names{
      "final",           "maximum",         "minimum",  "mean",        "rms",
      "range",           "change",          "slope",    "time_at",     "last",
      "time_of_maximum", "time_of_minimum", "integral", "settle_time", "count_above",
      "time_above",      "curvature"};
  return names;
}

std::optional<Reduction> find_reduction(std::string_view name) {
  const auto& names = reduction_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Reduction>(found - names.begin());
}

std::string missing_of(const ReductionSpec& spec) {
  const bool level = spec.take == Reduction::time_at || spec.take == Reduction::count_above ||
                     spec.take == Reduction::time_above;
  if (level && !spec.level)
    return "`" + reduction_names()[static_cast<std::size_t>(spec.take)] +
           "` needs the `level` that is meant";
  if (spec.take == Reduction::settle_time && !(spec.band.value_or(0.) > 0.))
    return "`settle_time` needs the `band` that counts as settled";
  return "";
}

language::Dimension dimension_of(Reduction take, const language::Dimension& quantity) {
  constexpr language::Dimension second{0, 0, 1, 0};
  switch (take) {
    case Reduction::slope:
      return quantity / second;
    case Reduction::curvature:
      return quantity / second / second;
    case Reduction::integral:
      return quantity * second;
    case Reduction::time_at:
    case Reduction::time_of_maximum:
    case Reduction::time_of_minimum:
    case Reduction::settle_time:
    case Reduction::time_above:
      return second;
    case Reduction::count_above:
      return {};
    default:
      return quantity;
  }
}

void SettleWatch::climb(Staircase& stairs, double time, double value) const {
  constexpr double stairs_of_a_band = 100.;
  if (!stairs.empty()) stairs.back().left = time;
  while (!stairs.empty() && stairs.back().value <= value) stairs.pop_back();
  const bool low =
      stairs.size() > 1 && stairs[stairs.size() - 2].value - value < band_ / stairs_of_a_band;
  if (low) stairs.pop_back();
  stairs.push_back({value, time});
}

void SettleWatch::observe(double time, double value) {
  if (greatest_.empty()) first_time_ = time;
  climb(greatest_, time, value);
  climb(least_, time, -value);
}

double SettleWatch::since(double end) const {
  double since = first_time_;
  const auto look = [&](const Staircase& stairs, double bound) {
    const auto low = std::ranges::partition_point(
        stairs, [bound](const Stair& stair) { return stair.value > bound; });
    if (low != stairs.begin()) since = std::max(since, std::prev(low)->left);
  };
  look(greatest_, end + band_);
  look(least_, band_ - end);
  return since;
}

void ParabolaFit::observe(double time, double value) {
  if (count_ == 0.) {
    first_time_ = time;
    first_ = value;
  }
  const double s = time - first_time_, v = value - first_;
  ++count_;
  power_[0] += s;
  power_[1] += s * s;
  power_[2] += s * s * s;
  power_[3] += s * s * s * s;
  value_ += v;
  product_ += s * v;
  square_product_ += s * s * v;
}

std::optional<double> ParabolaFit::curvature() const {
  if (count_ < 3.) return std::nullopt;
  const auto covariance = [this](double product, double one, double other) {
    return product / count_ - one / count_ * (other / count_);
  };
  // Of s and s^2, with each other and with the values.
  const double ss = covariance(power_[1], power_[0], power_[0]);
  const double sq = covariance(power_[2], power_[0], power_[1]);
  const double qq = covariance(power_[3], power_[1], power_[1]);
  const double sv = covariance(product_, power_[0], value_);
  const double qv = covariance(square_product_, power_[1], value_);
  const double determinant = ss * qq - sq * sq;
  if (!(determinant > 0.)) return std::nullopt;
  return 2. * (qv * ss - sv * sq) / determinant;
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

/// From the sample before to this one, along the straight line between them.
void Reducer::observe_interval(double time, double value) {
  const double step = time - last_time_;
  integral_ += 0.5 * step * (last_ + value);
  const double before = last_ - level_, now = value - level_;
  if (before <= 0. && now > 0.) ++rises_;
  if (before > 0. && now > 0.)
    above_ += step;
  else if (before > 0. || now > 0.)
    above_ += step * std::max(before, now) / std::abs(now - before);
}

void Reducer::observe_settling(double time, double value) {
  if (!about_level_) return settling_.observe(time, value);
  if (std::abs(value - level_) > band_)
    inside_since_.reset();
  else if (!inside_since_)
    inside_since_ = time;
}

void Reducer::observe(double time, double value) {
  if (time < from_ || (to_ && time > *to_)) return;
  find_crossing(time, value);
  if (take_ == Reduction::settle_time) observe_settling(time, value);
  if (take_ == Reduction::curvature) parabola_.observe(time, value);
  ++count_;
  if (count_ == 1) {
    first_time_ = greatest_time_ = least_time_ = time;
    first_ = least_ = greatest_ = value;
    if (value > level_) ++rises_;
  } else {
    observe_interval(time, value);
  }
  if (value < least_) least_time_ = time;
  if (value > greatest_) greatest_time_ = time;
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
    case Reduction::last:
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
    case Reduction::time_of_maximum:
      return greatest_time_;
    case Reduction::time_of_minimum:
      return least_time_;
    case Reduction::integral:
      return integral_;
    case Reduction::settle_time:
      return about_level_ ? inside_since_ : std::optional(settling_.since(last_));
    case Reduction::count_above:
      return static_cast<double>(rises_);
    case Reduction::time_above:
      return above_;
    case Reduction::curvature:
      return parabola_.curvature();
  }
  return std::nullopt;
}

std::optional<double> ExpectationResult::error() const {
  if (!measured) return std::nullopt;
  const double difference = std::abs(*measured - spec->expected);
  const bool relative = spec->tolerance > 0. && spec->expected != 0.;
  const double error = relative ? difference / std::abs(spec->expected) : difference;
  return std::isfinite(error) ? std::optional(error) : std::nullopt;
}

std::optional<double> ExpectationResult::decades() const {
  const double scale = spec->scale.value_or(std::abs(spec->expected));
  if (!measured || !(scale > 0.)) return std::nullopt;
  const double ratio = std::abs(*measured - spec->expected) / scale;
  if (!std::isfinite(ratio)) return std::nullopt;
  return ratio > 0. ? std::max(std::log10(ratio), least_decades) : least_decades;
}

bool ExpectationResult::ok() const {
  if (!measured) return false;
  return std::abs(*measured - spec->expected) <=
         std::max(spec->within, spec->tolerance * std::abs(spec->expected));
}

Expectations::Expectations(const Experiment& experiment, const std::vector<Port>& ports) {
  for (const ExpectationSpec& spec : experiment.expectations) {
    if (!spec.covers(experiment)) continue;
    watched_.push_back(
        {&spec, find_port(experiment, ports, spec.trail).value, Reducer(spec.reduction)});
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
