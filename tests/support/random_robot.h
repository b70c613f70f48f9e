// Robots and states drawn at random, degenerate geometry (parallel, intersecting, coincident axes)
// included.
#pragma once

#include <numbers>
#include <random>

#include "dts/configuration.h"
#include "tests/support/dense_dynamics.h"
#include "tests/support/drawn.h"

namespace hookpoint::tests {

class RandomRobots {
 public:
  explicit RandomRobots(std::uint64_t seed) : engine_(seed), rotors_(seed + 1) {}

  double uniform(double low, double high) { return test_support::drawn(engine_, low, high); }
  int integer(int low, int high) { return int(std::floor(uniform(low, high + 1.))); }
  bool chance(double probability) { return uniform(0., 1.) < probability; }

  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Quaterniond orientation() { return exponential(vector(2.)); }

  /// Mass and the inertia of a random solid: R diag R^T with principal moments that obey the
  /// triangle inequality.
  dts::MassProperties<double> mass_properties() {
    const double x = uniform(0.01, 0.2), y = uniform(0.01, 0.2), z = uniform(0.01, 0.2);
    const double mass = uniform(0.3, 2.);
    return {mass, vector(0.2),
            rotate(rotation_matrix(orientation()),
                   Symmetric3d{mass * (y + z), mass * (x + z), mass * (x + y), 0., 0., 0.})};
  }

  dts::LinkDescription link(bool degenerate, double prismatic) {
    dts::LinkDescription link;
    const double right_angle = std::numbers::pi / 2.;
    link.alpha = uniform(-3., 3.);
    if (degenerate) link.alpha = right_angle * integer(-1, 2);
    link.a = degenerate && chance(0.5) ? 0. : uniform(-0.5, 0.5);
    link.d = degenerate && chance(0.5) ? 0. : uniform(-0.5, 0.5);
    link.theta = degenerate && chance(0.5) ? 0. : uniform(-3., 3.);
    link.joint = chance(prismatic) ? dts::JointType::prismatic : dts::JointType::revolute;
    link.mass = mass_properties();
    if (chance(0.3)) place(link, degenerate);
    // Drawn apart: robots are otherwise the same with rotors and without.
    if (test_support::drawn(rotors_, 0., 1.) < 0.3)
      link.rotor_inertia = test_support::drawn(rotors_, 0., 0.5);
    return link;
  }

  dts::RobotDescription robot(bool mobile, int chains, bool degenerate, double prismatic = 0.3) {
    dts::RobotDescription robot;
    robot.mobile = mobile;
    robot.base = mass_properties();
    for (int k = 0; k < chains; ++k) {
      dts::ChainDescription chain;
      chain.hip_position = vector(0.5);
      if (!degenerate) chain.hip_orientation = orientation();
      for (int n = integer(1, 6); n > 0; --n) chain.links.push_back(link(degenerate, prismatic));
      robot.chains.push_back(chain);
    }
    return robot;
  }

  /// The same with chains on links: each after the first hangs on any body before it.
  dts::RobotDescription tree(bool mobile, int chains, bool degenerate, double prismatic = 0.3) {
    dts::RobotDescription robot = this->robot(mobile, chains, degenerate, prismatic);
    std::size_t bodies = 1;
    for (dts::ChainDescription& chain : robot.chains) {
      chain.carrier = std::size_t(integer(0, int(bodies) - 1));
      bodies += chain.links.size();
    }
    return robot;
  }

  dts::State<double> state(const dts::Model<double>& model) {
    dts::State<double> state = dts::zero_state(model);
    state.base_position = vector(2.);
    state.base_orientation = orientation();
    if (model.mobile()) {
      state.base_velocity = vector(2.);
      state.base_angular_velocity = vector(3.);
    }
    for (double& q : state.joint_positions) q = uniform(-1.5, 1.5);
    for (double& rate : state.joint_rates) rate = uniform(-3., 3.);
    return state;
  }

  std::vector<double> numbers(std::size_t count, double size) {
    std::vector<double> result(count);
    for (double& x : result) x = uniform(-size, size);
    return result;
  }

 private:
  /// Gives the link a fixed transform: any, or a small turn after which axes are near-parallel.
  void place(dts::LinkDescription& link, bool degenerate) {
    link.joint_position = vector(0.5);
    if (degenerate) link.alpha = 0.;
    link.joint_orientation = degenerate ? exponential(vector(1e-6)) : orientation();
  }

  std::mt19937_64 engine_, rotors_;
};

}  // namespace hookpoint::tests
