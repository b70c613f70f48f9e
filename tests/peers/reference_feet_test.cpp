// Robots that touch with their points under the peers: standing and walking hexapods, tiles of two
// materials, height fields, and the traps of friction.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/bullet/engine.h"
#include "reference/engines.h"
#include "reference/ode/engine.h"
#include "reference/touching_points.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/folders.h"
#include "tests/support/reference_scenes.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;
constexpr double hexapod_weight = (2. + 6. * (0.1 + 0.15 + 0.12)) * 9.81;  // 41.398 N

/// A scene of configs/, for one engine.
simulation::Experiment scene(const std::string& name, const reference::Peer& peer,
                             const std::string& settings = "default") {
  const auto file = std::filesystem::path(testing::source_folder()) / "configs/scenes" / name;
  const Loaded loaded = load_file(file);
  if (!loaded.experiment) throw std::runtime_error(loaded.diagnostics);
  simulation::Experiment experiment = *loaded.experiment;
  experiment.engine = peer.name;
  experiment.settings = settings;
  return experiment;
}

/// Simbody's friction makes light feet so stiff that its explicit integrator takes some 2 ms a
/// step; docs/reference_engines.md has what it gives.
bool costly(const reference::Peer& peer, std::string_view settings) {
  return peer.name == "simbody" && settings == "default";
}

TEST(StandingHexapod, CarriesItsWeightInEveryEngine) {
  for (const auto& peer : reference::peers())
    for (const char* settings : {"default", "matched"}) {
      if (costly(peer, settings)) continue;
      simulation::Experiment experiment = scene("standing_hexapod.hook", peer, settings);
      experiment.deltat = 1e-3;
      const auto engine = peer.make(experiment);
      ASSERT_TRUE(run_until(*engine, experiment.deltat, 1.)) << peer.name << settings;
      double carried = 0.;
      for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(engine->step().ok());
        for (const simulation::BodyState& body : engine->state().bodies)
          carried += body.contact_force.z / 500.;
      }
      EXPECT_NEAR(carried, hexapod_weight, 1e-3 * hexapod_weight) << peer.name << settings;
      EXPECT_GT(engine->state().bodies[0].position.z, 0.095) << peer.name << settings;
    }
}

// The gait asks for 0.1 m/s; with the same controllers our engine makes 0.08 m/s on soft feet.
TEST(WalkingHexapod, WalksInEveryEngine) {
  for (const auto& peer : reference::peers()) {
    Loaded loaded;
    loaded.experiment =
        scene("walking_hexapod.hook", peer, costly(peer, "default") ? "matched" : "default");
    loaded.experiment->deltat = 1e-3;
    Running run(loaded, peer.make);
    run.step(1000);
    const double start = run["hexapod.base.location.x"];
    run.step(1200);  // two periods of the gait
    EXPECT_NEAR((run["hexapod.base.location.x"] - start) / 1.2, 0.09, 0.02) << peer.name;
    EXPECT_NEAR(run["hexapod.base.location.y"], 0., 0.01) << peer.name;
    EXPECT_NEAR(run["hexapod.base.location.z"], 0.1, 0.01) << peer.name;
  }
}

/// The block of the closed forms on four points in place of a box; with `rotor` a fifth of its mass
/// is a link that turns about its upright axis, so that it is a robot with chains.
simulation::Experiment sledge(double angle, double azimuth, double mu, bool rotor,
                              const std::string& settings = "default") {
  simulation::Experiment experiment = sloped_block(angle, azimuth, mu, 1e-3, settings);
  simulation::RobotSpec& robot = experiment.robots[0];
  robot.base.shapes.clear();
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1}) robot.base.boundary_points.push_back({x, y, -0.05});
  if (!rotor) return experiment;
  robot.base.mass.mass = 0.8;
  simulation::LinkSpec& link = robot.chains.emplace_back().links.emplace_back();
  link.body.mass = {0.2, {}, {1e-3, 1e-3, 1e-3, 0., 0., 0.}};
  return experiment;
}

