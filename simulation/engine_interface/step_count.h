// Number of steps in a time: the only place where a quotient of two times becomes an integer.
#pragma once

#include <cstdint>
#include <string>

#include "language/diagnostics.h"

namespace hookpoint::simulation {

/// Greatest number of steps of a run, 2^53: above it a double no longer holds each whole number, so
/// that `step * deltat` would repeat.
inline constexpr std::int64_t most_steps = std::int64_t{1} << 53;

/// Number of steps of `deltat` that is nearest to `time`, negative before time 0. Throws
/// ExperimentError above `most_steps`.
std::int64_t step_count(double time, double deltat);

/// Why a run cannot last `duration`: more than `most_steps` steps. "" where it can.
std::string step_count_problem(double duration, double deltat);

/// Why a run of `duration` would not move: less than half a step. "" where it does, or lasts 0 s.
std::string no_step_problem(double duration, double deltat);

/// Reports at `position` a duration that no run can last as an error, and one that would take days, or no
/// step, as a warning. False after an error.
bool check_duration(const language::Position& position, double duration, double deltat,
                    language::Diagnostics& diagnostics);

}  // namespace hookpoint::simulation
