#include "simulation/dts_engine/impulse_body.h"

#include "simulation/engine_interface/held_force.h"

namespace hookpoint::simulation {
namespace {

contact::ImpulseBody describe(const BodySpec& body, bool has_ground) {
  contact::ImpulseBody described{
      body.mass.mass, body.mass.center_of_mass, body.mass.inertia, {}, {}, {}};
  if (has_ground) {
    described.boundary_points = body.boundary_points;
    described.boundary_radii = body.boundary_radii;
    described.boundary_materials = body.boundary_materials;
  }
  return described;
}

contact::ImpulseState initial_motion(const RobotSpec& robot) {
  return {robot.location, robot.orientation, robot.velocity, robot.angular_velocity};
}

}  // namespace

ImpulseBody::ImpulseBody(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
                         const contact::Terrain* ground, const WorldInputs& inputs)
    : ImpulsePart(experiment, {index, 1}, ground),
      index_(index),
      inputs_(inputs),
      law_(describe(experiment.robots[index].base, ground_.exists()), law),
      motion_(initial_motion(experiment.robots[index])),
      motion_before_(motion_) {}

contact::ImpulseTally ImpulseBody::advance(const contact::GroundQuery& ground) {
  motion_before_ = motion_;
  result_before_ = result_;
  if (!experiment_.robots[index_].mobile) return {};
  const contact::AdvanceResult result = law_.advance(motion_, experiment_.deltat, load(), ground);
  if (result.status == contact::AdvanceStatus::ok) result_ = result;
  return result;
}

void ImpulseBody::go_back() {
  motion_ = motion_before_;
  result_ = result_before_;
}

void ImpulseBody::publish(std::span<BodyState> bodies, std::span<JointState> /*joints*/) const {
  bodies[0] = {motion_.position,
               motion_.orientation,
               motion_.velocity,
               motion_.angular_velocity,
               (1. / experiment_.deltat) * result_.impulse,
               result_.contacts};
}

// The forces that were held over the step act at points of the body.
void ImpulseBody::publish_works(std::span<double> works) const {
  const Pose before{motion_before_.position, motion_before_.orientation};
  const Pose now{motion_.position, motion_.orientation};
  works[0] = result_.impulse_work;
  for (const std::size_t k : inputs_.forces_of[index_])
    works[0] += held_force_work(inputs_.forces[k], before, now);
  if (inputs_.pull.robot == static_cast<int>(index_))
    works[0] += held_force_work(inputs_.pull.force, before, now);
}

// The external forces about the centre of mass, at the step's start.
contact::ImpulseLoad ImpulseBody::load() const {
  contact::ImpulseLoad load{inputs_.gravity, {}, {}};
  const BodySpec& body = experiment_.robots[index_].base;
  for (const std::size_t k : inputs_.forces_of[index_]) {
    const ForceInput& force = inputs_.forces[k];
    load.force += force.force;
    load.torque += force.torque;
    load.torque +=
        cross(rotate(motion_.orientation, force.point - body.mass.center_of_mass), force.force);
  }
  if (inputs_.pull.robot == static_cast<int>(index_)) {
    const ForceInput& pull = inputs_.pull.force;
    load.force += pull.force;
    load.torque +=
        cross(rotate(motion_.orientation, pull.point - body.mass.center_of_mass), pull.force);
  }
  return load;
}

std::size_t ImpulseBody::state_size() const { return count_of(*this); }
std::string ImpulseBody::state_layout() const { return layout_of(*this); }

void ImpulseBody::save(std::span<double> numbers, std::span<const BodyState> /*bodies*/) const {
  save_to(numbers, *this);
}

void ImpulseBody::restore(std::span<const double> numbers, std::span<BodyState> /*bodies*/) {
  restore_from(numbers, *this);
}

}  // namespace hookpoint::simulation
