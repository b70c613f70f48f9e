// One impact of a random robot, at one or several random points of its bodies: what the recursion
// makes of it against the dense mass matrix, and what no impact may do.
#include <gtest/gtest.h>

#include "contact/impulse/impulse.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/dts_engine/impulse_group.h"
#include "simulation/experiment/ground.h"
#include "tests/support/dense_dynamics.h"
#include "tests/support/impulse_scene.h"
#include "tests/support/random_robot.h"

namespace hookpoint {
namespace {

constexpr double kInstant = 1e-14;

struct Struck {
  Vector3d p_BP;
  std::size_t body = 0;
};

/// A robot, a point of it that touches the ground and approaches it, and the robot before and after
/// the impact.
class Impact {
 public:
  Impact(tests::RandomRobots& random, bool mobile, const contact::MaterialConstants<double>& floor)
      : robot_(random.chance(0.5) ? random.robot(mobile, random.integer(1, 4), random.chance(0.3))
                                  : random.tree(mobile, random.integer(1, 4), random.chance(0.3))),
        model_(robot_) {
    dts::State<double> state = random.state(model_);
    const int last = static_cast<int>(model_.body_count()) - 1;
    const std::size_t body = static_cast<std::size_t>(random.integer(mobile ? 0 : 1, last));
    point_ = {random.vector(0.3), body};
    // Lifts the robot until the point touches; turns the motion so that it approaches.
    const tests::DenseDynamics there(robot_, state);
    state.base_position.z -= world(there)[2];
    if ((jacobian(tests::DenseDynamics(robot_, state)) * there.velocity())[2] > 0.) reverse(state);
    experiment_ = testing::impulse_experiment(robot_, state, floor, {}, kInstant);
    testing::points_of(experiment_, body) = {point_.p_BP};
    const auto engine = simulation::make_dts(experiment_);
    status_ = engine->step();
    before_ = state;
    after_ = testing::state_of(engine->state());
    impacts_ = engine->state().impacts;
    const Vector3d force = kInstant * engine->state().bodies[body].contact_force;
    impulse_ = tests::eigen(force);
  }

  Eigen::Vector3d world(const tests::DenseDynamics& dense) const {
    const auto& body = dense.kinematics().bodies()[point_.body];
    return body.p + body.R * tests::eigen(point_.p_BP);
  }
  Eigen::MatrixXd jacobian(const tests::DenseDynamics& dense) const {
    return dense.kinematics().point_jacobian(point_.body, world(dense));
  }

  const dts::RobotDescription& robot() const { return robot_; }
  const dts::State<double>& before() const { return before_; }
  const dts::State<double>& after() const { return after_; }
  const Eigen::Vector3d& impulse() const { return impulse_; }
  const simulation::StepStatus& status() const { return status_; }
  std::uint64_t impacts() const { return impacts_; }

