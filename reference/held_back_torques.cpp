#include "reference/held_back_torques.h"

#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {

HeldBackTorques::HeldBackTorques(const simulation::RobotSpec& robot, double step)
    : limits_(robot, step),
      response_(robot),
      rates_(simulation::joint_count(robot)),
      changes_(rates_),
      expected_(rates_),
      accelerations_(rates_) {}

void HeldBackTorques::take(std::span<const double> drives,
                           std::span<const simulation::BodyState> bodies,
                           std::span<const simulation::JointState> joints,
                           std::span<double> torques) {
  if (!limits_.any()) return;
  response_.stand_at(bodies);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    rates_[i] = joints[i].rate;
    changes_[i] = torques[i] - joints[i].torque;
  }
  response_.solve(changes_, expected_);
  for (std::size_t i = 0; i < joints.size(); ++i) expected_[i] += joints[i].acceleration;
  const auto without = [&](std::span<const double> held_back) -> std::span<const double> {
    response_.solve(held_back, accelerations_);
    for (std::size_t i = 0; i < joints.size(); ++i)
      accelerations_[i] = expected_[i] - accelerations_[i];
    return accelerations_;
  };
  if (!limits_.find(drives, rates_, expected_, without)) return;
  for (std::size_t i = 0; i < torques.size(); ++i) torques[i] -= limits_.held_back()[i];
}

}  // namespace hookpoint::reference
