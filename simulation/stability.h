// The largest step with which a robot stands on its ground without the integrator pumping energy
// into the contacts.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "simulation/experiment.h"

namespace hookpoint::simulation {

struct StabilityBound {
  double step =
      0.;  ///< largest stable step of the experiment's integrator [s]; infinity without forces
  double stiffness = 0.;   ///< largest eigenvalue of M^-1 sum J^T K J [1/s^2]
  double damping = 0.;     ///< largest eigenvalue of M^-1 sum J^T C J [1/s]
  std::string robot = {};  ///< the robot it belongs to
  /// Which contacts are in it: those that touch at the initial state, else the worst boundary
  /// point's alone, or none where there is no ground to touch.
  enum class Contacts { touching, worst, none };
  Contacts contacts = Contacts::none;
  /// Sliding speed up to which deltat resolves the law's bristles; infinite for a law without
  /// bristles and for an adaptive integrator [m/s].
  double resolved_speed = std::numeric_limits<double>::infinity();
  std::vector<std::string> controllers = {};  ///< of the robot's joints, whose loops are in it
  std::vector<std::string> left_out = {};     ///< feedback that is not, with the reason
};

/// The bound at the experiment's initial state, the smallest of its robots; only for engine dts
/// under a force law. Each contact is linearised about its load: K = k n n^T + k_t (1 - n n^T), C
/// alike; springs and dampers of joints are in it, and wired controllers where they can be
/// (docs/contact.md). O(points^3).
StabilityBound stability_bound(const Experiment& experiment);

/// "pd and 3 more": the first few of many names.
std::string first_of(const std::vector<std::string>& names);

}  // namespace hookpoint::simulation
