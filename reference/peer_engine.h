// The step of every peer: advance the library's world, read it, refuse what is not finite, publish.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/engine.h"

namespace hookpoint::reference {

/// A force of the ground where shapes meet it.
struct ShapeForce {
  std::size_t body = 0;  ///< as published
  Vector3d position;     ///< world axes [m], at the time of `PeerWorld::force_time`: the step's
                         ///< start for the mean over a step
  Vector3d force;        ///< on the body, world axes [N]
};

/// One library's world. Bodies and joints are numbered as they are published (robot_tree.h).
class PeerWorld {
 public:
  virtual ~PeerWorld() = default;
  /// Advances by one step under `inputs.forces`, one a ForceSpec of the experiment, and
  /// `inputs.joint_torques`, one a joint: the drive's and what the joint exerts by itself at the
  /// step's start (dts/joint_forces.h), together. Empty on success, else the library's trouble in
  /// a few words.
  virtual std::string advance(const simulation::WorldInputs& inputs) = 0;
  /// What the user should know of the step just taken, else empty. Said once.
  virtual std::string notice() { return {}; }
  /// Writes the motion and last contact force of every body, and each joint's angle and rate; fixed
  /// bodies are left as they are. After a failure too: what is not finite then tells which body it
  /// was.
  virtual void read(std::span<simulation::BodyState> bodies,
                    std::span<simulation::JointState> joints) const = 0;
  /// Writes the ground's force on each of touching_points(), world axes [N], in the last step.
  virtual void read_points(std::span<Vector3d> forces) const = 0;
  /// Adds the forces of the last step on shapes: those that are not on touching_points().
  virtual void read_shapes(std::vector<ShapeForce>& forces) const = 0;
  /// When all these forces act.
  virtual simulation::GroundForceTime force_time() const {
    return simulation::GroundForceTime::last_step;
  }
};

/// An engine around the world that `build` makes, with the published state of `experiment` at time
/// 0 and the notices of check_supported() already said. The joints' own torques, accelerations, and
/// the named ContactPoints are its work, alike for every library. Throws ExperimentError where
/// `engine` has a gap that the experiment needs, and with the library's own words where that throws
/// while the world is built.
std::unique_ptr<simulation::Engine> make_peer_engine(
    const simulation::Experiment& experiment, const simulation::EngineDescription& engine,
    const std::function<std::unique_ptr<PeerWorld>()>& build);

}  // namespace hookpoint::reference
