// The largest step with which a robot stands on its ground without the integrator pumping energy
// into the contacts.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct StabilityBound {
  double step =
      0.;  ///< largest stable step of the experiment's integrator [s]; infinity without forces
  double stiffness = 0.;   ///< largest eigenvalue of M^-1 sum J^T K J [1/s^2]
  double damping = 0.;     ///< largest eigenvalue of M^-1 sum J^T C J [1/s]
  std::string robot = {};  ///< the robot it belongs to; several by first_of
  /// Which contacts are in it: those on which the robot stands near its initial state, else all of
  /// the worst face on which it may land, that with another body or an obstacle that it may meet, or
  /// none where there is nothing to touch.
  enum class Contacts { touching, landing, meeting, none };
  Contacts contacts = Contacts::none;
  /// Sliding speed up to which deltat resolves the law's bristles; infinite for a law without
  /// bristles and for an adaptive integrator [m/s].
  double resolved_speed = std::numeric_limits<double>::infinity();
  double without_controllers = 0.;            ///< `step` were it not for their loops [s]
  std::vector<std::string> controllers = {};  ///< of the robot's joints, whose loops are in it
  double controller_rate = 0.;                ///< of their updates; 0: every step [Hz]
  std::vector<std::string> left_out = {};     ///< feedback that is not, with the reason
  /// Of the law at a point, to find how the robots stand: the greater part of the cost where there
  /// are many points.
  std::int64_t evaluations = 0;
  /// Why there is no bound though something springs back: "robot 'r' has 2000 degrees of freedom
  /// ...". `step` is then infinite.
  std::string not_computed = {};
};

/// The bound at the experiment's initial state, the smallest of its robots; only for engine dts
/// under a force law. Each contact is linearised about the load that it carries: K = k n n^T + k_t
/// (1 - n n^T), C alike; springs and dampers of joints are in it, the stiffness of gravity, and
/// wired controllers where they can be (docs/contact.md). Under `touch = shapes` robots that touch at
/// the start, each other too, are one dynamics with the places where they do. Of each robot O(points links^2) for how
/// its points move; for each face on which it may land, or once, an equilibrium of a few to 200
/// tries of O(points links^2) over the face's points, and O(40 links^3) for the step; and the hull
/// of the points (convex_hull.h). What takes more than AnalysisBudget::most is not computed.
StabilityBound stability_bound(const Experiment& experiment);

/// What to do about a step above a bound that the loops of its controllers set; "" where they do
/// not.
std::string controller_advice(const StabilityBound& bound);

/// "pd and 3 more": the first few of many names.
std::string first_of(const std::vector<std::string>& names);

}  // namespace hookpoint::simulation
