#include "control/core/transmission_line.h"

#include <stdexcept>

namespace hookpoint::control {
namespace {

__extension__ using Wide = __int128;

constexpr std::int64_t most_under_way = 10'000'000;
/// Steps; the arrival of what a run sends at its last step can still be counted.
constexpr std::int64_t longest_delay = std::int64_t{1} << 53;

/// Samples that can be under way at once: those of delay + 1 successive steps.
std::size_t ring_size(std::int64_t delay, std::int64_t shortest_interval) {
  const std::int64_t samples = delay / shortest_interval + 1;
  if (samples > most_under_way) {
    throw std::invalid_argument(
        "more than ten million samples would be under way: shorten the delay or lower the rate");
  }
  return static_cast<std::size_t>(samples);
}

std::int64_t delay_steps(const Rational& delay, const Rational& dt) {
  if (delay < Rational(0)) throw std::invalid_argument("a delay must not be negative");
  const std::int64_t steps = (delay / dt).ceiling();
  if (steps > longest_delay)
    throw std::invalid_argument("the delay is longer than a run can last: shorten it");
  return steps;
}

}  // namespace

Schedule::Schedule(const std::optional<Rational>& rate, const Rational& dt) : period_(dt.value()) {
  if (dt <= Rational(0)) throw std::invalid_argument("a step must be longer than zero");
  if (!rate) return;
  if (*rate <= Rational(0)) throw std::invalid_argument("a rate must be greater than zero");
  const Rational steps = Rational(1) / (*rate * dt);
  if (steps <= Rational(1)) return;
  whole_ = steps.numerator() / steps.denominator();
  part_ = steps.numerator() % steps.denominator();
  denominator_ = steps.denominator();
  period_ = (Rational(1) / *rate).value();
}

void Schedule::resume(std::int64_t count) {
  next_ = step_of(count);
  count_ = count;
  early_ =
      static_cast<std::int64_t>(Wide{next_ - count * whole_} * denominator_ - Wide{part_} * count);
}

std::int64_t Schedule::step_of(std::int64_t n) const {
  return n * whole_ +
         static_cast<std::int64_t>((Wide{part_} * n + denominator_ - 1) / denominator_);
}

TransmissionLine::TransmissionLine(const LineDescription& description, const Rational& dt)
    : schedule_(description.rate, dt),
      stream_(description.stream_seed),
      noise_(description.noise),
      delay_(delay_steps(description.delay, dt)),
      output_(description.initial),
      mean_(description.mean && !schedule_.every_step()),
      ring_(ring_size(delay_, schedule_.shortest_interval())) {
  if (!(noise_ >= 0.)) throw std::invalid_argument("noise must not be negative");
}

void TransmissionLine::take(std::int64_t step, double source_value) {
  const double noise = noise_ > 0. ? noise_ * stream_.gaussian(schedule_.count() - 1) : 0.;
  if (mean_) {
    source_value = sum_ / static_cast<double>(summed_);
    sum_ = 0.;
    summed_ = 0;
  }
  const double value = source_value + noise;
  if (delay_ == 0) {
    output_ = value;
    return;
  }
  const std::size_t behind = first_ + under_way_;
  ring_[behind < ring_.size() ? behind : behind - ring_.size()] = {step + delay_, value};
  ++under_way_;
}

void TransmissionLine::arrive() {
  output_ = ring_[first_].value;
  if (++first_ == ring_.size()) first_ = 0;
  --under_way_;
}

std::string TransmissionLine::state_layout() const {
  if (passes()) return "";
  return "samples output under_way value[" + std::to_string(ring_.size()) + "]" +
         (mean_ ? " sum summed" : "");
}

void TransmissionLine::save(std::span<double> state) const {
  if (passes()) return;
  state[0] = static_cast<double>(schedule_.count());
  state[1] = output_;
  state[2] = static_cast<double>(under_way_);
  for (std::size_t i = 0; i < ring_.size(); ++i) state[3 + i] = ring_[i].value;
  if (!mean_) return;
  state[3 + ring_.size()] = sum_;
  state[4 + ring_.size()] = static_cast<double>(summed_);
}

void TransmissionLine::restore(std::int64_t step, std::span<const double> state) {
  if (passes()) return schedule_.resume(step + 1);
  schedule_.resume(static_cast<std::int64_t>(state[0]));
  output_ = state[1];
  under_way_ = static_cast<std::size_t>(state[2]);
  const std::int64_t oldest = schedule_.count() - static_cast<std::int64_t>(under_way_);
  const auto size = static_cast<std::int64_t>(ring_.size());
  first_ = static_cast<std::size_t>(oldest % size);
  for (std::size_t i = 0; i < ring_.size(); ++i) ring_[i].value = state[3 + i];
  if (mean_) {
    sum_ = state[3 + ring_.size()];
    summed_ = static_cast<std::int64_t>(state[4 + ring_.size()]);
  }
  for (std::int64_t n = oldest; n < schedule_.count(); ++n)
    ring_[static_cast<std::size_t>(n % size)].arrival = schedule_.step_of(n) + delay_;
}

}  // namespace hookpoint::control
