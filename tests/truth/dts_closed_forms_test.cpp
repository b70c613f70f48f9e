// Motions with known solutions: pendulums, a falling body, conservation in free flight.
#include <gtest/gtest.h>

#include "dts/energy.h"
#include "dts/forward_dynamics.h"
#include "tests/support/random_robot.h"

namespace hookpoint::tests {
namespace {

using dts::Model;
using dts::State;
using dts::Workspace;

constexpr double g = 9.81;
const Vector3d gravity{0., 0., -g};

/// A point mass `mass` at `length` along x of a link that turns about the horizontal -y: q = 0
/// points along world x, and q grows upwards.
dts::LinkDescription bob(double a, double alpha, double mass, double length) {
  dts::LinkDescription link;
  link.a = a;
  link.alpha = alpha;
  link.mass = {mass, {length, 0., 0.}, {}};
  return link;
}
constexpr double quarter = std::numbers::pi / 2.;

dts::RobotDescription arm(const std::vector<dts::LinkDescription>& links) {
  dts::RobotDescription robot;
  robot.chains.push_back({{0.3, -0.2, 0.5}, {}, links});
  return robot;
}

TEST(DtsClosedForms, Pendulum) {
  const double mass = 0.7, length = 0.8;
  const Model<double> model(arm({bob(0., quarter, mass, length)}));
  Workspace<double> workspace(model);
  State<double> state = dts::zero_state(model);
  for (const double q : {-1.2, 0., 0.4, 2.5}) {
    for (const double rate : {0., 1.7}) {
      state.joint_positions[0] = q;
      state.joint_rates[0] = rate;
      const double torque = 0.3;
      dts::forward_dynamics(model, state, gravity, std::vector<double>{torque}, workspace);
      EXPECT_NEAR(workspace.joint_accelerations[0],
                  torque / (mass * length * length) - g / length * std::cos(q), 1e-12);
      EXPECT_NEAR(dts::kinetic_energy(model, workspace), 0.5 * mass * length * length * rate * rate,
                  1e-13);
      EXPECT_NEAR(dts::potential_energy(model, gravity, workspace),
                  mass * g * (0.5 + length * std::sin(q)), 1e-12);
      // The hip carries the weight, the centripetal and the tangential force; alpha = 90 deg maps
      // x, y of the link's plane to world x, z.
      const double ddq = workspace.joint_accelerations[0];
      const double ax = length * (-std::sin(q) * ddq - std::cos(q) * rate * rate);
      const double az = length * (std::cos(q) * ddq - std::sin(q) * rate * rate);
      EXPECT_NEAR(workspace.hip_wrenches[0].force.x, -mass * ax, 1e-12);
      EXPECT_NEAR(workspace.hip_wrenches[0].force.y, 0., 1e-12);
      EXPECT_NEAR(workspace.hip_wrenches[0].force.z, -mass * (az + g), 1e-12);
      EXPECT_NEAR(workspace.hip_wrenches[0].moment.y, torque, 1e-12);
    }
  }
}

/// A motor of inertia I_r turns with the joint: (m l^2 + I_r) q'' = tau - m g l cos q, and the base
/// feels tau - I_r q''. Of a link without mass I_r is all there is.
TEST(DtsClosedForms, PendulumWithARotor) {
  for (const double mass : {0.7, 0.}) {
    const double length = 0.8, rotor = 0.31, torque = 0.3, q = 0.4, rate = 1.7;
    dts::LinkDescription link = bob(0., quarter, mass, length);
    link.rotor_inertia = rotor;
    const Model<double> model(arm({link}));
    Workspace<double> workspace(model);
    State<double> state = dts::zero_state(model);
    state.joint_positions[0] = q;
    state.joint_rates[0] = rate;
    dts::forward_dynamics(model, state, gravity, std::vector<double>{torque}, workspace);
    const double inertia = mass * length * length + rotor;
    const double ddq = (torque - mass * g * length * std::cos(q)) / inertia;
    EXPECT_NEAR(workspace.joint_accelerations[0], ddq, 1e-12);
    EXPECT_NEAR(workspace.hip_wrenches[0].moment.y, torque - rotor * ddq, 1e-12);
    EXPECT_NEAR(dts::kinetic_energy(model, workspace), 0.5 * inertia * rate * rate, 1e-13);
  }
}

// Lagrange: with p = q1 + q2 the absolute angle of the second bob above the horizontal,
//   (m1 + m2) l1^2 dd1 + m2 l1 l2 (cos(q2) ddp - sin(q2) dp^2) + (m1 + m2) g l1 cos q1 = 0
//   m2 l2^2 ddp + m2 l1 l2 (cos(q2) dd1 + sin(q2) d1^2) + m2 g l2 cos p = 0
TEST(DtsClosedForms, DoublePendulum) {
  const double m1 = 0.7, m2 = 1.3, l1 = 0.5, l2 = 0.9;
  const Model<double> model(arm({bob(0., quarter, m1, l1), bob(l1, 0., m2, l2)}));
  Workspace<double> workspace(model);
  State<double> state = dts::zero_state(model);
  RandomRobots random(11);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const double q1 = random.uniform(-3., 3.), q2 = random.uniform(-3., 3.);
    const double d1 = random.uniform(-2., 2.), d2 = random.uniform(-2., 2.);
    state.joint_positions = {q1, q2};
    state.joint_rates = {d1, d2};
    dts::forward_dynamics(model, state, gravity, std::vector<double>{0., 0.}, workspace);
    const double dp = d1 + d2;
    Eigen::Matrix2d A;
    A << (m1 + m2) * l1 * l1, m2 * l1 * l2 * std::cos(q2), m2 * l1 * l2 * std::cos(q2),
        m2 * l2 * l2;
    const Eigen::Vector2d b{
        m2 * l1 * l2 * std::sin(q2) * dp * dp - (m1 + m2) * g * l1 * std::cos(q1),
        -m2 * l1 * l2 * std::sin(q2) * d1 * d1 - m2 * g * l2 * std::cos(q1 + q2)};
    const Eigen::Vector2d truth = A.inverse() * b;
    EXPECT_NEAR(workspace.joint_accelerations[0], truth[0], 1e-9);
    EXPECT_NEAR(workspace.joint_accelerations[0] + workspace.joint_accelerations[1], truth[1],
                1e-9);
  }
}

TEST(DtsClosedForms, SlidingJointUnderGravity) {
  dts::LinkDescription slider;
  slider.alpha = 0.4;  // z tilted by 0.4 rad from the vertical
  slider.joint = dts::JointType::prismatic;
  slider.mass = {2., {0.1, 0.2, 0.3}, {0.1, 0.2, 0.25, 0., 0., 0.}};
  const Model<double> model(arm({slider}));
  Workspace<double> workspace(model);
  State<double> state = dts::zero_state(model);
  state.joint_rates[0] = 3.;
  dts::forward_dynamics(model, state, gravity, std::vector<double>{5.}, workspace);
  EXPECT_NEAR(workspace.joint_accelerations[0], 5. / 2. - g * std::cos(0.4), 1e-12);
  EXPECT_NEAR(dts::kinetic_energy(model, workspace), 9., 1e-12);
}

TEST(DtsClosedForms, FreeFallOfABodyWithoutLegs) {
  dts::RobotDescription robot;
  robot.mobile = true;
  robot.base = {2., {}, {0.1, 0.2, 0.25, 0., 0., 0.}};
  const Model<double> model(robot);
  Workspace<double> workspace(model);
  State<double> state = dts::zero_state(model);
  state.base_angular_velocity = {1., 2., 3.};
  dts::forward_dynamics(model, state, gravity, {}, workspace);
  EXPECT_NEAR(norm(workspace.base_acceleration - gravity), 0., 1e-14);
  // Euler: Ixx dwx = (Iyy - Izz) wy wz, and cyclically.
  EXPECT_NEAR(workspace.base_angular_acceleration.x, (0.2 - 0.25) * 6. / 0.1, 1e-12);
  EXPECT_NEAR(workspace.base_angular_acceleration.y, (0.25 - 0.1) * 3. / 0.2, 1e-12);
  EXPECT_NEAR(workspace.base_angular_acceleration.z, (0.1 - 0.2) * 2. / 0.25, 1e-12);
}

/// Free flight by the explicit midpoint rule, of second order.
struct Flight {
  const Model<double>& model;
  State<double> state;
  Workspace<double> workspace{model};

