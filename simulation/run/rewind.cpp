#include "simulation/run/rewind.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <sstream>

#include "simulation/engine_interface/step_count.h"
#include "simulation/run/loop.h"
#include "simulation/run/movies.h"
#include "simulation/wiring/measured_section.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

/// A time [s] with the digits that tell the steps of a long run apart.
std::string moment_text(double time) {
  constexpr int digits = 9;
  return text::rounded(time, digits);
}

using output::MovieError;

/// What stands in the one text first and not in the other.
std::string first_difference(const std::string& movie, const std::string& here) {
  std::istringstream ours(here), theirs(movie);
  for (std::string a, b;;) {
    const bool more_ours = static_cast<bool>(std::getline(ours, a));
    const bool more_theirs = static_cast<bool>(std::getline(theirs, b));
    if (!more_ours && !more_theirs) return "nothing";
    if (!more_theirs) return fmt::format("the movie lacks `{}`", a);
    if (!more_ours) return fmt::format("here is no `{}`", b);
    if (a != b) return fmt::format("the movie has `{}`, here is `{}`", b, a);
  }
}

std::string version_of(const output::MovieHeader& header) {
  for (const auto& [key, value] : header.annotations) {
    if (key == "hookpoint") return value;
  }
  return "?";
}

}  // namespace

Rewind::Rewind(const Experiment& experiment, const output::MovieReader& movie, World& world)
    : experiment_(experiment), movie_(movie), world_(world), sections_(world.instant_layout()) {
  const std::string here = layout_text(sections_);
  if (movie.header().layout != here || movie.header().size != world.instant_size())
    throw MovieError(fmt::format(
        "the movie's numbers are not those of this program (hookpoint {}; the movie is of {}): {}",
        HOOKPOINT_VERSION, version_of(movie.header()),
        first_difference(movie.header().layout, here)));
  if (movie.times().empty()) throw MovieError("the movie has no instant");
  for (const double time : movie.times()) {
    if (!step_count_problem(time, experiment.deltat).empty())
      throw MovieError(
          fmt::format("the movie is damaged: no run with steps of {} s reaches its time {} s",
                      text::rounded(experiment.deltat), text::rounded(time)));
    steps_.push_back(step_count(time, experiment.deltat));
  }
  recorded_.resize(movie.header().size);
  computed_.resize(movie.header().size);
}

std::int64_t Rewind::first() const { return steps_.front() == 0 ? 0 : steps_.front() + 1; }

std::string Rewind::time_text(std::int64_t step) const {
  return moment_text(static_cast<double>(step) * experiment_.deltat);
}

std::int64_t Rewind::step_at(double time) const {
  constexpr double tolerance = 1e-6;  // of a step: what rounding leaves of a decimal number
  const double steps = time / experiment_.deltat;
  if (!(steps > static_cast<double>(first()) - 0.5 && steps < static_cast<double>(last()) + 0.5))
    throw MovieError(fmt::format("there is no moment {} s in the movie: it goes from {} s to {} s",
                                 moment_text(time), time_text(first()), time_text(last())));
  const auto step = static_cast<std::int64_t>(std::llround(steps));
  if (std::abs(steps - static_cast<double>(step)) > tolerance)
    throw MovieError(
        fmt::format("there is no step at {} s: steps are {} s long, the nearest is at "
                    "{} s",
                    moment_text(time), text::rounded(experiment_.deltat, 6), time_text(step)));
  return step;
}

void Rewind::approach(std::int64_t step) {
  const auto at = std::ranges::lower_bound(steps_, step);
  const auto after = static_cast<std::size_t>(at - steps_.begin());
  if (after == 0) return compare(0);
  put(after - 1);
  run_to(steps_[after]);
  compare(after);
  put(after - 1);
}

void Rewind::arrive(std::int64_t step) { run_to(step); }

void Rewind::turn_to(std::int64_t step) {
  const std::size_t before = instant_before(step);
  const std::int64_t present = world_.state().step;
  const bool there = present == step && whole_;
  const bool on_the_way = present < step && present >= steps_[before];
  if (!there && !on_the_way) put(before);
  next_ = static_cast<std::size_t>(std::ranges::upper_bound(steps_, world_.state().step) -
                                   steps_.begin());
}

std::string Rewind::go_on() {
  run_to(world_.state().step + 1);
  if (next_ == steps_.size() || world_.state().step < steps_[next_]) return "";
  std::string differs = difference(next_);
  const bool restores = world_.can_be_saved();
  if (!differs.empty() && restores) world_.restore(recorded_);
  // What somebody changed between two steps: the same step again, as it was left.
  for (; next_ + 1 < steps_.size() && steps_[next_ + 1] == steps_[next_]; ++next_)
    if (restores) {
      movie_.read(next_ + 1, recorded_);
      world_.restore(recorded_);
    }
  ++next_;
  return differs;
}

std::size_t Rewind::instant_before(std::int64_t step) const {
  const auto after = std::ranges::lower_bound(steps_, step) - steps_.begin();
  return after == 0 ? 0 : static_cast<std::size_t>(after - 1);
}

void Rewind::put(std::size_t instant) {
  if (!world_.can_be_saved()) return run_again(steps_[instant]);
  movie_.read(instant, recorded_);
  world_.restore(recorded_);
  whole_ = false;
}

/// What an engine's library remembers leads to a moment from the start alone.
void Rewind::run_again(std::int64_t step) {
  if (world_.state().step > step) {
    world_.restart(experiment_);
    whole_ = false;
  }
  run_to(step);
}

void Rewind::run_to(std::int64_t step) {
  const RunEnd end = run_until(
      world_, step, [this] { return stop_ == nullptr || !*stop_; }, [this] { whole_ = true; });
  if (end.complete()) return;
  const std::string time = time_text(world_.state().step);
  throw MovieError(end.interrupted()
                       ? "interrupted at " + time + " s"
                       : "the run cannot be repeated: no step leads on from " + time + " s");
}

void Rewind::compare(std::size_t instant) {
  if (const std::string differs = difference(instant); !differs.empty()) throw MovieError(differs);
}

/// Bits, not values: -0 is not 0, and what is not a number equals itself.
std::string Rewind::difference(std::size_t instant) {
  movie_.read(instant, recorded_);
  world_.save_instant(computed_);
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  std::size_t first = 0, index = 0;
  auto section = sections_.begin();
  for (; section != sections_.end(); first += section->size, ++section) {
    const auto recorded = std::span(recorded_).subspan(first, section->size);
    const auto computed = std::span(computed_).subspan(first, section->size);
    const bool unmeasured =
        section->name == measured_section && (recorded.front() == 0. || computed.front() == 0.);
    const auto differs = std::ranges::mismatch(recorded, computed, same).in1;
    index = static_cast<std::size_t>(differs - recorded.begin());
    if (!unmeasured && differs != recorded.end()) break;
  }
  if (section == sections_.end()) return "";
  return fmt::format(
      "the run does not repeat: at {} s number {} of `{}` is {} in the movie and {} here. The "
      "movie is of hookpoint {}, this is {}; another build, another machine or a changed plugin "
      "computes other last digits, and a field that was edited while it ran (changes.csv) is not "
      "in "
      "the movie: --changes repeats such a run",
      time_text(steps_[instant]), index, section->name,
      text::seventeen_digits(recorded_[first + index]),
      text::seventeen_digits(computed_[first + index]), version_of(movie_.header()),
      HOOKPOINT_VERSION);
}

}  // namespace hookpoint::simulation
