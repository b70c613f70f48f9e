// Impacts of articulated robots against what is solved by hand: hinged rods, pendulums, robots
// whose chains have nothing to do; and the flight between impacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/dts_engine/impulse_group.h"
#include "simulation/experiment/ground.h"
#include "tests/support/impulse_scene.h"
#include "tests/support/random_robot.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

using simulation::Experiment;
using testing::impulse_experiment;
using testing::points_of;

constexpr double kPi = std::numbers::pi;
const Vector3d kGravity{0., 0., -9.81};
const Vector3d kNoGravity{};

/// Turns z to the world's y: a revolute joint about z then swings in the world's xz plane.
Quaterniond z_to_y() { return exponential(Vector3d{-kPi / 2., 0., 0.}); }

/// Slender rod along x, its middle at `middle`.
dts::MassProperties<double> rod(double mass, double length, double middle) {
  const double I = mass * length * length / 12.;
  return {mass, {middle, 0., 0.}, {1e-3 * I, I, I, 0., 0., 0.}};
}

dts::LinkDescription link(const dts::MassProperties<double>& mass, double a = 0.) {
  dts::LinkDescription description;
  description.a = a;
  description.mass = mass;
  return description;
}

dts::State<double> at_rest(const dts::RobotDescription& robot) {
  return dts::zero_state(dts::Model<double>(robot));
}

contact::MaterialConstants<double> material(double e, double mu, double u0 = 0.) {
  contact::MaterialConstants<double> constants;
  constants.restitution = e;
  constants.kinetic_friction = mu;
  constants.rebound_speed = u0;
  return constants;
}

/// One step so short that only what touches is hit.
simulation::WorldState struck(const Experiment& experiment) {
  const auto engine = simulation::make_dts(experiment);
  const simulation::StepStatus status = engine->step();
  EXPECT_TRUE(status.ok()) << status.advice;
  return engine->state();
}
constexpr double kInstant = 1e-13;

// Two rods AB, BC, hinged at B, mass m and half length a each, fall flat; A strikes. With P at A:
//   v_B = -P/m, v_A = 7 P/(2 m), v_C = P/(2 m): both outer ends rise, AB turns at 9 P/(4 m a), BC
// the other way at 3 P/(4 m a) (momentum of both, of each about B), and P = (1 + e) V 2 m/7.
TEST(ImpulseRobot, TwoHingedRodsOfWhichOneEndStrikes) {
  const double m = 0.7, a = 0.4, V = 1.3;
  dts::RobotDescription robot{true, rod(m, 2. * a, -a), {}};
  robot.chains.push_back({{}, z_to_y(), {link(rod(m, 2. * a, a))}});
  for (const double e : {0., 0.5, 1.}) {
    dts::State<double> state = at_rest(robot);
    state.base_velocity = {0., 0., -V};
    Experiment experiment =
        impulse_experiment(robot, state, material(e, 0.3), kNoGravity, kInstant);
    points_of(experiment, 0) = {{-2. * a, 0., 0.}};
    const simulation::WorldState after = struck(experiment);
    const double P = (1. + e) * V * 2. * m / 7.;
    EXPECT_NEAR(after.bodies[0].contact_force.z * kInstant, P, 1e-9);
    EXPECT_NEAR(after.bodies[0].velocity.z, -V - P / m, 1e-9);
    // About the world's y: positive turns -x up.
    EXPECT_NEAR(after.bodies[0].angular_velocity.y, 9. * P / (4. * m * a), 1e-8);
    EXPECT_NEAR(after.bodies[1].angular_velocity.y, -3. * P / (4. * m * a), 1e-8);
  }
}

