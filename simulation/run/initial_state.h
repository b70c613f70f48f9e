// The initial state of a run as numbers by port, for programs that choose it: of each robot the
// base's location, orientation, velocity and angular velocity, and angle and rate of every joint.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// What is written to one port of the initial state, or to all elements of a vector.
struct InitialValue {
  std::string trail;                 ///< as the user wrote it
  std::vector<std::size_t> numbers;  ///< of InitialState::find
  std::vector<double> values;        ///< one a number; of an orientation also roll, pitch, yaw
};

/// Which numbers of an initial state the ports of a world show.
class InitialState {
 public:
  /// `published`: the state that the world's engine publishes; it is only read now.
  InitialState(const Experiment& experiment, const WorldState& published);
  /// The numbers behind the elements of `trail`. Throws ExperimentError for ports that are no part
  /// of an initial state, and for a part of an orientation. O(elements log numbers).
  std::vector<std::size_t> find(const std::string& trail, std::span<const Port> elements) const;

 private:
  std::vector<std::pair<const double*, std::size_t>> by_address_;  // sorted
  std::vector<std::size_t> orientations_;                          // the first number of each
};

/// Gives `start` the initial state of `own`, whose copy it is, and then `written`. Throws
/// ExperimentError where a value cannot be: not finite, a rotation without length, velocities of a
/// base that is fixed or out of its plane, angles beyond a joint's limits. O(robots and joints).
void write_initial_state(const Experiment& own, std::span<const InitialValue> written,
                         Experiment& start);

}  // namespace hookpoint::simulation
