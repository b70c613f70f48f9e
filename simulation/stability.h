// The largest step with which a robot stands on its ground without the integrator pumping energy
// into the contacts.
#pragma once

#include <limits>
#include <string>

#include "simulation/experiment.h"

namespace hookpoint::simulation {

struct StabilityBound {
  double step =
      0.;  ///< largest stable step of the experiment's integrator [s]; infinity without contact
  double stiffness = 0.;  ///< largest eigenvalue of M^-1 sum J^T K J [1/s^2]
  double damping = 0.;    ///< largest eigenvalue of M^-1 sum J^T C J [1/s]
  std::string robot;      ///< the robot it belongs to
  bool touching = false;  ///< of the points that touch at the initial state; else of the worst
                          ///< boundary point alone
  /// Sliding speed up to which deltat resolves the law's bristles; infinite for a law without
  /// bristles and for an adaptive integrator [m/s].
  double resolved_speed = std::numeric_limits<double>::infinity();
};

/// The bound at the experiment's initial state, the smallest of its robots; only for engine dts
/// under a force law. Each contact is linearised about its load: K = k n n^T + k_t (1 - n n^T), C
/// alike. The stiffest mode is taken with the largest damping, as if they were the same mode: at or
/// below the bound of any single one (docs/contact.md). Joint springs are left out. O(points^3).
StabilityBound stability_bound(const Experiment& experiment);

}  // namespace hookpoint::simulation
