// A robot under a force law: a RobotSystem that an integrator moves.
#pragma once

#include <array>
#include <memory>

#include "integrators/stepper.h"
#include "simulation/dts_engine/reactions.h"
#include "simulation/dts_engine/robot_part.h"
#include "simulation/dts_engine/robot_system.h"

namespace hookpoint::simulation {

class ForceRobot final : public RobotPart, private ForceDetails {
 public:
  /// Robot `index` of the experiment. `ground` may be null: no contact. All that is referred to
  /// outlives the robot. Throws ExperimentError when there is no such law or integrator.
  ForceRobot(const Experiment& experiment, std::size_t index, const contact::Terrain* ground,
             const WorldInputs& inputs);

  std::size_t body_count() const override { return system_.model().body_count(); }
  std::size_t joint_count() const override { return system_.model().link_count(); }
  StepStatus step(double time) override;
  void undo() override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;
  void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                    std::vector<ContactView>& contacts) const override;
  void publish_loops(std::span<LoopState> loops) const override {
    system_.robot().constraints().publish(system_.workspace(), loops);
  }
  void measure_work() override { system_.measure_work(); }
  void publish_works(std::span<double> works) const override { works[0] = system_.work(); }
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
  void enable_mean_forces(bool on) override;
  void publish_reactions(std::span<JointReaction> joints) override { reactions_.publish(joints); }
  void publish_hips(std::span<ChainState> chains) const override;
  void publish_body_contacts(std::span<BodyContact> bodies) const override;
  void add_surface_contacts(std::span<SurfaceSum> surfaces) const override;

  const Experiment& experiment_;
  RobotSystem system_;
  Reactions reactions_;
  std::unique_ptr<integrators::Stepper> stepper_;
  std::array<double, integrators::Stepper::state_size()> stepper_before_{};  ///< the present step
};

}  // namespace hookpoint::simulation
