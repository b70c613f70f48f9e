// Bodies of the peers in free motion and rolling: conservation laws, closed forms, independence of
// the frame.
#include <gtest/gtest.h>

#include "reference/engines.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

/// The block in space, tumbling about all three axes.
simulation::Experiment tumbling(double deltat) {
  simulation::Experiment experiment = empty_world(0.5, deltat, "default");
  experiment.robots.push_back(block());
  experiment.robots[0].base.mass.inertia = {0.002, 0.004, 0.005, 0., 0., 0.};
  experiment.robots[0].angular_velocity = {2., -1., 3.};
  return experiment;
}

double kinetic_energy(const simulation::BodyState& body, const simulation::MassSpec& mass) {
  const Vector3d w = rotate(conjugate(body.orientation), body.angular_velocity);
  return 0.5 * mass.mass * dot(body.velocity, body.velocity) + 0.5 * dot(w, mass.inertia * w);
}

TEST(PeerMotion, FallsFreely) {
  for (const auto& peer : reference::peers()) {
    const double deltat = 1e-3, t = 1.;
    simulation::Experiment experiment = tumbling(deltat);
    experiment.robots[0].velocity = {1., 2., 3.};
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(run_until(*engine, deltat, t));
    const auto& body = engine->state().bodies[0];
    EXPECT_NEAR(body.position.x, 1., 1e-12) << peer.name;
    EXPECT_NEAR(body.position.y, 2., 1e-12) << peer.name;
    EXPECT_NEAR(body.position.z, 3. * t - 0.5 * g * t * t, 0.501 * g * t * deltat) << peer.name;
    EXPECT_NEAR(body.velocity.z, 3. - g * t, 1e-12) << peer.name;
    EXPECT_EQ(body.contacts, 0);
    EXPECT_DOUBLE_EQ(engine->state().time, t);
  }
}

TEST(PeerMotion, KeepsTheEnergyOfFreeFlightToFirstOrder) {
  for (const auto& peer : reference::peers()) {
    const auto relative_error = [&peer](double deltat) {
      simulation::Experiment experiment = tumbling(deltat);
      experiment.gravity = {};
      experiment.robots[0].velocity = {1., 2., 3.};
      const auto engine = peer.make(experiment);
      const auto& mass = experiment.robots[0].base.mass;
      const double before = kinetic_energy(engine->state().bodies[0], mass);
      EXPECT_TRUE(run_until(*engine, deltat, 1.));
      return std::abs(kinetic_energy(engine->state().bodies[0], mass) / before - 1.);
    };
    const double coarse = relative_error(2e-3), fine = relative_error(1e-3);
    EXPECT_LT(fine, 1e-4) << peer.name;
    EXPECT_LT(fine, 0.6 * coarse + 1e-12) << peer.name;
  }
}

TEST(PeerMotion, TurnsAboutTheCentreOfMassNotTheOrigin) {
  for (const auto& peer : reference::peers()) {
    const double deltat = 1e-3, rate = 2.;
    const Vector3d com{0.1, 0.05, -0.02};
    simulation::Experiment experiment = tumbling(deltat);
    experiment.gravity = {};
    simulation::RobotSpec& robot = experiment.robots[0];
    robot.base.mass.center_of_mass = com;
    robot.angular_velocity = {0., 0., rate};
    robot.velocity = -cross(robot.angular_velocity, com);  // the centre of mass stands still
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(run_until(*engine, deltat, 1.));
    const auto& body = engine->state().bodies[0];
    const Quaterniond turned = exponential(Vector3d{0., 0., rate});
    const Vector3d expected = com - rotate(turned, com);
    const Vector3d velocity = cross(robot.angular_velocity, -rotate(turned, com));
    EXPECT_NEAR(norm(body.position - expected), 0., 1e-6) << peer.name;
    EXPECT_NEAR(norm(body.velocity - velocity), 0., 1e-6) << peer.name;
  }
}

TEST(PeerMotion, DoesNotDependOnTheFrameOfTheInertia) {
  for (const auto& peer : reference::peers()) {
    const double deltat = 1e-3;
    const auto principal = peer.make(tumbling(deltat));
    // The same body described in axes turned by R_PB: orientation R_WP R_PB, inertia R_BP I R_PB.
    simulation::Experiment experiment = tumbling(deltat);
    const Quaterniond q_PB = exponential(Vector3d{0.4, -0.7, 0.2});
    simulation::RobotSpec& robot = experiment.robots[0];
    robot.orientation = q_PB;
    robot.base.mass.inertia = rotate(transpose(rotation_matrix(q_PB)), robot.base.mass.inertia);
    const auto turned = peer.make(experiment);
    ASSERT_TRUE(run_until(*principal, deltat, 1.) && run_until(*turned, deltat, 1.));
    const auto& a = principal->state().bodies[0];
    const auto& b = turned->state().bodies[0];
    // Simbody's steps are of a length that its errors, so the axes, decide.
    const double tolerance = peer.name == "simbody" ? 1e-6 : 1e-9;
    EXPECT_NEAR(norm(a.angular_velocity - b.angular_velocity), 0., tolerance) << peer.name;
    const Vector3d x{1., 0., 0.};
    EXPECT_NEAR(norm(rotate(a.orientation * q_PB, x) - rotate(b.orientation, x)), 0., tolerance)
        << peer.name;
  }
}