// A rod that falls at an angle, and at its middle a hinge with a wheel that cannot feel the rod
// turn: P = (1 + e) V/(1/M + x^2/I), the rod turns at x P/I and the wheel does not.
TEST(ImpulseRobot, AnInclinedRodTurnsAndTheWheelOnItsHingeDoesNot) {
  const double m = 0.8, m_wheel = 0.5, l = 1.2, V = 2., e = 0.6, theta = 0.5;
  dts::RobotDescription robot{true, rod(m, l, 0.), {}};
  robot.chains.push_back({{}, z_to_y(), {link({m_wheel, {}, {0.02, 0.02, 0.03, 0., 0., 0.}})}});
  dts::State<double> state = at_rest(robot);
  state.base_orientation = exponential(Vector3d{0., theta, 0.});  // +x end down
  state.base_velocity = {0., 0., -V};
  const double x = 0.5 * l * std::cos(theta);
  state.base_position = {0., 0., 0.5 * l * std::sin(theta)};
  Experiment experiment = impulse_experiment(robot, state, material(e, 0.), kNoGravity, kInstant);
  points_of(experiment, 0) = {{0.5 * l, 0., 0.}};
  const simulation::WorldState after = struck(experiment);
  const double M = m + m_wheel, I = m * l * l / 12.;
  const double P = (1. + e) * V / (1. / M + x * x / I);
  EXPECT_NEAR(after.bodies[0].velocity.z, -V + P / M, 1e-9);
  EXPECT_NEAR(after.bodies[0].angular_velocity.y, -x * P / I, 1e-8);
  EXPECT_NEAR(after.bodies[1].angular_velocity.y, 0., 1e-8);
}

// A pendulum on a fixed base: its tip can move along one line only, u = l w (t, n), so K has rank
// 1. Friction helps compression and hinders restitution: with tau = |t/n|,
//   w' = -e w sqrt((1 - mu tau)/(1 + mu tau));
// where mu tau >= 1 friction wedges it, and restitution goes without: w' = -e w/sqrt(1 + mu tau).
TEST(ImpulseRobot, APendulumStrikesAndFrictionTakesItsShare) {
  const double m = 1.1, l = 0.5, w = 3.;
  dts::RobotDescription robot;
  robot.chains.push_back({{}, z_to_y(), {link(rod(m, l, 0.5 * l))}});
  for (const double below : {0.3, 0.6, 1.2}) {  // angle of the rod below the horizontal
    for (const double mu : {0., 0.2, 0.5}) {
      const double e = 0.7, tau = std::tan(below);
      dts::State<double> state = at_rest(robot);
      state.base_position = {0., 0., l * std::sin(below)};
      state.joint_positions = {below};
      state.joint_rates = {w};
      Experiment experiment =
          impulse_experiment(robot, state, material(e, mu), kNoGravity, kInstant);
      points_of(experiment, 1) = {{l, 0., 0.}};
      const simulation::WorldState after = struck(experiment);
      const double expected = mu * tau < 1. ? -e * w * std::sqrt((1. - mu * tau) / (1. + mu * tau))
                                            : -e * w / std::sqrt(1. + mu * tau);
      EXPECT_NEAR(after.joints[0].rate, expected, 1e-8 * w) << below << " " << mu;
      // Wedged or not, the ground gives no more than what stops and turns the rod.
      EXPECT_LT(norm(after.bodies[1].contact_force) * kInstant, 2. * m * l * w);
    }
  }
}

