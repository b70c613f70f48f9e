// In which order wires and components pass values on within one step.
#pragma once

#include <vector>

#include "simulation/wiring/components.h"

namespace hookpoint::simulation {

/// A wire or a component, by its index.
struct WiringItem {
  bool is_wire = false;
  std::size_t index = 0;
};

struct WiringOrder {
  /// Wires without delay and all components: whatever gives a value comes before what takes it.
  std::vector<WiringItem> items;
  /// Wires without delay that pass a value round in a circle, from one to the next, the file's
  /// first at the front; empty when there is no such circle, and then `items` holds all.
  std::vector<std::size_t> loop;
};

/// O(wires + components). Deterministic: ties go to what the file says first.
WiringOrder order_wiring(const Experiment& experiment, const Components& components);

}  // namespace hookpoint::simulation
