// Where a robot rests on its ground, from which `rest_on` starts it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contact/terrain/terrain.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A pose, and what the contacts hold there.
struct RestingState {
  Vector3d location;        ///< p_WB [m]
  Quaterniond orientation;  ///< R_WB
  /// Stretch of the tangential spring of each boundary point, body by body, world axes [m]; empty
  /// for a law without one.
  std::vector<Vector3d> stretch;
  Vector3d velocity;          ///< v_WB: the steady creep of a law without tangential spring [m/s]
  Vector3d angular_velocity;  ///< w_WB, likewise [rad/s]
};

/// A state, or why there is none; neither where the pose is in balance as it is, and where engine
/// dts has no force law to balance with.
struct Resting {
  std::optional<RestingState> state;
  std::string problem;
};

/// The state near the pose of `robot` in which the ground's forces balance its weight, under the
/// force law of engine dts: the body leans, as the points downhill carry more, and tangential
/// springs are stretched by m g sin. A robot with joints is one rigid body in its initial posture.
/// None within `farthest_tilt` for a slope that is steeper than friction holds, a ball on a slope,
/// and a body that tips over. Newton's method, each step O(7 points); `most_evaluations` of the law
/// at a point, or two steps where these are more.
Resting resting_state(const Experiment& experiment, const RobotSpec& robot,
                      const contact::Terrain& ground);

/// A body that would have to tilt farther does not rest on what it was laid on [rad].
inline constexpr double farthest_tilt = 0.05;

/// Bound of the search, a second or less.
inline constexpr std::int64_t most_evaluations = 4'000'000;

}  // namespace hookpoint::simulation