// A stiff arm of two links whose tip strikes at a right angle to both: K_nn from the 2 x 2 mass
// matrix of the double pendulum, M = [A + B + 2 C, B + C; B + C, B] at the elbow's angle 0 with A =
// I1 + m2 l1^2, B = I2, C = m2 l1 l2/2 about the joints, and J = (l1 + l2, l2).
TEST(ImpulseRobot, ADoublePendulumStretchedOutStrikesWithItsTip) {
  const double m1 = 0.9, m2 = 0.4, l1 = 0.5, l2 = 0.3, w1 = 1.5, w2 = -0.4, e = 0.3;
  dts::RobotDescription robot;
  robot.chains.push_back(
      {{}, z_to_y(), {link(rod(m1, l1, 0.5 * l1)), link(rod(m2, l2, 0.5 * l2), l1)}});
  dts::State<double> state = at_rest(robot);
  state.joint_rates = {w1, w2};
  Experiment experiment = impulse_experiment(robot, state, material(e, 0.4), kNoGravity, kInstant);
  points_of(experiment, 2) = {{l2, 0., 0.}};
  const simulation::WorldState after = struck(experiment);

  const double A = m1 * l1 * l1 / 3. + m2 * l1 * l1, B = m2 * l2 * l2 / 3., C = m2 * l1 * l2 / 2.;
  const double M11 = A + B + 2. * C, M12 = B + C, M22 = B, det = M11 * M22 - M12 * M12;
  const double J1 = l1 + l2, J2 = l2;
  const double r1 = (M22 * J1 - M12 * J2) / det, r2 = (M11 * J2 - M12 * J1) / det;
  const double P = (1. + e) * (J1 * w1 + J2 * w2) / (J1 * r1 + J2 * r2);
  EXPECT_NEAR(after.bodies[2].contact_force.z * kInstant, P, 1e-9);
  EXPECT_NEAR(after.joints[0].rate, w1 - r1 * P, 1e-8);
  EXPECT_NEAR(after.joints[1].rate, w2 - r2 * P, 1e-8);
}

// A base with a wheel on a vertical axle through the point that strikes bounces as a ball does, to
// heights of e^(2n), and the wheel goes on turning.
TEST(ImpulseRobot, BouncesAsASingleBodyWhereTheChainHasNothingToDo) {
  const double e = 0.8, h0 = 1.5, g = 9.81, spin = 4.;
  dts::RobotDescription robot{true, {0.6, {}, {1., 1., 1., 0., 0., 0.}}, {}};
  robot.chains.push_back({{0., 0., 0.1}, {}, {link({0.3, {}, {0.01, 0.02, 0.02, 0., 0., 0.}})}});
  dts::State<double> state = at_rest(robot);
  state.base_position = {0., 0., h0};
  state.joint_rates = {spin};
  const double fall = std::sqrt(2. * h0 / g);
  double impact = fall;
  for (int n = 1; n <= 6; ++n) {
    const double top = impact + std::pow(e, n) * fall;
    // Steps that begin anywhere in the flights.
    const int steps = 37;
    Experiment experiment =
        impulse_experiment(robot, state, material(e, 0.5), kGravity, top / steps);
    points_of(experiment, 0) = {{}};
    const auto engine = simulation::make_dts(experiment);
    for (int step = 0; step < steps; ++step) ASSERT_TRUE(engine->step().ok());
    EXPECT_EQ(engine->state().impacts, static_cast<std::uint64_t>(n));
    EXPECT_NEAR(engine->state().bodies[0].position.z, h0 * std::pow(e, 2 * n), 1e-8);
    EXPECT_NEAR(engine->state().bodies[0].velocity.z, 0., 1e-8);
    EXPECT_NEAR(engine->state().joints[0].rate, spin, 1e-9);
    EXPECT_NEAR(engine->state().joints[0].angle, spin * top, 1e-9);
    impact = top + std::pow(e, n) * fall;
  }
}

