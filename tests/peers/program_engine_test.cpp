// The engines under Node that come with hookpoint (configs/engines), against ours, closed forms and
// numbers that were measured without hookpoint.
// ctest: long, released
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/shared/application.h"
#include "apps/shared/engine_block.h"
#include "apps/shared/engine_check.h"
#include "output/files/child.h"
#include "reference/process/engine.h"
#include "simulation/experiment/material_fields.h"
#include "tests/support/folders.h"
#include "tests/support/reference_robots.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;
namespace fs = std::filesystem;

const fs::path folder = fs::path(testing::source_folder()) / "configs/engines";

/// Why the npm packages are not here; empty where they are.
std::string missing_packages() {
  static const std::string missing = [] {
    const auto result = output::run_program(
        "bash", {testing::source_folder() + "/scripts/npm_packages", folder.string()}, "/");
    return result && result->status == 0 ? "" : result ? result->output : "there is no bash";
  }();
  return missing;
}

reference::ProgramDefinition definition(const std::string& file) {
  auto engines = application::read_engines(
      folder / file, {}, [](const std::string&) { return false; },
      [](const language::Diagnostics& diagnostics) { EXPECT_EQ(diagnostics.error_count(), 0); });
  return engines.at(0);
}

class ProgramEngineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = missing_packages(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(ProgramEngineTest, PassesTheCheck) {
  for (const char* file : {"mujoco.hook", "rapier.hook", "jolt.hook"})
    for (const application::EngineFinding& finding : application::check_engine(definition(file)))
      EXPECT_NE(finding.verdict, application::EngineFinding::Verdict::failed)
          << file << ", " << finding.check << ": " << finding.text;
}

// The block of 1 kg on 15 deg, mu 0.8, 1 ms. The numbers are of MuJoCo 3.14 in a script of its own,
// without hookpoint (docs/reference_engines.md): a pyramid creeps at ... and a cone at 1/impratio.
TEST_F(ProgramEngineTest, MujocoCreepsAsItDoesByItself) {
  const reference::ProgramEngine engine(definition("mujoco.hook"));
  const struct {
    const char* settings;
    double creep;
  } measured[] = {{"default", 1.095e-3},
                  {"elliptic", 6.62e-4},
                  {"elliptic_10", 6.62e-5},
                  {"recommended", 6.62e-6},
                  {"discrete", 1.07e-3}};
  for (const auto& [settings, creep] : measured) {
    const auto world = engine.make(sloped_block(15. * degree, 0., 0.8, 1e-3, settings));
    EXPECT_NEAR(creep_speed(*world, slope_axes(15. * degree, 0.).downhill, 1e-3, 2., 3.), creep,
                0.01 * creep)
        << settings;
  }
  const auto still = engine.make(sloped_block(15. * degree, 0., 0.8, 1e-3, "noslip"));
  EXPECT_LT(creep_speed(*still, slope_axes(15. * degree, 0.).downhill, 1e-3, 2., 3.), 1e-8);
}

// What a notice names as unread changes nothing, and what it does not name changes the motion.
TEST_F(ProgramEngineTest, SaysWhichConstantsItDoesNotRead) {
  using Constants = contact::MaterialConstants<double>;
  for (const auto& [file, settings] :
       {std::pair{"mujoco.hook", "default"}, std::pair{"mujoco.hook", "matched"},
        std::pair{"jolt.hook", "default"}, std::pair{"rapier.hook", "default"}}) {
    const reference::ProgramEngine engine(definition(file));
    for (const auto constant : {&Constants::normal_stiffness, &Constants::normal_damping,
                                &Constants::tangential_stiffness, &Constants::exponent}) {
      simulation::Experiment experiment = sloped_block(15. * degree, 0.2, 0.5, 1e-3, settings);
      experiment.materials[0].name = "clay";
      experiment.materials[0].meant = {constant};
      const auto notices = engine.make(experiment)->state().notices;
      const std::string told = "`" + std::string(simulation::field_of(constant).name) +
                               "` of material 'clay' is not read at `settings = " + settings + "`";
      const bool said = std::ranges::any_of(notices, [&](const std::string& notice) {
        return notice.find(told) != std::string::npos;
      });
      const bool reads =
          thrown(engine, settings, constant, 0.7) != thrown(engine, settings, constant, 1.);
      EXPECT_NE(said, reads) << file << " " << told;
    }
  }
}

TEST_F(ProgramEngineTest, MujocoIsSetUpAsTheLinkedOne) {
  const reference::Peer& linked = reference::peer_named("mujoco");
  if (!linked.found()) GTEST_SKIP() << "MuJoCo is not found";
  const reference::ProgramEngine program(definition("mujoco.hook"));
  for (const char* settings : {"default", "recommended", "matched", "file"}) {
    auto experiment = sloped_block(15. * degree, 0.3, 0.8, 1e-3, settings);
    experiment.materials.at(0).mujoco = {{{0.01, 0.7}, {0.8, 0.9, 2e-3, 0.5, 2.}}, {true, 20.}};
    const auto a = linked.make(experiment), b = program.make(experiment);
    const SlopeAxes axes = slope_axes(15. * degree, 0.3);
    const double theirs = creep_speed(*a, axes.downhill, 1e-3, 1., 2.);
    EXPECT_NEAR(creep_speed(*b, axes.downhill, 1e-3, 1., 2.), theirs, 0.01 * std::abs(theirs))
        << settings;
    const double depth = 0.05 - dot(a->state().bodies[0].position, axes.normal);
    EXPECT_NEAR(0.05 - dot(b->state().bodies[0].position, axes.normal), depth, 0.01 * depth)
        << settings;
    EXPECT_EQ(a->state().bodies[0].contacts, b->state().bodies[0].contacts) << settings;
  }
}

// Their contacts hold what sticks by positions: what moves is rounding of single precision.
TEST_F(ProgramEngineTest, RapierAndJoltDoNotCreep) {
  for (const auto& [file, most] : {std::pair{"rapier.hook", 5e-6}, std::pair{"jolt.hook", 1e-8}}) {
    const reference::ProgramEngine engine(definition(file));
    const auto world = engine.make(sloped_block(15. * degree, 0., 0.8, 1e-3));
    const double creep = creep_speed(*world, slope_axes(15. * degree, 0.).downhill, 1e-3, 2., 3.);
    EXPECT_LT(std::abs(creep), most) << file;
    const double load = dot(world->state().bodies[0].contact_force, Vector3d{0., 0., 1.});
    EXPECT_NEAR(load, g, 0.02 * g) << file;
  }
}

// A block that friction cannot hold slides with g (sin a - mu cos a).
TEST_F(ProgramEngineTest, WhatSlidesAcceleratesAsCoulombSays) {
  const double angle = 30. * degree, mu = 0.3;
  const double expected = g * (std::sin(angle) - mu * std::cos(angle));
  for (const char* file : {"mujoco.hook", "rapier.hook", "jolt.hook"}) {
    const reference::ProgramEngine engine(definition(file));
    const auto world = engine.make(sloped_block(angle, 0., mu, 1e-3));
    const Vector3d downhill = slope_axes(angle, 0.).downhill;
    ASSERT_TRUE(run_until(*world, 1e-3, 0.2)) << file;
    const double before = dot(world->state().bodies[0].velocity, downhill);
    ASSERT_TRUE(run_until(*world, 1e-3, 0.4)) << file;
    const double after = dot(world->state().bodies[0].velocity, downhill);
    EXPECT_NEAR((after - before) / 0.2, expected, 0.01 * expected) << file;
  }
}

// A ball that falls 0.3 m comes back with the part of its speed that the material says, whatever the
// other engine makes of two coefficients.
TEST_F(ProgramEngineTest, WhatBouncesKeepsThePartThatItsMaterialSays) {
  const double fall = std::sqrt(2. * 0.3 / g);
  for (const char* file : {"rapier.hook", "jolt.hook"})
    for (const double restitution : {0., 0.5, 0.8}) {
      simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
      experiment.materials[0].constants.restitution = restitution;
      simulation::RobotSpec& ball = experiment.robots[0];
      ball.base.shapes.clear();
      ball.base.shapes.emplace_back().geometry = simulation::Sphere{0.1};
      ball.location = {0., 0., 0.4};
      const reference::ProgramEngine engine(definition(file));
      const auto world = engine.make(experiment);
      ASSERT_TRUE(run_until(*world, 1e-3, fall - 5e-3)) << file;
      const double before = world->state().bodies[0].velocity.z;
      ASSERT_TRUE(run_until(*world, 1e-3, fall + 5e-3)) << file;
      const double after = world->state().bodies[0].velocity.z;
      EXPECT_NEAR(after / -before, restitution, 0.04) << file;
    }
}

/// Stands on four points of that radius, on a grid of heights or on an obstacle.
simulation::Experiment block_on_points(double radius, bool on_grid) {
  const double angle = on_grid ? 5. * degree : 0.;
  simulation::Experiment experiment = sloped_block(angle, 0., 0.8, 1e-3);
  simulation::RobotSpec& robot = experiment.robots[0];
  const Vector3d half = 0.5 * std::get<simulation::Box>(robot.base.shapes[0].geometry).dimensions;
  robot.base.shapes.clear();
  for (const double x : {-half.x, half.x}) {
    for (const double y : {-half.y, half.y}) {
      robot.base.boundary_points.push_back({x, y, -half.z});
      if (radius > 0.) robot.base.boundary_radii.push_back(radius);
    }
  }
  const double raised = radius + 2e-3;
  robot.location = (half.z + raised) * slope_axes(angle, 0.).normal;
  if (on_grid) {
    // Rough by a hair, since what is a plane is one to an engine.
    experiment.terrain = tilted_grid(angle);
    std::get<simulation::GridSpec>(experiment.terrain->surface).heights.front() += 1e-3;
    experiment.touch = "points";
  } else {
    simulation::ObstacleSpec& table = experiment.obstacles.emplace_back();
    table.name = "table";
    table.geometry = simulation::Box{{2., 2., 0.2}};
    table.location = {0., 0., 1.};
    experiment.touch = "shapes";
    robot.location = robot.location + Vector3d{0., 0., 1.1};
  }
  return experiment;
}

// A point without a size is a ball of 1 mm there: it stands on solids, and on triangles, which have no
// inside, it is refused.
TEST_F(ProgramEngineTest, PointsStandOnGroundThatIsNoPlaneOrAreRefused) {
  for (const char* file : {"rapier.hook", "jolt.hook"}) {
    const reference::ProgramEngine engine(definition(file));
    try {
      const auto world = engine.make(block_on_points(0., true));
      ADD_FAILURE() << file;
    } catch (const std::exception& refused) {
      EXPECT_TRUE(testing::has(refused.what(), "give the ContactPoints a radius"))
          << refused.what();
    }
    const double radius = 0.02;
    const auto on_grid = engine.make(block_on_points(radius, true));
    ASSERT_TRUE(run_until(*on_grid, 1e-3, 1.)) << file;
    EXPECT_NEAR(dot(on_grid->state().bodies[0].position, slope_axes(5. * degree, 0.).normal),
                0.05 + radius, 1e-3)
        << file;
    const auto on_table = engine.make(block_on_points(0., false));
    ASSERT_TRUE(run_until(*on_table, 1e-3, 1.)) << file;
    EXPECT_NEAR(on_table->state().bodies[0].position.z, 1.1 + 0.05 + 1e-3, 0.5e-3) << file;
  }
}

// Iterations hold their joints together: at rest, solved to the end, over a step so long that single
// precision leaves the digits (its gaps of 1e-7 m close in a step) and so short that the joints hardly
// turn in it.
TEST_F(ProgramEngineTest, RapierAndJoltAccelerateChainsFromRestAsOurs) {
  for (const char* file : {"rapier.hook", "jolt.hook"}) {
    const reference::ProgramEngine engine(definition(file));
    const auto make = [&](const simulation::Experiment& of) { return engine.make(of); };
    for (const bool mobile : {true, false}) {
      simulation::RobotSpec robot = skew_robot(3, 4, mobile);
      for (simulation::ChainSpec& chain : robot.chains)
        for (simulation::LinkSpec& link : chain.links)
          link.joint = simulation::JointKind::revolute;  // Rapier's here
      simulation::Experiment experiment = robot_world(robot, 3e-3);
      experiment.settings = "converged";
      experiment.integrator = "explicit_euler";
      EXPECT_LT(acceleration_error(make, experiment), 1e-3)
          << file << (mobile ? "" : ", fixed base");
    }
  }
}

TEST_F(ProgramEngineTest, RobotsWithChainsAccelerateAsOurs) {
  const reference::ProgramEngine engine(definition("mujoco.hook"));
  const auto make = [&](const simulation::Experiment& experiment) {
    return engine.make(experiment);
  };
  for (const bool mobile : {true, false})
    for (simulation::RobotSpec robot : skew_robots(mobile)) {
      EXPECT_LT(acceleration_error(make, at_rest(robot)), 1e-8);
      set_in_motion(robot);
      simulation::Experiment experiment = robot_world(robot, 1e-3);
      experiment.integrator = "explicit_euler";
      EXPECT_LT(acceleration_error(make, experiment), 1e-8);
    }
}

}  // namespace
}  // namespace hookpoint
