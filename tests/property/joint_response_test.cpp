// How joints answer torques in a reference engine's robot, against the mass matrix written out; and
// what drives hold back at their velocity_limit, against the conditions that define it.
#include "reference/joint_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dts/forward_kinematics.h"
#include "dts/planar_base.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/experiment/speed_limits.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

simulation::MassSpec mass_of(const dts::MassProperties<double>& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

/// A drawn robot, fixed, free or in a plane, as both sides have it.
struct Drawn {
  dts::RobotDescription robot;
  dts::Model<double> model;
  dts::State<double> state;
  simulation::RobotSpec spec;
  std::vector<simulation::BodyState> bodies;
  Eigen::MatrixXd M;  ///< of what is free; joints last

  Drawn(RandomRobots& random, int repetition)
      : robot(described(random, repetition)), model(robot), state(random.state(model)) {
    spec.mobile = robot.mobile;
    spec.plane_normal = robot.plane_normal;
    spec.base.mass = mass_of(robot.base);
    for (const dts::ChainDescription& chain : robot.chains) {
      simulation::ChainSpec& copy = spec.chains.emplace_back();
      copy.carrier = chain.carrier;
      for (const dts::LinkDescription& link : chain.links) {
        simulation::LinkSpec& own = copy.links.emplace_back();
        own.body.mass = mass_of(link.mass);
        own.rotor_inertia = link.rotor_inertia;
        own.joint = link.joint == dts::JointType::prismatic ? simulation::JointKind::prismatic
                                                            : simulation::JointKind::revolute;
      }
    }
    dts::Workspace<double> workspace(model);
    dts::forward_kinematics(model, state, workspace);
    for (const dts::BodyMotion<double>& body : workspace.bodies) {
      simulation::BodyState& at = bodies.emplace_back();
      at.position = body.p_WB;
      at.orientation = quaternion_from(body.R_WB);
    }
    const Eigen::MatrixXd whole = DenseDynamics(robot, state).mass_matrix();
    std::vector<int> free;
    for (int k = 0; k < whole.rows(); ++k)
      if (k >= 6 || !robot.plane_normal ||
          !dts::held_in_plane(static_cast<std::size_t>(k), *robot.plane_normal))
        free.push_back(k);
    M = whole(free, free);
  }

  static dts::RobotDescription described(RandomRobots& random, int repetition) {
    dts::RobotDescription robot = random.tree(repetition % 3 != 0, 1 + repetition % 4, false);
    if (repetition % 3 == 1) robot.plane_normal = static_cast<std::size_t>(repetition / 3 % 3);
    return robot;
  }

  std::size_t joints() const { return model.link_count(); }
  Eigen::VectorXd accelerations(std::span<const double> torques) const {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(M.rows());
    for (std::size_t i = 0; i < torques.size(); ++i)
      f(M.rows() - static_cast<int>(torques.size() - i)) = torques[i];
    return M.ldlt().solve(f).tail(static_cast<int>(torques.size()));
  }
};

template <class Check>
void for_drawn_robots(const Check& check) {
  RandomRobots random(1729);
  for (int repetition = 0; repetition < 200; ++repetition) {
    Drawn x(random, repetition);
    check(x, random);
  }
}

TEST(JointResponse, IsThatOfTheMassMatrix) {
  for_drawn_robots([](Drawn& x, RandomRobots& random) {
    reference::JointResponse response(x.spec);
    response.stand_at(x.bodies);
    const std::vector<double> torques = random.numbers(x.joints(), 5.);
    std::vector<double> found(x.joints());
    response.solve(torques, found);
    const Eigen::VectorXd truth = x.accelerations(torques);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], truth(static_cast<int>(i)), 1e-9 * truth.lpNorm<Eigen::Infinity>());
  });
}

// 0 <= x <= 1; s a <= room where x < 1; s a = room where 0 < x < 1; s a <= room anyway where x = 0.
TEST(SpeedLimits, KeepTheirConditionsWithTheLeastHeldBack) {
  constexpr double step = 1e-3;
  int between = 0, all = 0, none = 0;
  for_drawn_robots([&](Drawn& x, RandomRobots& random) {
    std::vector<double> drives = random.numbers(x.joints(), 5.),
                        rates = random.numbers(x.joints(), 1.);
    std::size_t joint = 0;
    for (simulation::ChainSpec& chain : x.spec.chains)
      for (simulation::LinkSpec& link : chain.links) {
        if (random.chance(0.8))
          link.velocity_limit =
              std::max(1e-3, std::abs(rates[joint]) + random.uniform(-0.01, 0.01));
        ++joint;
      }
    simulation::SpeedLimits limits(x.spec, step);
    const Eigen::VectorXd others = x.accelerations(random.numbers(x.joints(), 5.));
    std::vector<double> a(x.joints());
    const auto under = [&](std::span<const double> held_back) -> std::span<const double> {
      std::vector<double> left = drives;
      for (std::size_t i = 0; i < left.size(); ++i) left[i] -= held_back[i];
      const Eigen::VectorXd found = x.accelerations(left) + others;
      for (std::size_t i = 0; i < a.size(); ++i) a[i] = found(static_cast<int>(i));
      return a;
    };
    under(std::vector<double>(x.joints()));
    const std::vector<double> whole = a;
    limits.find(drives, rates, whole, under);
    const std::vector<double> held(limits.held_back().begin(), limits.held_back().end());
    under(held);
    double scale = 0.;
    for (const double value : whole) scale = std::max(scale, std::abs(value));
    simulation::for_each_link(x.spec, [&](const simulation::TreeLink& at) {
      const std::size_t i = at.joint();
      if (!at.link.velocity_limit) {
        EXPECT_EQ(held[i], 0.);
        return;
      }
      const double part = held[i] / drives[i], s = drives[i] > 0. ? 1. : -1.;
      const double beyond = s * a[i] - (*at.link.velocity_limit - s * rates[i]) / step;
      EXPECT_GE(part, 0.);
      EXPECT_LE(part, 1.);
      if (part < 1.) {
        EXPECT_LE(beyond, 1e-8 * scale);
      }
      if (part > 0.) {
        EXPECT_GE(beyond, -1e-8 * scale);
      }
      (part == 0. ? none : part == 1. ? all : between) += 1;
    });
  });
  EXPECT_GT(between, 30);
  EXPECT_GT(all, 10);
  EXPECT_GT(none, 100);
}

}  // namespace
}  // namespace hookpoint::tests
