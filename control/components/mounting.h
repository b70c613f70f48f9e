// How a unit that measures in axes of its own, S, is turned in the body B that carries it.
#pragma once

#include "control/component.h"
#include "math/rotation.h"

namespace hookpoint::control {

inline Parameter mounting_orientation_of(Component& owner) {
  return Parameter{owner,
                   "mounting_orientation",
                   "",
                   0.,
                   "R_BS: turns the unit's axes into the body's; by default no turn",
                   4}
      .orientation();
}

/// A port of 4 numbers w, x, y, z.
template <class Port>
Quaterniond quaternion_of(const Port& port) {
  return {port[0], port[1], port[2], port[3]};
}

/// R_WS = R_WB R_BS, of the body's orientation and the mounting; what is wired into that need not
/// have the length 1.
inline Quaterniond unit_orientation(const Input& orientation, const Parameter& mounting) {
  return quaternion_of(orientation) * normalized(quaternion_of(mounting));
}

}  // namespace hookpoint::control