// In flight the law has no part: what DTS with RK4 says under torques, springs, a limit and a
// force, to the last digits.
TEST(ImpulseRobot, FliesAsTheForceLawsDoUnderTorquesSpringsLimitsAndForces) {
  tests::RandomRobots random(11);
  for (const bool mobile : {true, false}) {
    const dts::RobotDescription robot = random.tree(mobile, 4, false);
    dts::State<double> state = random.state(dts::Model<double>(robot));
    Experiment experiment = impulse_experiment(robot, state, material(0., 0.5), kGravity, 1e-4);
    experiment.terrain.reset();
    for (simulation::ChainSpec& chain : experiment.robots[0].chains) {
      for (simulation::LinkSpec& each : chain.links) {
        each.stiffness = 20.;
        each.damping = 0.3;
        each.friction = 0.1;
        each.upper_limit = each.angle - 0.1;
      }
    }
    experiment.forces.push_back({"push", 0, 2, {0.1, 0., 0.}, {3., -2., 1.}, {0.1, 0., 0.2}, {}});
    const auto impulses = simulation::make_dts(experiment);
    experiment.contact = "hookpoint";
    experiment.integrator = "rk4";
    const auto forces = simulation::make_dts(experiment);
    for (const auto* engine : {&impulses, &forces}) {
      std::vector<double>& torques = (*engine)->inputs().joint_torques;
      for (std::size_t l = 0; l < torques.size(); ++l)
        torques[l] = 0.2 * static_cast<double>(l % 3);
      for (int step = 0; step < 200; ++step) ASSERT_TRUE((*engine)->step().ok());
    }
    for (std::size_t i = 0; i < impulses->state().bodies.size(); ++i) {
      const simulation::BodyState& a = impulses->state().bodies[i];
      const simulation::BodyState& b = forces->state().bodies[i];
      EXPECT_LT(norm(a.position - b.position), 1e-12);
      EXPECT_LT(norm(a.velocity - b.velocity), 1e-10);
    }
    for (std::size_t l = 0; l < impulses->state().joints.size(); ++l) {
      EXPECT_NEAR(impulses->state().joints[l].angle, forces->state().joints[l].angle, 1e-11);
    }
  }
}

TEST(ImpulseRobot, KeepsMomentumInFlight) {
  tests::RandomRobots random(12);
  for (int k = 0; k < 5; ++k) {
    const dts::RobotDescription robot =
        k < 2 ? random.robot(true, 3, false, 0.) : random.tree(true, 4, false, 0.);
    const dts::Model<double> model(robot);
    const dts::State<double> state = random.state(model);
    Experiment experiment = impulse_experiment(robot, state, material(0., 0.), kNoGravity, 0.01);
    experiment.terrain.reset();
    const auto engine = simulation::make_dts(experiment);
    const auto momentum = [&](const dts::State<double>& at) {
      return tests::DenseDynamics(robot, at).momentum();
    };
    const auto before = momentum(testing::state_of(engine->state()));
    for (int step = 0; step < 20; ++step) ASSERT_TRUE(engine->step().ok());
    const auto after = momentum(testing::state_of(engine->state()));
    EXPECT_LT((after.linear - before.linear).norm(), 1e-7 * before.linear.norm());
    EXPECT_LT((after.angular - before.angular).norm(), 1e-7 * before.angular.norm());
    EXPECT_NEAR(after.kinetic_energy, before.kinetic_energy, 1e-7 * before.kinetic_energy);
  }
}

/// A base of great inertia that touches a slope with its centre of mass, where a wheel turns: it
/// cannot rock, so the closed forms of a point hold.
Experiment point_on_slope(const std::string& law, double theta, double mu, double u0) {
  dts::RobotDescription robot{true, {0.6, {}, {1., 1., 1., 0., 0., 0.}}, {}};
  robot.chains.push_back({{}, z_to_y(), {link({0.3, {}, {0.01, 0.01, 0.02, 0., 0., 0.}})}});
  dts::State<double> state = at_rest(robot);
  state.joint_rates = {2.};
  Experiment experiment =
      impulse_experiment(robot, state, material(0., mu, u0), kGravity, 1e-3, law);
  experiment.terrain->surface = contact::SlopeSurface{theta, 0.};
  points_of(experiment, 0) = {{}};
  return experiment;
}

