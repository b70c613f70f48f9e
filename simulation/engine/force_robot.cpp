#include "simulation/engine/force_robot.h"

#include <fmt/format.h>

#include "integrators/adaptive.h"
#include "simulation/engine/publish.h"
#include "simulation/engine/step.h"

namespace hookpoint::simulation {
namespace {

std::unique_ptr<integrators::Stepper> stepper_within_budget(const Experiment& experiment,
                                                            std::size_t index,
                                                            const RobotSystem& system) {
  try {
    return integrators::make_stepper(
        experiment.integrator, system,
        {experiment.relative_tolerance, experiment.absolute_tolerance});
  } catch (const integrators::TooManyUnknowns& error) {
    throw ExperimentError("robot '" + experiment.robots[index].name + "' under " +
                          experiment.integrator + ": " +
                          too_many_unknowns(error.unknowns, error.states));
  }
}

}  // namespace

ForceRobot::ForceRobot(const Experiment& experiment, std::size_t index,
                       const contact::Terrain* ground, const WorldInputs& inputs)
    : experiment_(experiment),
      system_(experiment, index, ground, inputs),
      stepper_(stepper_within_budget(experiment, index, system_)) {}

StepStatus ForceRobot::step(double time) {
  stepper_->save(stepper_before_);
  const StepStatus status = simulation::step(system_, *stepper_, time);
  if (!status.ok()) stepper_->restore(stepper_before_);
  return status;
}

void ForceRobot::undo() {
  system_.undo();
  stepper_->restore(stepper_before_);
}

void ForceRobot::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  publish_motion(system_.robot(), bodies);
  system_.contacts().publish(experiment_.deltat, bodies);
  publish_joints(system_.robot(), joints);
}

IntegratorState ForceRobot::statistics() const {
  const integrators::Statistics& counted = stepper_->statistics();
  return {counted.steps, counted.rejected, counted.evaluations, counted.jacobians, counted.events};
}

PointState ForceRobot::point_state(std::size_t body, std::size_t point) const {
  return system_.contacts().point_state(body, point);
}

void ForceRobot::add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const {
  system_.contacts().add_ground_forces(system_.workspace(), first_body, forces);
}

void ForceRobot::add_contacts(std::size_t first_body, std::span<const BodyState> /*bodies*/,
                              std::vector<ContactView>& contacts) const {
  system_.contacts().add_contacts(first_body, contacts);
}

double ForceRobot::ground_energy() const { return system_.contacts().stored_energy(); }

void ForceRobot::publish_contact_forces(bool wanted) { system_.publish_contact_forces(wanted); }

void ForceRobot::publish_hips(std::span<ChainState> chains) const {
  simulation::publish_hips(system_.robot(), chains);
}

// The parts of the system, the signs of the links' quaternions, the stepper's.

std::size_t ForceRobot::state_size() const {
  return count_of(system_) + joint_count() + stepper_->state_size();
}

std::string ForceRobot::state_layout() const {
  return fmt::format("{} quaternion_sign[{}] {}[{}]", layout_of(system_), joint_count(),
                     experiment_.integrator, stepper_->state_size());
}

void ForceRobot::save(std::span<double> numbers, std::span<const BodyState> bodies) const {
  save_to(numbers, system_);
  const std::span<double> signs = numbers.subspan(count_of(system_), joint_count());
  save_signs(system_.robot(), bodies, signs);
  stepper_->save(numbers.last(stepper_->state_size()));
}

void ForceRobot::restore(std::span<const double> numbers, std::span<BodyState> bodies) {
  restore_from(numbers, system_);
  system_.restored();
  restore_signs(system_.robot(), numbers.subspan(count_of(system_), joint_count()), bodies);
  stepper_->restore(numbers.last(stepper_->state_size()));
}

}  // namespace hookpoint::simulation
