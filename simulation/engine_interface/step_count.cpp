#include "simulation/engine_interface/step_count.h"

#include <fmt/format.h>

#include <cmath>

#include "simulation/engine_interface/engine.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

/// At a million steps a second, which few scenes reach, more than a day.
constexpr double long_run = 1e11;

std::string count_text(double duration, double deltat) {
  return fmt::format("{} s in steps of {} s", text::rounded(duration), text::rounded(deltat));
}

bool too_many(double time, double deltat) {
  return !(std::abs(time / deltat) <= static_cast<double>(most_steps));
}

}  // namespace

std::int64_t step_count(double time, double deltat) {
  if (too_many(time, deltat)) throw ExperimentError(step_count_problem(time, deltat));
  return std::llround(time / deltat);
}

std::string step_count_problem(double duration, double deltat) {
  if (!too_many(duration, deltat)) return "";
  return fmt::format(
      "{} are more steps than a run can count ({}): shorten the duration or lengthen the step",
      count_text(duration, deltat), most_steps);
}

std::string no_step_problem(double duration, double deltat) {
  if (!(duration > 0.) || step_count(duration, deltat) > 0) return "";
  return fmt::format(
      "{} s are less than half a step of {} s: the run takes none; lengthen the duration or shorten "
      "the step",
      text::rounded(duration), text::rounded(deltat));
}

bool check_duration(const language::Position& position, double duration, double deltat,
                    language::Diagnostics& diagnostics) {
  if (std::string problem = step_count_problem(duration, deltat); !problem.empty()) {
    diagnostics.error(position, std::move(problem));
    return false;
  }
  if (std::string problem = no_step_problem(duration, deltat); !problem.empty())
    diagnostics.warning(position, std::move(problem));
  if (const double steps = duration / deltat; steps > long_run)
    diagnostics.warning(
        position, fmt::format("{} are {} steps: at a million steps a second they take {} days",
                              count_text(duration, deltat), text::rounded(steps),
                              text::rounded(steps / 1e6 / 86400., 2)));
  return true;
}

}  // namespace hookpoint::simulation