 private:
  static void reverse(dts::State<double>& state) {
    state.base_velocity = -state.base_velocity;
    state.base_angular_velocity = -state.base_angular_velocity;
    for (double& rate : state.joint_rates) rate = -rate;
  }
  dts::RobotDescription robot_;
  dts::Model<double> model_;
  Struck point_;
  simulation::Experiment experiment_;
  dts::State<double> before_, after_;
  Eigen::Vector3d impulse_;
  simulation::StepStatus status_;
  std::uint64_t impacts_ = 0;
};

contact::MaterialConstants<double> floor_of(tests::RandomRobots& random, double u0) {
  contact::MaterialConstants<double> floor;
  floor.kinetic_friction = random.chance(0.2) ? 0. : random.uniform(0., 1.5);
  floor.restitution = random.chance(0.3) ? 0. : random.uniform(0., 1.);
  floor.rebound_speed = u0;
  return floor;
}

template <class Check>
void for_each_impact(std::uint64_t seed, double u0, const Check& check) {
  tests::RandomRobots random(seed);
  for (int k = 0; k < 60; ++k) {
    const contact::MaterialConstants<double> floor = floor_of(random, u0);
    const Impact impact(random, k % 3 != 0, floor);
    ASSERT_TRUE(impact.status().ok()) << k << " " << impact.status().advice;
    SCOPED_TRACE(k);
    check(impact, floor);
  }
}

// M dv = J^T P: the recursion's impulse response, through all of the engine.
TEST(ImpulseRobotImpact, ChangesVelocitiesByMinvJt) {
  for_each_impact(1, 0., [](const Impact& impact, const auto&) {
    const tests::DenseDynamics before(impact.robot(), impact.before());
    const tests::DenseDynamics after(impact.robot(), impact.after());
    const Eigen::MatrixXd J = impact.jacobian(before);
    const Eigen::VectorXd change =
        before.mass_matrix().ldlt().solve(J.transpose() * impact.impulse());
    const Eigen::VectorXd found = after.velocity() - before.velocity();
    EXPECT_LT((found - change).norm(), 1e-9 * (1. + change.norm()));
  });
}

// The law, given the dense collision matrix, would have answered the same.
TEST(ImpulseRobotImpact, IsTheLawsAnswerToTheDenseCollisionMatrix) {
  for_each_impact(2, 0., [](const Impact& impact, const contact::MaterialConstants<double>& floor) {
    if (!impact.robot().mobile) return;  // there K may be singular
    const tests::DenseDynamics dense(impact.robot(), impact.before());
    const Eigen::MatrixXd J = impact.jacobian(dense);
    const Eigen::Matrix3d K = J * dense.mass_matrix().ldlt().solve(J.transpose());
    const Eigen::Vector3d u = J * dense.velocity();
    const contact::Collision expected =
        contact::impulse({K(0, 0), K(1, 1), K(2, 2), K(0, 1), K(0, 2), K(1, 2)}, {u[0], u[1], u[2]},
                         {0., 0., 1.}, floor);
    ASSERT_TRUE(expected.solved);
    const Eigen::Vector3d p = tests::eigen(expected.impulse);
    EXPECT_LT((impact.impulse() - p).norm(), 1e-7 * p.norm());
  });
}

TEST(ImpulseRobotImpact, IsInTheConeSeparatesAndTakesEnergy) {
  for_each_impact(3, 0., [](const Impact& impact, const contact::MaterialConstants<double>& floor) {
    const Eigen::Vector3d& p = impact.impulse();
    EXPECT_GT(impact.impacts(), 0u);
    EXPECT_GE(p[2], 0.);
    EXPECT_LE(std::hypot(p[0], p[1]), floor.kinetic_friction * p[2] + 1e-12 * p[2]);
    const tests::DenseDynamics before(impact.robot(), impact.before());
    const tests::DenseDynamics after(impact.robot(), impact.after());
    EXPECT_LE(after.momentum().kinetic_energy, before.momentum().kinetic_energy * (1. + 1e-8));
    const Eigen::Vector3d u = impact.jacobian(before) * after.velocity();
    EXPECT_GE(u[2], -1e-9);
  });
}

// What the ground gives is all that the whole robot gets: momentum by P, moment of momentum about
// the point by nothing.
TEST(ImpulseRobotImpact, GivesTheRobotItsImpulseAndNoMomentAboutThePoint) {
  for_each_impact(4, 0., [](const Impact& impact, const auto&) {
    if (!impact.robot().mobile) return;  // there the world holds the base
    const tests::DenseDynamics dense(impact.robot(), impact.before());
    const Eigen::Vector3d at = impact.world(dense);
    const tests::DenseMomentum before = dense.momentum();
    const tests::DenseMomentum after =
        tests::DenseDynamics(impact.robot(), impact.after()).momentum();
    const Eigen::Vector3d gained = after.linear - before.linear;
    const double size = impact.impulse().norm();
    EXPECT_LT((gained - impact.impulse()).norm(), 1e-9 * (1. + size));
    const Eigen::Vector3d moment = after.angular - before.angular - at.cross(gained);
    EXPECT_LT(moment.norm(), 1e-9 * (1. + size));
  });
}

TEST(ImpulseRobotImpact, MicrocollisionsLeaveAtTheReboundSpeed) {
  tests::RandomRobots random(5);
  for (int k = 0; k < 40; ++k) {
    contact::MaterialConstants<double> floor = floor_of(random, 20.);  // above every approach
    floor.restitution = 0.;
    const Impact impact(random, true, floor);
    ASSERT_TRUE(impact.status().ok());
    const tests::DenseDynamics before(impact.robot(), impact.before());
    const tests::DenseDynamics after(impact.robot(), impact.after());
    EXPECT_NEAR((impact.jacobian(before) * after.velocity())[2], 20., 1e-6);
  }
}

// Tumbling robots in flights long enough to turn in, which hit the ground again and again with any
// of their points: none comes inside, and linear momentum changes by what is reported and gravity.
// (Flights of 0.02 rad keep it to 2e-8 kg m/s a step.)
TEST(ImpulseRobotImpact, ThrownRobotsStayOutOfTheGroundAndGetWhatIsReported) {
  tests::RandomRobots random(6);
  const Vector3d gravity{0., 0., -9.81};
  const double dt = 4e-3;
  for (int k = 0; k < 8; ++k) {
    const dts::RobotDescription robot = random.robot(true, 2, false, 0.);
    dts::State<double> state = random.state(dts::Model<double>(robot));
    state.base_position.z = 3.;
    state.base_velocity.z = -2.;
    contact::MaterialConstants<double> floor = floor_of(random, 1e-2);
    floor.restitution = 0.5;
    simulation::Experiment experiment =
        testing::impulse_experiment(robot, state, floor, gravity, dt);
    std::size_t bodies = 1;
    double mass = robot.base.mass;
    for (const dts::ChainDescription& chain : robot.chains) {
      bodies += chain.links.size();
      for (const dts::LinkDescription& link : chain.links) mass += link.mass.mass;
    }
    for (std::size_t body = 0; body < bodies; ++body)
      testing::points_of(experiment, body) = {random.vector(0.4), random.vector(0.4)};
    const simulation::WorldInputs inputs = simulation::initial_inputs(experiment);
    const auto level = simulation::make_ground(experiment);
    simulation::ImpulseGroup thrown(experiment, {0, 1}, contact::ImpulseLaw::impulse, &*level,
                                    inputs);
    const auto ground = [&](const Vector3d& point) {
      return contact::GroundPoint{point.z, {0., 0., 1.}, &floor};
    };
    std::vector<simulation::BodyState> published(bodies);
    std::vector<simulation::JointState> joints(bodies - 1);
    Eigen::Vector3d momentum =
        tests::DenseDynamics(robot, thrown.robots()[0].state()).momentum().linear;
    std::int64_t impacts = 0;
    for (int step = 0; step < 250; ++step) {
      const contact::ImpulseTally tally = thrown.advance(ground);
      ASSERT_EQ(tally.status, contact::AdvanceStatus::ok);
      EXPECT_LE(tally.deepest, 1e-10);
      impacts += tally.impacts;
      thrown.publish(published, joints);
      Vector3d gained = dt * mass * gravity;
      for (const simulation::BodyState& body : published) gained += dt * body.contact_force;
      const Eigen::Vector3d after =
          tests::DenseDynamics(robot, thrown.robots()[0].state()).momentum().linear;
      EXPECT_LT((after - momentum - tests::eigen(gained)).norm(), 5e-8) << k << " " << step;
      momentum = after;
    }
    EXPECT_GT(impacts, 2);
  }
}

}  // namespace
}  // namespace hookpoint
