// A robot of the world, or all of them together, as our engine steps it, whatever kind of law it is
// under.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulation/dts_engine/publish_contacts.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// What bodies do to the terrain or an obstacle.
struct SurfaceSum {
  ContactSum contacts;  ///< as the law left them
  Vector3d mean_force;  ///< over the last step [N]
};

/// What a robot under a force law can tell between steps: its contacts, and its hips, whose forces
/// an impulse law does not work out.
class ForceDetails {
 public:
  virtual ~ForceDetails() = default;
  /// Boundary point `point` of `body` of robot `robot` of the experiment, as the law left it.
  virtual PointState point_state(std::size_t robot, std::size_t body, std::size_t point) const = 0;
  /// Adds the ground's forces at the boundary points; the robot's first body is `first_body`.
  virtual void add_ground_forces(std::size_t first_body,
                                 std::vector<GroundForce>& forces) const = 0;
  /// What the contacts of each of its bodies come to.
  virtual void publish_body_contacts(std::span<BodyContact> bodies) const = 0;
  /// Adds what its contacts do to the terrain, if there is one, and to each obstacle.
  virtual void add_surface_contacts(std::span<SurfaceSum> surfaces) const = 0;
  /// What the springs of its contacts hold [J].
  virtual double ground_energy() const = 0;
  /// Whether the bodies' mean contact forces are worked out where they cost something.
  virtual void enable_mean_forces(bool on) = 0;
  /// What each joint transmits. O(links).
  virtual void publish_reactions(std::span<JointReaction> joints) = 0;
  /// What each chain does to the base.
  virtual void publish_hips(std::span<ChainState> chains) const = 0;
};

/// Characters of a notice that a step has room for, without allocation.
inline constexpr std::size_t longest_notice = 400;

class RobotPart {
 public:
  virtual ~RobotPart() = default;
  virtual std::size_t body_count() const = 0;
  virtual std::size_t joint_count() const = 0;

  /// Advances the robot by one step of the experiment from `time` [s] under the present inputs. On
  /// failure nothing has changed. Allocates nothing.
  virtual StepStatus step(double time) = 0;
  /// Takes the last successful step back: another robot's has failed.
  virtual void undo() = 0;

  /// Writes the published values of this robot's bodies and joints.
  virtual void publish(std::span<BodyState> bodies, std::span<JointState> joints) const = 0;
  /// Adds what touches the ground; the robot's bodies are published as `bodies`, the first of them
  /// is `first_body` of the world's.
  virtual void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                            std::vector<ContactView>& contacts) const = 0;
  /// Null under an impulse law, whose contacts do not last.
  virtual ForceDetails* details() { return nullptr; }
  /// Writes what its loops do, each at its number among the experiment's.
  virtual void publish_loops(std::span<LoopState> /*loops*/) const {}
  /// Work of the terrain's motion and of each obstacle's on bodies since the start [J]; empty where
  /// surfaces stand still.
  virtual std::span<const double> surface_works() const { return {}; }
  /// From the next step on `publish_works` is right.
  virtual void measure_work() = 0;
  /// Writes, one a robot of it, the work of forces and joints over the last step (work_meter.h) [J].
  virtual void publish_works(std::span<double> works) const = 0;
  /// What the integration has cost so far; zeros where there is no integrator.
  virtual IntegratorState statistics() const { return {}; }
  /// Impulses so far.
  virtual std::uint64_t impacts() const { return 0; }
  /// What the user should know, said once: the robot has left the terrain, the order of its points
  /// matters; "" while there is nothing.
  virtual const std::string& notice() const = 0;
  /// The run continues from an instant at which it had not.
  virtual void forget_notice() = 0;

  /// What evolves (resumable.h). `bodies`: this robot's published values, of whose quaternions the
  /// signs go on.
  virtual std::size_t state_size() const = 0;
  virtual std::string state_layout() const = 0;
  virtual void save(std::span<double> numbers, std::span<const BodyState> bodies) const = 0;
  virtual void restore(std::span<const double> numbers, std::span<BodyState> bodies) = 0;
};

}  // namespace hookpoint::simulation
