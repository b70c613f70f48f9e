// The state that a run starts from where a user chose it: numbers of the initial state by port,
// which changes.csv holds before the changes of step 0.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/run/changes.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// What is written to a port of the initial state (initial_state.h), or to all elements of a vector.
struct StartValue {
  std::string trail;
  std::vector<double> values;
  bool operator==(const StartValue&) const = default;
};

/// As a row of changes.csv: trail "start:lab.block.base.location", value "0,0,0.5".
Change change_of(const StartValue& value);
/// None of a change of another kind. Throws ChangesError where the value is no list of numbers.
std::optional<StartValue> start_value_of(const Change& change);

/// The pose that `state` shows, at rest: what of it is not the initial state of `experiment`.
std::vector<StartValue> present_pose(const Experiment& experiment, const WorldState& state);

/// `values` with `more` in their place or after them.
std::vector<StartValue> merged(std::vector<StartValue> values, std::span<const StartValue> more);

/// `experiment` with these numbers in its initial state; `world` is one of it. Throws
/// ExperimentError, where a trail is none of an initial state or a value cannot be.
Experiment started(const Experiment& experiment, World& world, std::span<const StartValue> values);

}  // namespace hookpoint::simulation