TEST(PeerMotion, FollowsAForceOnAPoint) {
  for (const auto& peer : reference::peers()) {
    const double deltat = 1e-4;
    simulation::Experiment experiment = tumbling(deltat);
    experiment.gravity = {};
    experiment.robots[0].angular_velocity = {};
    experiment.robots[0].base.mass.center_of_mass = {0.1, 0., 0.};
    simulation::ForceSpec force;
    force.point = {0.1, 0.2, 0.};
    force.force = {3., 0., 0.};
    force.torque = {0., 0.1, 0.};
    experiment.forces.push_back(force);
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(engine->step().ok());
    const auto& body = engine->state().bodies[0];
    const Vector3d angular = deltat * Vector3d{0., 0.1 / 0.004, -0.2 * 3. / 0.005};
    const Vector3d linear = deltat * Vector3d{3., 0., 0.} - cross(angular, Vector3d{0.1, 0., 0.});
    EXPECT_NEAR(norm(body.angular_velocity - angular), 0., 1e-6) << peer.name;
    EXPECT_NEAR(norm(body.velocity - linear), 0., 1e-6) << peer.name;
  }
}

/// A sphere of 1 kg and radius 0.1 m at rest on the ground at the origin.
simulation::Experiment sphere_on(const simulation::TerrainSpec& terrain, double angle) {
  simulation::Experiment experiment = empty_world(0.5, 1e-3, "default");
  experiment.terrain = terrain;
  simulation::RobotSpec robot = block();
  robot.base.shapes[0].geometry = simulation::Sphere{0.1};
  robot.base.mass.inertia = {0.004, 0.004, 0.004, 0., 0., 0.};
  robot.location = 0.1 * slope_axes(angle, 0.).normal;
  experiment.robots.push_back(robot);
  return experiment;
}

double rolling_speed(const reference::Peer& peer, const simulation::TerrainSpec& terrain,
                     double angle) {
  const auto engine = peer.make(sphere_on(terrain, angle));
  EXPECT_TRUE(run_until(*engine, 1e-3, 1.));
  return dot(engine->state().bodies[0].velocity, slope_axes(angle, 0.).downhill);
}

TEST(PeerMotion, RollsASphere) {
  const double angle = 15. * degree, expected = 5. / 7. * g * std::sin(angle);
  simulation::TerrainSpec terrain;
  terrain.surface = simulation::SlopeSpec{angle, 0.};
  for (const auto& peer : reference::peers()) {
    // A regularised friction that rolls a ball slips under it, less than the transition velocity.
    const double slip = peer.name == "simbody" ? 0.01 : 0.;
    EXPECT_NEAR(rolling_speed(peer, terrain, angle), expected, 1e-4 * expected + slip) << peer.name;
  }
}

TEST(PeerMotion, RollsASphereOverTheTilesOfAGrid) {
  const double angle = 15. * degree, expected = 5. / 7. * g * std::sin(angle);
  const simulation::TerrainSpec terrain = tilted_grid(angle);
  for (const auto& peer : reference::peers()) {
    if (refuses(peer, reference::feature::height_field)) continue;
    EXPECT_NEAR(rolling_speed(peer, terrain, angle), expected, 5e-3 * expected) << peer.name;
  }
}

// One cell whose corner (1,1) is raised: the crease runs from (0,0) to (1,1), and a sphere dropped
// on either side of it meets that side's plane, z = y above the diagonal's right and z = x to its
// left.
TEST(PeerMotion, FoldsAGridsCellsAlongTheLanguagesDiagonal) {
  simulation::TerrainSpec terrain;
  terrain.surface = simulation::GridSpec{2, 2, {0., 0., 0., 1.}, 0., 0.};
  for (const auto& peer : reference::peers()) {
    if (refuses(peer, reference::feature::height_field)) continue;
    simulation::Experiment experiment = sphere_on(terrain, 0.);
    simulation::RobotSpec& robot = experiment.robots[0];
    robot.base.shapes[0].geometry = simulation::Sphere{0.02};
    robot.location = {0.7, 0.3, 0.3 + 0.02 * std::numbers::sqrt2 - 1e-4};
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(engine->step().ok() && engine->step().ok());
    const Vector3d force = engine->state().bodies[0].contact_force;
    // MuJoCo finds the nearest points to 1 um (mpr_tolerance), so a normal to sqrt(2 um/r).
    const double off = peer.name == "mujoco" ? std::sqrt(2e-6 / 0.02) : 0.;
    EXPECT_NEAR(force.x, 0., 1e-9 + off * norm(force)) << peer.name;
    EXPECT_LT(force.y, -0.1) << peer.name;  // of the plane z = y, whose normal leans to -y
    EXPECT_GT(force.z, 0.1) << peer.name;
  }
}

}  // namespace
}  // namespace hookpoint