// docs/contact_impulse.md: `impulse` creeps at u0 tan(theta) whatever the friction, with g
// cos(theta)/(2 u0) impacts a second; `impulse_reversal` stays within a stroke of u0^2 tan/(2 g
// cos).
TEST(ImpulseRobot, CreepsAsAPointWhereTheChainHasNothingToDo) {
  const double theta = 0.25, u0 = 5e-3, duration = 0.5, g = 9.81;
  const double flight = 2. * u0 / (g * std::cos(theta));
  for (const double mu : {1.05 * std::tan(theta), 1.5}) {
    for (const char* law : {"impulse", "impulse_reversal"}) {
      const auto engine = simulation::make_dts(point_on_slope(law, theta, mu, u0));
      for (int step = 0; step < 500; ++step) ASSERT_TRUE(engine->step().ok());
      const Vector3d downhill{std::cos(theta), 0., -std::sin(theta)};
      const double shift = dot(downhill, engine->state().bodies[0].position);
      if (std::string(law) == "impulse") {
        EXPECT_NEAR(shift, u0 * std::tan(theta) * duration, u0 * std::tan(theta) * flight);
        EXPECT_NEAR(static_cast<double>(engine->state().impacts), duration / flight, 1.5);
      } else {
        EXPECT_LT(std::abs(shift), 1.01 * u0 * u0 * std::tan(theta) / (2. * g * std::cos(theta)));
      }
    }
  }
}

/// Downhill displacement of the hexapod's base from 0.4 s to 0.7 s, on impacts at 10 mm/s.
double hexapod_creep(const std::string& law) {
  const double theta = 10. * kPi / 180.;
  const auto engine = simulation::make_dts(testing::load_scene(
      "scenes/sloped_hexapod.hook", {{"rebound_speed", "10 mm/s"}}, {{"world.contact", law}}));
  const Vector3d downhill{std::cos(theta), 0., -std::sin(theta)};
  double settled = 0.;
  for (int step = 0; step < 1400; ++step) {
    const simulation::StepStatus status = engine->step();
    EXPECT_TRUE(status.ok()) << status.advice;
    if (step == 800) settled = dot(downhill, engine->state().bodies[0].position);
  }
  // It stands: its base is where the springs hold it, above its feet.
  const Vector3d base = engine->state().bodies[0].position;
  EXPECT_NEAR(base.z * std::cos(theta) + base.x * std::sin(theta), 0.098, 2e-3);
  return dot(downhill, base) - settled;
}

TEST(ImpulseRobot, AHexapodStandsOnASlopeAndCreepsUnlessItsFeetAreReversed) {
  const double creep = hexapod_creep("impulse");
  EXPECT_GT(creep, 0.3 * 1e-2 * std::tan(10. * kPi / 180.));
  EXPECT_LT(std::abs(hexapod_creep("impulse_reversal")), 0.1 * creep);
}

/// An arm on a fixed base that falls on its elbow and its tip and comes to rest there.
Experiment falling_arm(const std::string& law, double u0) {
  dts::RobotDescription robot;
  robot.chains.push_back(
      {{}, z_to_y(), {link(rod(0.9, 0.5, 0.25)), link(rod(0.4, 0.3, 0.15), 0.5)}});
  dts::State<double> state = at_rest(robot);
  state.base_position = {0., 0., 0.2};
  state.joint_positions = {-0.2, 0.9};
  Experiment experiment =
      impulse_experiment(robot, state, material(0., 0.5, u0), kGravity, 1e-3, law);
  points_of(experiment, 1) = {{0.5, 0., 0.}};
  points_of(experiment, 2) = {{0.3, 0., 0.}};
  return experiment;
}

TEST(ImpulseRobot, AFixedArmFallsOnTheGroundAndStaysThere) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    const double u0 = 5e-3;
    const Experiment experiment = falling_arm(law, u0);
    const auto engine = simulation::make_dts(experiment);
    const auto lowest = [&] {
      const simulation::BodyState& forearm = engine->state().bodies[2];
      return std::min(forearm.position.z,
                      (forearm.position + rotate(forearm.orientation, Vector3d{0.3, 0., 0.})).z);
    };
    for (int step = 0; step < 600; ++step) {
      const simulation::StepStatus status = engine->step();
      ASSERT_TRUE(status.ok()) << law << " " << step << " " << status.advice;
      EXPECT_GE(lowest(), -1e-9);
    }
    EXPECT_LT(lowest(), u0 * u0 / 9.81);
    EXPECT_GT(engine->state().bodies[1].contacts + engine->state().bodies[2].contacts, 0);
    // Bounces at u0 turn the links at some u0 over their lengths.
    for (const simulation::JointState& joint : engine->state().joints)
      EXPECT_LT(std::abs(joint.rate), 10. * u0);
  }
}

