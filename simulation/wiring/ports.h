// Every number of a world by its trail. A resolved port is a pointer: reading or writing it costs
// no look-up.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// What is worked out only while somebody reads it.
class Lazy {
 public:
  virtual ~Lazy() = default;
  /// From now on the values are right, at once and after each step. May allocate.
  virtual void begin() = 0;
};

struct Port {
  std::string trail;              ///< from the top: "SimpleWorld.block.base.location.x", "pd1.goal"
  std::string unit;               ///< "m"
  const double* value = nullptr;  ///< lives as long as the world
  double* writable = nullptr;     ///< the same where wires may write, else null
  Lazy* lazy = nullptr;           ///< to be begun by whoever keeps `value`; find_port does
  std::string doc;                ///< one line, of a component's port
  double minimum = -std::numeric_limits<double>::infinity();  ///< declared range
  double maximum = std::numeric_limits<double>::infinity();
};

/// A port and the number that somebody gives it, in its unit.
struct PortValue {
  std::string trail;
  double value = 0.;
};

class DerivedPorts;

/// What the engine publishes and what follows from it, and its joints' drives: robots in file
/// order. A robot's own `position`, `velocity`, ... are its base's.
std::vector<Port> list_ports(const Experiment& experiment, Engine& engine, DerivedPorts& derived);

/// The port named by `trail`, as below; nothing when there is none.
std::optional<Port> look_up_port(const Experiment& experiment, const std::vector<Port>& ports,
                                 std::string_view trail);
/// The port named by `trail`: from the top, or from within the world ("block.base.location.x").
/// Its value is right from now on. Throws ExperimentError naming the nearest trail when there is
/// none. O(ports).
Port find_port(const Experiment& experiment, const std::vector<Port>& ports,
               std::string_view trail);

}  // namespace hookpoint::simulation
