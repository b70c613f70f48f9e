// A run from its present step to its last: what it writes, what it says. Shared by the commands
// that begin a run and that go on with one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "language/tree/object.h"
#include "simulation/run/expectation.h"
#include "simulation/run/live_run.h"
#include "simulation/run/run_files.h"
#include "simulation/run/world.h"

namespace hookpoint::cli {

/// The largest stable step, and a warning when the experiment's is larger, on stderr.
void tell_stability(const simulation::Experiment& experiment);

/// Notes on stderr: options and fields that were set for this run and that its engine does not read.
void tell_unread(const language::Object& root, const simulation::Experiment& experiment);

/// Rows from the world's present step to step `last`, or to where the run ends; `expectations`, if
/// any, see every one. Returns the exit status; whatever went wrong has been said.
int step_through(const simulation::Experiment& experiment, simulation::World& world,
                 simulation::RunFiles& files, std::int64_t last,
                 simulation::Expectations* expectations = nullptr);

/// The same of a run with a script of changes, to its last step; what is changed drives the world,
/// so nothing is said of its energy.
int step_through(simulation::LiveRun& run);

/// On stderr: where the files of a run that is over are. Nothing when it leaves none.
void tell_files(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// A line on how many of the scene's Expects the run does not judge, and why; nothing where it
/// judges all. `whole`: it lasts as long as the scene says.
void print_not_judged(const simulation::Experiment& experiment, bool whole);

/// The truths that came with the scene beside what the run made of them, on stdout. Returns the
/// exit status.
int print_expectations(const simulation::Expectations& expectations);

/// Where everything is at the end, on stdout.
void print_summary(const simulation::Experiment& experiment, const simulation::WorldState& state);

}  // namespace hookpoint::cli
