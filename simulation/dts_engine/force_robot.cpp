#include "simulation/dts_engine/force_robot.h"

#include <fmt/format.h>

#include "simulation/dts_engine/methods.h"
#include "simulation/dts_engine/publish.h"
#include "simulation/dts_engine/publish_contacts.h"
#include "simulation/dts_engine/step.h"

namespace hookpoint::simulation {
ForceRobot::ForceRobot(const Experiment& experiment, std::size_t index,
                       const contact::Terrain* ground, const WorldInputs& inputs)
    : experiment_(experiment),
      system_(experiment, index, ground, inputs),
      reactions_(system_.robot()),
      stepper_(stepper_within_budget(experiment, "robot '" + experiment.robots[index].name + "'",
                                     system_)) {}

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
  publish_contact_forces(system_.contacts(), system_.dt(), bodies);
  publish_joints(system_.robot(), joints);
}

IntegratorState ForceRobot::statistics() const {
  const integrators::Statistics& counted = stepper_->statistics();
  return {counted.steps, counted.rejected, counted.evaluations, counted.jacobians, counted.events};
}

PointState ForceRobot::point_state(std::size_t /*robot*/, std::size_t body,
                                   std::size_t point) const {
  // The points of a fixed base, and all where there is no ground, are left out.
  const std::span<const ContactPoint> points = system_.contacts().points_of(body);
  return point < points.size() ? simulation::point_state(points[point]) : PointState{};
}

void ForceRobot::add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const {
  simulation::add_ground_forces(system_.contacts(), system_.workspace(), first_body, forces);
}

void ForceRobot::add_contacts(std::size_t first_body, std::span<const BodyState> /*bodies*/,
                              std::vector<ContactView>& contacts) const {
  simulation::add_contacts(system_.contacts(), first_body, contacts);
}

const std::string& ForceRobot::notice() const {
  const std::string& of_contacts = system_.contacts().notice();
  return of_contacts.empty() ? system_.robot().constraints().notice() : of_contacts;
}

void ForceRobot::forget_notice() {
  system_.contacts().forget_notice();
  system_.robot().constraints().forget_notice();
}

double ForceRobot::ground_energy() const {
  return stored_energy(system_.contacts(), system_.workspace());
}

void ForceRobot::enable_mean_forces(bool on) { system_.enable_mean_forces(on); }

void ForceRobot::publish_body_contacts(std::span<BodyContact> bodies) const {
  simulation::publish_body_contacts(system_.contacts(), system_.workspace(), bodies);
}

void ForceRobot::add_surface_contacts(std::span<SurfaceSum> surfaces) const {
  if (surfaces.empty()) return;
  add_ground_contacts(system_.contacts(), surfaces[0].contacts);
  for (const Vector3d& impulse : system_.contacts().impulses())
    surfaces[0].mean_force -= (1. / system_.dt()) * impulse;
}

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
