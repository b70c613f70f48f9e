#include "simulation/engine/impulse_body.h"

namespace hookpoint::simulation {
namespace {

contact::ImpulseBody describe(const BodySpec& body, bool has_ground) {
  contact::ImpulseBody described{
      body.mass.mass, body.mass.center_of_mass, body.mass.inertia, {}, {}};
  if (has_ground) {
    described.boundary_points = body.boundary_points;
    described.boundary_radii = body.boundary_radii;
  }
  return described;
}

contact::ImpulseState initial_motion(const RobotSpec& robot) {
  return {robot.location, robot.orientation, robot.velocity, robot.angular_velocity};
}

}  // namespace

ImpulseBody::ImpulseBody(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
                         bool has_ground, const WorldInputs& inputs)
    : experiment_(experiment),
      index_(index),
      inputs_(inputs),
      law_(describe(experiment.robots[index].base, has_ground), law),
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

void ImpulseBody::undo() {
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

// The external forces about the centre of mass, at the step's start.
contact::ImpulseLoad ImpulseBody::load() const {
  contact::ImpulseLoad load{experiment_.gravity, {}, {}};
  const BodySpec& body = experiment_.robots[index_].base;
  for (const std::size_t k : inputs_.forces_of[index_]) {
    const ForceInput& force = inputs_.forces[k];
    load.force += force.force;
    load.torque += force.torque;
    load.torque +=
        cross(rotate(motion_.orientation, force.point - body.mass.center_of_mass), force.force);
  }
  return load;
}

template <class Self, class Archive>
void ImpulseBody::exchange(Self& self, Archive& archive) {
  archive(self.motion_.position);
  archive(self.motion_.orientation);
  archive(self.motion_.velocity);
  archive(self.motion_.angular_velocity);
  archive(self.result_.impulse);
  archive(self.result_.contacts);
}

std::size_t ImpulseBody::state_size() const {
  StateCount count;
  exchange(*this, count);
  return count.count();
}

std::string ImpulseBody::state_layout() const {
  return "position[3] orientation[4] velocity[3] angular_velocity[3] impulse[3] contacts";
}

void ImpulseBody::save(std::span<double> numbers, std::span<const BodyState> /*bodies*/) const {
  StateSaver saver(numbers);
  exchange(*this, saver);
}

void ImpulseBody::restore(std::span<const double> numbers, std::span<BodyState> /*bodies*/) {
  StateRestorer restorer(numbers);
  exchange(*this, restorer);
}

}  // namespace hookpoint::simulation