double speed_after(simulation::Engine& engine, const Vector3d& direction, double time) {
  EXPECT_TRUE(run_until(engine, 1e-3, time));
  return dot(engine.state().bodies[0].velocity, direction);
}

constexpr double angle = 15. * degree;
const double coulomb = g * (std::sin(angle) - 0.2 * std::cos(angle));

TEST(PeerFeet, SlideAtCoulombsAcceleration) {
  const Vector3d downhill = slope_axes(angle, 0.).downhill;
  for (const auto& peer : reference::peers())
    for (const bool rotor : {false, true}) {
      const auto engine = peer.make(sledge(angle, 0., 0.2, rotor));
      // MuJoCo's block hops, some 3 ms at a time, in which it gains g mu cos more.
      // DART's Dantzig fails on four equal loads in the first two steps.
      const double tolerance = peer.name == "mujoco" ? 0.01 : peer.name == "dart" ? 3e-3 : 1e-4;
      EXPECT_NEAR(speed_after(*engine, downhill, 1.), coulomb, tolerance * coulomb)
          << peer.name << rotor;
    }
}

// tan 15 deg = 0.268: a cone of 0.2 slides, ODE's box holds up to 0.2 sqrt(2) along its diagonal.
TEST(PeerFeet, SlideAcrossTheAxesWhereFrictionIsACone) {
  const Vector3d downhill = slope_axes(angle, 45. * degree).downhill;
  for (const bool rotor : {false, true}) {
    const auto speed = [&](simulation::EngineFactory make) {
      const auto engine = make(sledge(angle, 45. * degree, 0.2, rotor));
      return speed_after(*engine, downhill, 1.);
    };
    EXPECT_NEAR(speed(reference::bullet_peer.make), coulomb, 1e-3 * coulomb) << rotor;
    EXPECT_NEAR(speed(reference::ode_peer.make), 0., 1e-8) << rotor;
    EXPECT_NEAR(speed(reference::ode_quickstep_peer.make), 0., 1e-3) << rotor;
  }
}

// Whatever a library does inside: the forces that it tells one by one carry a block at rest, and
// where they act they do not turn it. On 15 deg the weight passes 13 mm downhill of the middle.
// `lower`: how much lower than where it is said to act friction does [m].
void expect_balance(const simulation::Experiment& experiment, simulation::EngineFactory make,
                    const std::string& what, double lower = 0.) {
  const auto engine = make(experiment);
  engine->publish_ground_forces();
  ASSERT_NE(engine->state().ground_force_time, simulation::GroundForceTime::unknown) << what;
  ASSERT_TRUE(run_until(*engine, experiment.deltat, 1.)) << what;
  constexpr int steps = 1000;  // a second: a box on Simbody's Hertz contacts rocks for a while
  Vector3d force, moment;
  for (int i = 0; i < steps; ++i) {
    ASSERT_TRUE(engine->step().ok()) << what;
    for (const simulation::GroundForce& one : engine->state().ground_forces) {
      ASSERT_EQ(one.body, 0u) << what;
      force += (1. / steps) * one.force;
      moment +=
          (1. / steps) * cross(rotate(engine->state().bodies[0].orientation, one.point), one.force);
    }
  }
  EXPECT_NEAR(norm(force - Vector3d{0., 0., g}), 0., 1e-3 * g) << what;
  EXPECT_NEAR(norm(moment), 0., 1e-3 * g * 0.05 + lower * g * std::sin(angle)) << what;
}

TEST(GroundForces, CarryABlockAtRestWithoutTurningIt) {
  for (const auto& peer : reference::peers())
    for (const char* settings : {"default", "matched"}) {
      const std::string what = std::string(peer.name) + " " + settings;
      expect_balance(sloped_block(angle, 0.3, 0.8, 1e-3, settings), peer.make, what + ", box");
      // Simbody has a ball in place of a point.
      expect_balance(sledge(angle, 0.3, 0.8, false, settings), peer.make, what + ", points",
                     peer.name == "simbody" ? reference::point_ball_radius : 0.);
    }
  simulation::Experiment ours = sledge(angle, 0.3, 0.8, false);
  ours.materials[0].constants.normal_damping = ours.materials[0].constants.tangential_damping = 40.;
  expect_balance(ours, simulation::make_dts, "dts");
}

