// Robots with chains for the peers' tests, built without the language.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint::reference_scenes {

/// A mass with nothing on its frame's axes, so that no structure is there by accident.
inline simulation::MassSpec skew_mass(double mass) {
  return {mass,
          {0.03, 0.005, -0.004},
          {1e-3 * mass, 1.6e-3 * mass, 1.8e-3 * mass, 1e-4 * mass, -1.5e-4 * mass, 2e-4 * mass}};
}

/// `chains` legs of `links` links, every third joint prismatic, at angles and rates of their own.
inline simulation::RobotSpec skew_robot(int chains, int links, bool mobile) {
  simulation::RobotSpec robot;
  robot.name = "robot";
  robot.mobile = mobile;
  robot.base.mass = {2., {0.01, -0.02, 0.015}, {0.03, 0.04, 0.05, 0.001, -0.002, 0.003}};
  robot.location = {0.3, -0.2, 1.};
  robot.orientation = exponential(Vector3d{0.3, -0.5, 0.7});
  for (int k = 0; k < chains; ++k) {
    const double turn = 0.7 + 1.1 * k;
    simulation::ChainSpec& leg = robot.chains.emplace_back();
    leg.name = "leg" + std::to_string(k);
    leg.hip_distance = {0.15 * std::cos(turn), 0.12 * std::sin(turn), 0.01};
    leg.hip_orientation = exponential(Vector3d{0.2, -0.1, turn});
    for (int n = 0; n < links; ++n) {
      const double s = double(n + 1) / links;
      simulation::LinkSpec& link = leg.links.emplace_back();
      link.body.name = "link" + std::to_string(n);
      link.a = 0.04 + 0.03 * s;
      link.alpha = 1.3 - 2.1 * s;
      link.d = 0.02 - 0.03 * s;
      link.theta = 0.4 * s;
      if (k == 0 && n == 1) {
        link.joint_location = {0.01, -0.02, 0.005};
        link.joint_orientation = exponential(Vector3d{-0.2, 0.3, 0.1});
      }
      link.joint =
          (k + n) % 3 == 2 ? simulation::JointKind::prismatic : simulation::JointKind::revolute;
      link.angle = link.joint == simulation::JointKind::revolute ? 0.3 - 0.5 * s : 0.02;
      link.body.mass = skew_mass(0.12 + 0.05 * n);
    }
  }
  return robot;
}

/// Two legs, from one link of each of which hangs another: from the midst of the first, from the
/// end of the second.
inline simulation::RobotSpec skew_tree(bool mobile) {
  simulation::RobotSpec robot = skew_robot(4, 4, mobile);
  for (const auto& [chain, leg, link] : {std::array{2u, 0u, 1u}, std::array{3u, 1u, 3u}}) {
    robot.chains[chain].name = "leg" + std::to_string(leg) + ".link" + std::to_string(link) + "." +
                               robot.chains[chain].name;
    robot.chains[chain].carrier = 1 + 4 * leg + link;
  }
  return robot;
}

/// Legs on the base, and legs on legs.
inline std::vector<simulation::RobotSpec> skew_robots(bool mobile) {
  return {skew_robot(3, 4, mobile), skew_tree(mobile)};
}

/// Sets every joint in motion, and a mobile base too.
inline void set_in_motion(simulation::RobotSpec& robot) {
  robot.velocity = {0.4, -0.3, 0.2};
  robot.angular_velocity = {1., -0.7, 0.5};
  double rate = 1.;
  for (simulation::ChainSpec& chain : robot.chains)
    for (simulation::LinkSpec& link : chain.links) {
      rate = -0.9 * rate + 0.3;
      link.rate = link.joint == simulation::JointKind::revolute ? rate : 0.1 * rate;
    }
}

/// That robot alone in the world, with a torque on every joint.
inline simulation::Experiment robot_world(const simulation::RobotSpec& robot, double deltat) {
  simulation::Experiment experiment = empty_world(0.5, deltat, "default");
  experiment.robots.push_back(robot);
  double torque = 0.5;
  for (simulation::ChainSpec& chain : experiment.robots[0].chains)
    for (simulation::LinkSpec& link : chain.links) link.torque = torque = 0.4 - torque;
  return experiment;
}

/// Largest relative difference of accelerations in the first step: of every joint, and of the
/// base's turning.
inline double acceleration_error(simulation::EngineFactory make,
                                 const simulation::Experiment& experiment) {
  const auto ours = simulation::make_dts(experiment), theirs = make(experiment);
  const Vector3d before = ours->state().bodies[0].angular_velocity;
  EXPECT_TRUE(ours->step().ok() && theirs->step().ok());
  double largest = 0., error = 0.;
  for (std::size_t i = 0; i < ours->state().joints.size(); ++i) {
    const double expected = ours->state().joints[i].acceleration;
    largest = std::max(largest, std::abs(expected));
    error = std::max(error, std::abs(theirs->state().joints[i].acceleration - expected));
  }
  const Vector3d& a = ours->state().bodies[0].angular_velocity;
  const Vector3d& b = theirs->state().bodies[0].angular_velocity;
  const double per_second = 1. / experiment.deltat;
  largest = std::max(largest, per_second * norm(a - before));
  error = std::max(error, per_second * norm(a - b));
  return error / largest;
}

/// From rest the first step of any engine is deltat times the accelerations, whatever deltat: mass
/// matrix, gravity and torques. ODE's joints have CFM 1e-10/deltat beside inverse inertias of some
/// 1000, so deltat is 1 s; all forces are 1e-9 of their own, so that the geometry stays.
inline simulation::Experiment at_rest(const simulation::RobotSpec& robot) {
  constexpr double scale = 1e-9;
  simulation::Experiment experiment = robot_world(robot, 1.);
  experiment.gravity = scale * experiment.gravity;
  for (simulation::ChainSpec& chain : experiment.robots[0].chains)
    for (simulation::LinkSpec& link : chain.links) link.torque *= scale;
  return experiment;
}

}  // namespace hookpoint::reference_scenes