  void step(double dt) {
    const std::size_t n = dts::velocity_count(model);
    std::vector<double> velocity(n), acceleration(n), middle(n);
    const std::vector<double> torques(model.link_count());
    const auto evaluate = [&](const State<double>& at) {
      dts::forward_dynamics(model, at, {}, torques, workspace);
      dts::get_acceleration(model, workspace, std::span(acceleration));
    };
    evaluate(state);
    dts::get_velocity(model, state, std::span(velocity));
    State<double> half = state;
    dts::retract(model, state, velocity, dt / 2., half);
    for (std::size_t i = 0; i < n; ++i) middle[i] = velocity[i] + dt / 2. * acceleration[i];
    dts::set_velocity(model, middle, half);
    evaluate(half);
    for (std::size_t i = 0; i < n; ++i) velocity[i] += dt * acceleration[i];
    dts::retract(model, state, middle, dt, state);
    dts::set_velocity(model, velocity, state);
    dts::forward_kinematics(model, state, workspace);
  }
};

struct Invariants {
  double energy, linear, angular;
};

/// How far energy and momenta have moved after 0.2 s.
Invariants drift(const Model<double>& model, const State<double>& state, int steps) {
  Flight flight{model, state};
  dts::forward_kinematics(model, state, flight.workspace);
  const double energy = dts::kinetic_energy(model, flight.workspace);
  const Vector3d p = dts::linear_momentum(model, flight.workspace);
  const Vector3d L = dts::angular_momentum(model, flight.workspace);
  for (int i = 0; i < steps; ++i) flight.step(0.2 / steps);
  return {std::abs(dts::kinetic_energy(model, flight.workspace) - energy) / energy,
          norm(dts::linear_momentum(model, flight.workspace) - p) / norm(p),
          norm(dts::angular_momentum(model, flight.workspace) - L) / norm(L)};
}

TEST(DtsClosedForms, FreeFlightConservesMomentumAndEnergyToIntegratorOrder) {
  RandomRobots random(12);
  for (const dts::RobotDescription& robot :
       {random.robot(true, 3, false), random.tree(true, 3, false)}) {
    const Model<double> model(robot);
    const State<double> state = random.state(model);
    const Invariants coarse = drift(model, state, 1000);
    const Invariants fine = drift(model, state, 2000);
    for (const auto& [c, f] :
         {std::pair{coarse.energy, fine.energy}, std::pair{coarse.linear, fine.linear},
          std::pair{coarse.angular, fine.angular}}) {
      EXPECT_LT(f, 1e-4);
      EXPECT_GT(c / f, 3.5);  // second order: 4 (third order of the energy error included)
    }
  }
}

/// The rates of the momenta at one instant, from the accelerations alone: exact, without an
/// integrator.
TEST(DtsClosedForms, MomentumRatesVanishInFreeFlight) {
  RandomRobots random(13);
  const dts::RobotDescription robot = random.tree(true, 6, false);
  const Model<double> model(robot);
  ASSERT_TRUE(model.branches());
  Workspace<double> workspace(model);
  const State<double> state = random.state(model);
  dts::forward_dynamics(model, state, {}, random.numbers(model.link_count(), 3.), workspace);
  const auto momentum_at = [&](double t) {
    State<double> moved = state;
    std::vector<double> velocity(dts::velocity_count(model)), acceleration(velocity.size());
    dts::get_velocity(model, state, std::span(velocity));
    dts::get_acceleration(model, workspace, std::span(acceleration));
    std::vector<double> mean = velocity;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] += 0.5 * t * acceleration[i];
      velocity[i] += t * acceleration[i];
    }
    dts::retract(model, state, mean, t, moved);
    dts::set_velocity(model, velocity, moved);
    Workspace<double> scratch(model);
    dts::forward_kinematics(model, moved, scratch);
    return std::pair{dts::linear_momentum(model, scratch), dts::angular_momentum(model, scratch)};
  };
  const double h = 1e-5;
  const auto [p1, L1] = momentum_at(h);
  const auto [p0, L0] = momentum_at(-h);
  EXPECT_LT(norm(p1 - p0) / (2. * h), 1e-6 * norm(p1));
  EXPECT_LT(norm(L1 - L0) / (2. * h), 1e-6 * norm(L1));
}

}  // namespace
}  // namespace hookpoint::tests