TEST(ImpulseRobot, TooManyImpactsIsAStatusAndTheStateIsThatBefore) {
  const Experiment experiment = falling_arm("impulse", 1e-4);
  const simulation::WorldInputs inputs = simulation::initial_inputs(experiment);
  const auto level = simulation::make_ground(experiment);
  simulation::ImpulseGroup robot(experiment, {0, 1}, contact::ImpulseLaw::impulse, &*level, inputs,
                                 {.tolerance = 1e-10, .most_impacts = 20});
  const auto ground = [&](const Vector3d& point) {
    return contact::GroundPoint{point.z, {0., 0., 1.}, &experiment.materials[0].constants};
  };
  dts::State<double> before;
  contact::ImpulseTally tally;
  for (int step = 0; step < 1000 && tally.status == contact::AdvanceStatus::ok; ++step) {
    before = robot.robots()[0].state();
    tally = robot.advance(ground);
    EXPECT_LE(tally.deepest, 1e-10);
  }
  ASSERT_EQ(tally.status, contact::AdvanceStatus::too_many_impacts);
  EXPECT_EQ(robot.robots()[0].state().joint_positions, before.joint_positions);
  EXPECT_EQ(robot.robots()[0].state().joint_rates, before.joint_rates);
}

TEST(ImpulseRobot, EndsAtItsWork) {
  const Experiment experiment = falling_arm("impulse", 5e-3);
  const simulation::WorldInputs inputs = simulation::initial_inputs(experiment);
  const auto level = simulation::make_ground(experiment);
  simulation::ImpulseGroup robot(experiment, {0, 1}, contact::ImpulseLaw::impulse, &*level, inputs,
                                 {.tolerance = 1e-10, .most_work = 60.});
  const auto ground = [&](const Vector3d& point) {
    return contact::GroundPoint{point.z, {0., 0., 1.}, &experiment.materials[0].constants};
  };
  contact::ImpulseTally tally;
  for (int step = 0; step < 1000 && tally.status == contact::AdvanceStatus::ok; ++step)
    tally = robot.advance(ground);
  EXPECT_EQ(tally.status, contact::AdvanceStatus::too_many_impacts);
  EXPECT_LT(tally.impacts, 200);
}

TEST(ImpulseRobot, ARunThatIsSavedGoesOnBitForBit) {
  const Experiment experiment = falling_arm("impulse", 5e-3);
  const auto whole = simulation::make_dts(experiment);
  for (int step = 0; step < 250; ++step) ASSERT_TRUE(whole->step().ok());
  std::vector<double> numbers(whole->resumable()->state_size());
  whole->resumable()->save(numbers);
  const auto resumed = simulation::make_dts(experiment);
  resumed->resumable()->restore(numbers);
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(whole->step().ok());
    ASSERT_TRUE(resumed->step().ok());
  }
  EXPECT_EQ(resumed->state().impacts, whole->state().impacts);
  for (std::size_t i = 0; i < whole->state().bodies.size(); ++i) {
    EXPECT_EQ(resumed->state().bodies[i].position, whole->state().bodies[i].position);
    EXPECT_EQ(resumed->state().bodies[i].velocity, whole->state().bodies[i].velocity);
    EXPECT_EQ(resumed->state().bodies[i].contact_force, whole->state().bodies[i].contact_force);
  }
}

}  // namespace
}  // namespace hookpoint
