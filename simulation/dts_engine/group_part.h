// All robots of an experiment under a force law and `touch = shapes`: a RobotGroup that an integrator
// moves.
#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "integrators/stepper.h"
#include "simulation/dts_engine/reactions.h"
#include "simulation/dts_engine/robot_group.h"
#include "simulation/dts_engine/robot_part.h"

namespace hookpoint::simulation {

class GroupPart final : public RobotPart, private ForceDetails {
 public:
  /// `ground` may be null. All that is referred to outlives it. Throws ExperimentError when there is
  /// no such law or integrator.
  GroupPart(const Experiment& experiment, const contact::Terrain* ground,
            const WorldInputs& inputs);

  std::size_t body_count() const override { return body_count_; }
  std::size_t joint_count() const override { return joint_count_; }
  StepStatus step(double time) override;
  void undo() override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;
  void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                    std::vector<ContactView>& contacts) const override;
  void measure_work() override { group_.measure_work(); }
  void publish_works(std::span<double> works) const override {
    std::ranges::transform(group_.works(), works.begin(), &WorkMeter::work);
  }
  ForceDetails* details() override { return this; }
  IntegratorState statistics() const override;
  const std::string& notice() const override;
  void forget_notice() override;

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

 private:
  PointState point_state(std::size_t robot, std::size_t body, std::size_t point) const override;
  void add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const override;
  double ground_energy() const override;
  void publish_loops(std::span<LoopState> loops) const override {
    for (const ArticulatedRobot& robot : group_.robots())
      robot.constraints().publish(robot.workspace(), loops);
  }
  std::span<const double> surface_works() const override {
    return group_.contacts().surface_works();
  }
  void enable_mean_forces(bool on) override { group_.enable_mean_forces(on); }
  void publish_reactions(std::span<JointReaction> joints) override;
  void publish_hips(std::span<ChainState> chains) const override;
  void publish_body_contacts(std::span<BodyContact> bodies) const override;
  void add_surface_contacts(std::span<SurfaceSum> surfaces) const override;
  /// Calls `visit(robot, first_body, first_joint)` for each.
  template <class Visit>
  void for_each_robot(const Visit& visit) const;

  const Experiment& experiment_;
  RobotGroup group_;
  std::vector<Reactions> reactions_;  ///< one a robot
  std::unique_ptr<integrators::Stepper> stepper_;
  std::size_t body_count_ = 0, joint_count_ = 0;
  mutable std::vector<ContactSum> sums_;  ///< one a body, for what is published
  std::array<double, integrators::Stepper::state_size()> stepper_before_{};
};

}  // namespace hookpoint::simulation
