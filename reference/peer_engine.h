// One library's world, and the engine around it (make_peer_engine, peer.h), whose step is alike for
// every peer: advance the world, read it, refuse what is not finite, publish.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/peer.h"

namespace hookpoint::reference {

/// A force of the ground where shapes meet it.
struct ShapeForce {
  std::size_t body = 0;  ///< as published
  Vector3d position;     ///< world axes [m], at the time of `PeerWorld::force_time`: the step's
                         ///< start for the mean over a step
  Vector3d force;        ///< on the body, world axes [N]
};

/// What helps where a library's own check ended a step.
inline constexpr const char* smaller_step_helps = "; a smaller deltat may help";

/// One library's world. Bodies and joints are numbered as they are published (robot_tree.h).
class PeerWorld {
 public:
  virtual ~PeerWorld() = default;
  /// Advances by one step under `inputs.forces` and `inputs.pull` (external_forces.h), and
  /// `inputs.joint_torques`, one a joint: the drive's and what the joint exerts by itself at the
  /// step's start (simulation/experiment/joint_forces.h), together. Empty on success, else the
  /// trouble in a few words and what to do.
  virtual std::string advance(const simulation::WorldInputs& inputs) = 0;
  /// As Engine::announce.
  virtual void announce(std::int64_t /*steps*/) {}
  /// Whether the world is gone for good: advance() has just reported it.
  virtual bool lost() const { return false; }
  /// The body whose load or motion is beyond what the library's own checks let pass (extremes.h):
  /// advance() has then not taken the step, which would have led to a state that is not finite.
  virtual std::optional<std::size_t> beyond_range() const { return std::nullopt; }
  /// What the user should know of the step just taken, else empty. Said once.
  virtual std::string notice() { return {}; }
  /// Writes the motion and last contact force of every body, and each joint's angle and rate; fixed
  /// bodies are left as they are. After a failure too: what is not finite then tells which body it
  /// was.
  virtual void read(std::span<simulation::BodyState> bodies,
                    std::span<simulation::JointState> joints) const = 0;
  /// Writes the ground's force on each of touching_points(), world axes [N], in the last step.
  virtual void read_points(std::span<Vector3d> forces) const = 0;
  /// Writes the force and moment of each Loop in the last step, on its body a; `error` is the
  /// caller's.
  virtual void read_loops(std::span<simulation::LoopState> /*loops*/) const {}
  /// Adds the forces of the last step on shapes: those that are not on touching_points().
  virtual void read_shapes(std::vector<ShapeForce>& forces) const = 0;
  /// When all these forces act.
  virtual simulation::GroundForceTime force_time() const {
    return simulation::GroundForceTime::last_step;
  }
};

}  // namespace hookpoint::reference
