// A robot under a force law: a RobotSystem that an integrator moves.
#pragma once

#include <array>
#include <memory>

#include "integrators/stepper.h"
#include "simulation/engine/robot_part.h"
#include "simulation/engine/robot_system.h"

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
  ForceDetails* details() override { return this; }
  IntegratorState statistics() const override;
  const std::string& notice() const override { return system_.contacts().notice(); }
  void forget_notice() override { system_.contacts().forget_notice(); }

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

 private:
  PointState point_state(std::size_t body, std::size_t point) const override;
  void add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const override;
  double ground_energy() const override;
  void publish_contact_forces(bool wanted) override;
  void publish_hips(std::span<ChainState> chains) const override;

  const Experiment& experiment_;
  RobotSystem system_;
  std::unique_ptr<integrators::Stepper> stepper_;
  std::array<double, integrators::Stepper::state_size()> stepper_before_{};  ///< the present step
};

}  // namespace hookpoint::simulation