// dWorldStep limits each contact's friction by the load that it would carry without friction: four
// corners of equal load slide with equal friction, though friction itself loads the lower ones
// more.
TEST(OdeFeet, SlideWithTheFrictionOfTheLoadWithoutFriction) {
  simulation::Experiment experiment = sledge(angle, 0., 0.2, false);
  for (int i = 0; i < 4; ++i) experiment.points.push_back({"p", 0, 0, i});
  const auto engine = reference::ode_peer.make(experiment);
  engine->publish_details();
  ASSERT_TRUE(run_until(*engine, 1e-3, 0.5));
  const SlopeAxes axes = slope_axes(angle, 0.);
  const double equal = 0.2 * g * std::cos(angle) / 4.;
  for (int i = 0; i < 4; ++i) {
    const Vector3d& force = engine->state().points[static_cast<std::size_t>(i)].force;
    EXPECT_NEAR(dot(force, axes.downhill), -equal, 1e-4 * equal);
    const double load = g * std::cos(angle) / 4. + (i < 2 ? -1. : 1.) * equal / 2.;
    EXPECT_NEAR(dot(force, axes.normal), load, 1e-3 * load);
  }
}

// f_t of each of four points; the constants are those that the engine was built with.
TEST(OdeFeet, CreepAtMixingTimesTangentialForce) {
  const Vector3d downhill = slope_axes(angle, 0.).downhill;
  const double f_t = g * std::sin(angle) / 4.;
  const auto expect = [&](const reference::Peer& peer, const char* settings) {
    const auto experiment = sledge(angle, 0., 0.5, true, settings);
    const auto engine = peer.make(experiment);
    const double mixing = peer.constraint_constants(experiment).tangential_mixing;
    EXPECT_NEAR(creep_speed(*engine, downhill, 1e-3, 1., 2.), mixing * f_t, 0.01 * mixing * f_t)
        << peer.name << settings;
  };
  expect(reference::ode_peer, "default");
  expect(reference::ode_peer, "matched");
  expect(reference::ode_quickstep_peer, "matched");
}

TEST(BulletFeet, StickAtTheMatchedSetting) {
  const Vector3d downhill = slope_axes(angle, 0.).downhill;
  const auto engine = reference::bullet_peer.make(sledge(angle, 0., 0.5, true, "matched"));
  EXPECT_NEAR(creep_speed(*engine, downhill, 1e-3, 1., 2.), 0., 1e-9);
}

TEST(PeerFeet, HaveTheFrictionOfTheirTile) {
  for (const auto& peer : reference::peers())
    for (const bool rotor : {false, true}) {
      if (refuses(peer, reference::feature::tile_friction)) continue;
      simulation::Experiment experiment = sledge(angle, 0., 0.5, rotor);
      experiment.materials.push_back(experiment.materials[0]);
      experiment.materials[1].constants.static_friction = 0.2;
      experiment.materials[1].constants.kinetic_friction = 0.2;
      experiment.terrain->patches.push_back({-100., 1., 100., 100., 1});
      simulation::RobotSpec slick = experiment.robots[0];
      slick.location.y += 2.5;
      experiment.robots.push_back(slick);
      simulation::RobotSpec box = block();
      box.orientation = slick.orientation;
      box.location = slick.location + Vector3d{0., 2., 0.};
      experiment.robots.push_back(box);
      const auto engine = peer.make(experiment);
      ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
      const auto& bodies = engine->state().bodies;
      const std::size_t each = rotor ? 2 : 1;
      EXPECT_LT(norm(bodies[0].velocity), 1e-3) << peer.name;
      EXPECT_NEAR(norm(bodies[each].velocity), coulomb, 0.02 * coulomb) << peer.name << rotor;
      EXPECT_NEAR(norm(bodies[2 * each].velocity), coulomb, 0.02 * coulomb) << peer.name << rotor;
    }
}

