// Robots under an impulse law: no forces of the ground and no integrator, but flight from impact to
// impact (docs/contact_impulse.md). What single bodies and groups of robots have in common.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/impulse/impulse_resolution.h"
#include "contact/terrain/terrain.h"
#include "simulation/dts_engine/impulse_ground.h"
#include "simulation/dts_engine/robot_part.h"

namespace hookpoint::simulation {

/// Robots `first` to `first + count - 1` of an experiment.
struct RobotRange {
  std::size_t first = 0, count = 1;
};

class ImpulsePart : public RobotPart {
 public:
  StepStatus step(double time) final;
  void undo() final;
  std::uint64_t impacts() const final { return impacts_; }
  const std::string& notice() const final { return notice_; }
  void forget_notice() final { notice_.clear(); }
  void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                    std::vector<ContactView>& contacts) const override;

  /// Advances the robots by one step under the present inputs, above the tiles of `ground`. On any status but ok
  /// the state is that before.
  virtual contact::ImpulseTally advance(const contact::GroundQuery& ground) = 0;

 protected:
  /// `ground` may be null. Without ground and obstacles there are no boundary points. All that is
  /// referred to outlives the part.
  ImpulsePart(const Experiment& experiment, RobotRange robots, const contact::Terrain* ground);

  /// Takes the motion of the last successful step back.
  virtual void go_back() = 0;
  /// Name of the robot that a failure of the present step is of.
  virtual const std::string& failed_robot() const;
  /// Says once that a robot of the experiment is beside the terrain, at `place`.
  void look_for_edge(std::size_t robot, const Vector3d& place);
  /// Says once that the order of points matters to the result, and why.
  void look_for_order(contact::OrderCause cause);

  /// Whether the present step is not the first.
  bool in_run() const { return in_run_; }

  std::span<const RobotSpec> specs() const {
    return std::span(experiment_.robots).subspan(robots_.first, robots_.count);
  }

  const Experiment& experiment_;
  const RobotRange robots_;
  const ImpulseGround ground_;
  std::uint64_t impacts_ = 0;  ///< archived by the part

 private:
  const contact::Terrain* terrain_;
  std::uint64_t impacts_before_ = 0;  ///< the present step, to undo it
  bool noticed_before_ = false;       ///< likewise
  bool in_run_ = false;               ///< the present step is not the first
  std::string notice_, left_;         ///< left_: of the present step
};

/// Whether robots under the experiment's impulse law make one system, since what they touch is more than
/// the tile under a point: each other, risers, obstacles, ground that moves.
bool impulses_together(const Experiment& experiment);

/// Robot `index` of the experiment under its impulse law: a single body, or a robot with chains; all of
/// them where they make one system. Throws ExperimentError when there is no such law.
std::unique_ptr<RobotPart> make_impulse_part(const Experiment& experiment, std::size_t index,
                                             const contact::Terrain* ground,
                                             const WorldInputs& inputs);

}  // namespace hookpoint::simulation
