// Every number that an engine publishes, by its trail. A resolved port is a pointer into the
// WorldState: reading it costs an index.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/engine.h"

namespace hookpoint::simulation {

struct Port {
  std::string trail;              ///< "block.base.location.x", without the world's name
  std::string unit;               ///< "m"
  const double* value = nullptr;  ///< lives as long as the engine that published it
};

/// All ports of a world, robots in file order. A robot's own `position`, `velocity`, ... are its
/// base's. `state` is the engine's published state; its bodies and joints stand in the experiment's
/// order.
std::vector<Port> list_ports(const Experiment& experiment, const WorldState& state);

/// The port named by `trail`, with or without the world's name in front.
/// Throws ExperimentError naming the nearest trails when there is none. O(ports).
Port find_port(const Experiment& experiment, const std::vector<Port>& ports,
               std::string_view trail);

}  // namespace hookpoint::simulation