TEST(PeerFeet, SlideOnTheTilesOfAGridAsOnAPlane) {
  const Vector3d downhill = slope_axes(angle, 0.).downhill;
  for (const auto& peer : reference::peers()) {
    if (refuses(peer, reference::feature::height_field)) continue;
    simulation::Experiment experiment = sledge(angle, 0., 0.2, true);
    experiment.terrain = tilted_grid(angle);
    const auto engine = peer.make(experiment);
    EXPECT_NEAR(speed_after(*engine, downhill, 1.), coulomb, 0.01 * coulomb) << peer.name;
  }
}

// A ball about a point rolls as the sphere that it is: 5/7 g sin.
TEST(PeerFeet, RollOnTheirBalls) {
  const SlopeAxes axes = slope_axes(angle, 0.);
  for (const auto& peer : reference::peers()) {
    simulation::Experiment experiment = sledge(angle, 0., 0.5, true);
    simulation::RobotSpec& robot = experiment.robots[0];
    robot.base.boundary_points = {{}};
    robot.base.boundary_radii = {0.1};
    robot.base.mass.inertia = {0.0032, 0.0032, 0.0032, 0., 0., 0.};
    robot.chains[0].hip_orientation = exponential(Vector3d{90. * degree, 0., 0.});
    robot.chains[0].links[0].damping = 0.1;  // turns with the ball after 6 ms
    robot.chains[0].links[0].body.mass.inertia = {0.0008, 0.0008, 0.0008, 0., 0., 0.};
    robot.location = 0.1 * axes.normal;
    const auto engine = peer.make(experiment);
    const double expected = 5. / 7. * g * std::sin(angle);
    EXPECT_NEAR(speed_after(*engine, axes.downhill, 1.), expected, 1e-3 * expected) << peer.name;
  }
}

TEST(PeerFeet, PublishTheirContactPoints) {
  for (const auto& peer : reference::peers())
    for (const double mu : {0.5, 0.2}) {
      if (peer.name == "mujoco" && mu < 0.3) continue;  // it hops: tests/peers/mujoco_test.cpp
      simulation::Experiment experiment = sledge(angle, 0., mu, true);
      for (int i = 0; i < 4; ++i) experiment.points.push_back({"p", 0, 0, i});
      const auto engine = peer.make(experiment);
      engine->publish_details();
      ASSERT_TRUE(run_until(*engine, 1e-3, 0.5));
      const auto& state = engine->state();
      const Vector3d normal = slope_axes(angle, 0.).normal;
      Vector3d sum;
      for (const simulation::PointState& point : state.points) {
        sum += point.force;
        EXPECT_NEAR(point.depth, -dot(point.position, normal), 1e-12) << peer.name;
        EXPECT_LT(std::abs(point.depth), 1e-3) << peer.name;
        // Simbody's points creep at 5 mm/s where they stick.
        if (peer.name != "simbody" || mu < 0.3) {
          EXPECT_EQ(point.sliding, mu < 0.3 ? 1. : 0.) << peer.name;
        }
      }
      // Simbody's points tell the force of the instant, its bodies as all the mean of the step:
      // what still rings at 700 Hz is between them.
      const double told_apart = peer.name == "simbody" ? 1e-3 : 1e-9;
      EXPECT_NEAR(norm(sum - state.bodies[0].contact_force), 0., told_apart) << peer.name;
      EXPECT_NEAR(dot(sum, normal), g * std::cos(angle), 0.01 * g) << peer.name;
      const Vector3d corner =
          state.bodies[0].position + rotate(state.bodies[0].orientation, {-0.1, -0.1, -0.05});
      EXPECT_NEAR(norm(state.points[0].position - corner), 0., 1e-12) << peer.name;
    }
}

}  // namespace
}  // namespace hookpoint
