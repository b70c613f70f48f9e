#include "simulation/dts_engine/work_meter.h"

#include <algorithm>

#include "contact/terrain/rolling.h"

namespace hookpoint::simulation {
namespace {

using dts::BodyMotion;
using dts::Wrench;

/// phi of R_after = exp([phi]x) R_before, at most pi [rad].
Vector3d rotation_vector(const Matrix3d& before, const Matrix3d& after) {
  return contact::rotation_vector(quaternion_from(after * transpose(before)));
}

/// Torques of the joints as if no drive held anything back.
void find_whole_torques(const ArticulatedRobot& robot, std::span<double> torques) {
  robot.joints().torques(robot.drives(), robot.state().joint_positions, robot.state().joint_rates,
                         torques);
}

bool acts(const Wrench<double>& wrench) {
  return !(wrench.force == Vector3d{} && wrench.moment == Vector3d{});
}

}  // namespace

WorkMeter::Quadrature quadrature_of(const integrators::StepperDescription& stepper) {
  return stepper.order == 1 ? WorkMeter::Quadrature::ends : WorkMeter::Quadrature::nodes;
}

WorkMeter::WorkMeter(const ArticulatedRobot& robot, Quadrature quadrature)
    : quadrature_(quadrature),
      bodies_(robot.workspace().bodies),
      external_(robot.workspace().external),
      joint_positions_(robot.model().link_count()),
      joint_torques_(joint_positions_),
      torques_(joint_positions_) {}

void WorkMeter::begin(const ArticulatedRobot& robot) {
  std::ranges::copy(robot.state().joint_positions, joint_positions_.begin());
  if (quadrature_ == Quadrature::nodes) return;
  std::ranges::copy(robot.workspace().bodies, bodies_.begin());
  std::ranges::copy(robot.workspace().external, external_.begin());
  find_whole_torques(robot, joint_torques_);
}

void WorkMeter::add(double weight, const ArticulatedRobot& robot) {
  double power = 0.;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyMotion<double>& body = robot.workspace().bodies[i];
    const Wrench<double>& external = robot.workspace().external[i];
    power += dot(external.force, body.v_WB) + dot(external.moment, body.w_WB);
  }
  robot.find_torques(torques_);
  for (std::size_t i = 0; i < torques_.size(); ++i) {
    const JointProperties& joint = robot.joints().properties()[i];
    const double spring =
        joint.stiffness * (joint.rest_position - robot.state().joint_positions[i]);
    const double rest = torques_[i] - drive_torque(joint, robot.drives()[i]) - spring;
    power += rest * robot.state().joint_rates[i];
  }
  work_ += weight * power;
}

void WorkMeter::end(const ArticulatedRobot& robot) {
  if (quadrature_ == Quadrature::ends) work_ += work_of_bodies(robot);
  work_ += work_of_joints(robot);
}

double WorkMeter::work_of_bodies(const ArticulatedRobot& robot) const {
  double work = 0.;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Wrench<double>&before = external_[i], &now = robot.workspace().external[i];
    if (!acts(before) && !acts(now)) continue;
    const BodyMotion<double>&from = bodies_[i], &to = robot.workspace().bodies[i];
    work += 0.5 * (dot(before.force + now.force, to.p_WB - from.p_WB) +
                   dot(before.moment + now.moment, rotation_vector(from.R_WB, to.R_WB)));
  }
  return work;
}

double WorkMeter::work_of_joints(const ArticulatedRobot& robot) {
  double work = 0.;
  const std::span<const double> positions = robot.state().joint_positions;
  if (quadrature_ == Quadrature::ends) {
    find_whole_torques(robot, torques_);
    // What drives hold back at their velocity_limit they hold back from start to end.
    const std::span<const double> held_back = robot.held_back_torques();
    for (std::size_t i = 0; i < torques_.size(); ++i)
      work += (0.5 * (joint_torques_[i] + torques_[i]) - held_back[i]) *
              (positions[i] - joint_positions_[i]);
    return work;
  }
  for (std::size_t i = 0; i < torques_.size(); ++i) {
    const JointProperties& joint = robot.joints().properties()[i];
    const double middle = 0.5 * (positions[i] + joint_positions_[i]);
    const double spring = joint.stiffness * (joint.rest_position - middle);
    work +=
        (drive_torque(joint, robot.drives()[i]) + spring) * (positions[i] - joint_positions_[i]);
  }
  return work;
}

}  // namespace hookpoint::simulation
