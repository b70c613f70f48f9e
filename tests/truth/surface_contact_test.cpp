// What bodies do to the terrain and to obstacles, as those publish it: Newton's third law, the lever
// rule of force plates, and the loads of a foot on a surface that is no plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

std::string world(const std::string& settings, const std::string& content) {
  return "World w { deltat = 0.1 ms; " + settings +
         " Material m { normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = 1e5; "
         "tangential_damping = 300; } " +
         content + " }";
}

Vector3d vector_at(Running& run, const std::string& port) {
  return {run[port + ".x"], run[port + ".y"], run[port + ".z"]};
}

/// A box thrown at a step and a ball thrown at a free block on moving ground: all that bodies are given is
/// taken from surfaces, in each step.
TEST(SurfaceContact, WhatBodiesAreGivenIsTakenFromSurfaces) {
  Running run(world(
      "touch = shapes;",
      "Terrain.Slope hill { angle = 5 deg; material = m; velocity = 0.2, 0, 0; } "
      "Obstacle.Box step { location = 0.5, 0, 0; dimensions = 0.2, 1, 0.3; material = m; } "
      "Robot box { Base.mobile { location = 0.1, 0, 0.15; velocity = 2, 0.3, 0; angular_velocity = "
      "1, 2, 3; Shape.Box { dimensions = 0.1, 0.12, 0.08; mass = 2; material = m; } } } "
      "Robot ball { Base.mobile { location = 0.1, 0.3, 0.2; velocity = 1.5, -2, 0; "
      "Shape.Sphere { radius = 0.05; mass = 1; material = m; } } }"));
  double hardest = 0., of_step = 0.;
  for (int i = 0; i < 5000; ++i) {
    run.step(1);
    const Vector3d on_bodies =
        vector_at(run, "box.contact.force") + vector_at(run, "ball.contact.force");
    const Vector3d on_step = vector_at(run, "step.contact.force");
    const Vector3d on_surfaces = vector_at(run, "hill.contact.force") + on_step;
    ASSERT_NEAR(norm(on_bodies + on_surfaces), 0., 1e-9 * (1. + norm(on_bodies))) << "step " << i;
    hardest = std::max(hardest, norm(on_bodies));
    of_step = std::max(of_step, norm(on_step));
  }
  EXPECT_GT(hardest, 100.);
  EXPECT_GT(of_step, 100.);
}

class OnFlatGround : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Touch, OnFlatGround, ::testing::Values("points", "shapes"));

/// Two boxes of 2 and 3 kg stand 0.3 m and -0.2 m from the ground's origin, the first pushed along by 5 N.
TEST_P(OnFlatGround, TheGroundCarriesAllRobots) {
  Running run(
      world(std::string("touch = ") + GetParam() + ";",
            "Terrain.Flat ground { material = m; } "
            "Robot one { Base.mobile { at = 0.3, 0; rest_on = ground; Shape.Box { dimensions = "
            "0.1, 0.1, 0.1; mass = 2; material = m; } } } "
            "Robot two { Base.mobile { at = -0.2, 0.1; rest_on = ground; Shape.Box { "
            "dimensions = 0.1, 0.1, 0.1; mass = 3; material = m; } } } "
            "Force push { body = one.base; force = 0, 5, 0; }"));
  run.step(20000);
  const double load = 5. * g;
  EXPECT_NEAR(run["ground.contact.force.z"], -load, 1e-6 * load);
  EXPECT_NEAR(run["ground.contact.force.y"], 5., 1e-4);
  EXPECT_NEAR(run["ground.contact.normal_load"], load, 1e-6 * load);
  EXPECT_NEAR(run["ground.contact.tangential_load"], 5., 1e-4);
  EXPECT_EQ(run["ground.contact.count"], 8.);
  // The push at half the height tips the load of the first by 5 N * 0.05 m.
  const double pressed_x = (2. * g * 0.3 - 3. * g * 0.2) / load;
  const double pressed_y = (3. * g * 0.1 + 5. * 0.05) / load;
  EXPECT_NEAR(run["ground.contact.center_of_pressure.x"], pressed_x, 1e-4);
  EXPECT_NEAR(run["ground.contact.center_of_pressure.y"], pressed_y, 1e-4);
  EXPECT_NEAR(run["ground.contact.moment.x"], -load * pressed_y, 1e-3);
  EXPECT_NEAR(run["ground.contact.moment.y"], load * pressed_x, 1e-3);
  EXPECT_NEAR(run["ground.contact.moment.z"], 5. * 0.3, 1e-2);
}

/// A table of 10 kg stands with two of its four feet on each of two plates, 50 N press on it 0.2 m towards the
/// second: plates carry by the lever rule.
TEST(SurfaceContact, ForcePlatesCarryByTheLeverRule) {
  std::string feet;
  for (const char* x : {"-0.4", "0.4"})
    for (const char* y : {"-0.1", "0.1"})
      feet += std::string("ContactPoint { location = ") + x + ", " + y +
              ", -0.2; radius = 0.02; material = m; } ";
  Running run(world(
      "touch = shapes;",
      "Obstacle.Box left { location = -0.4, 0, 0; dimensions = 0.2, 0.4, 0.1; material = m; } "
      "Obstacle.Box right { location = 0.4, 0, 0; dimensions = 0.2, 0.4, 0.1; material = m; } "
      "Robot table { Base.mobile { location = 0, 0, 0.2698; mass = 10; inertia = 0.2, 1, 1, 0, 0, "
      "0; " +
          feet +
          "} } "
          "Force press { body = table.base; point = 0.2, 0.05, 0; force = 0, 0, -50; }"));
  run.step(20000);
  const double right = 0.5 * 10. * g + 50. * (0.2 + 0.4) / 0.8;
  EXPECT_NEAR(run["right.contact.normal_load"], right, 0.02);
  EXPECT_NEAR(run["left.contact.normal_load"], 10. * g + 50. - right, 0.02);
  EXPECT_EQ(run["right.contact.count"], 2.);
  EXPECT_NEAR(run["right.contact.center_of_pressure.x"], 0.4, 1e-3);
  // Four equal springs at (+-0.4, +-0.1) share a moment of 50 N * 0.05 m about x: 6.25 N more on each foot at
  // +y, so that those of one plate differ by 12.5 N.
  EXPECT_NEAR(run["right.contact.center_of_pressure.y"], 0.1 * 12.5 / right, 1e-3);
  // The plates' loads balance weight and press about x, where the tilt has moved the table.
  const double y = run["table.position.y"];
  EXPECT_NEAR(run["right.contact.normal_load"] * run["right.contact.center_of_pressure.y"] +
                  run["left.contact.normal_load"] * run["left.contact.center_of_pressure.y"],
              10. * g * y + 50. * (y + 0.05), 2e-3);
  // About the plate's origin, 0.05 m under the friction.
  EXPECT_NEAR(
      run["right.contact.moment.x"],
      -right * run["right.contact.center_of_pressure.y"] - 0.05 * run["right.contact.force.y"],
      2e-3);
  EXPECT_NEAR(run["right.contact.moment.y"],
              right * (run["right.contact.center_of_pressure.x"] - 0.4) +
                  0.05 * run["right.contact.force.x"],
              2e-3);
}

/// A foot on a tread, which shapes touch, publishes its loads as on a plane.
TEST(SurfaceContact, AFootOnStairsPublishesItsLoads) {
  std::string feet;
  for (const char* x : {"-0.05", "0.05"})
    for (const char* y : {"-0.05", "0.05"})
      feet += std::string("ContactPoint f") + std::to_string(feet.size()) + " { location = " + x +
              ", " + y + ", -0.05; material = m; } ";
  Running run(world(
      "touch = shapes;",
      "Terrain.Steps stairs { height = 0.1; run = 0.3; from = 0.5; material = m; } "
      "Robot block { Base.mobile { location = 0.65, 0, 0.1499; mass = 4; inertia = 0.01, 0.01, "
      "0.01, 0, 0, 0; " +
          feet +
          "} } "
          "Force push { body = block.base; point = 0, 0, -0.05; force = 8, 0, 0; }"));
  run.step(20000);
  EXPECT_NEAR(run["block.base.f0.contact.normal_load"], g, 1e-3);
  EXPECT_NEAR(run["block.base.f0.contact.tangential_load"], 2., 1e-3);
  EXPECT_NEAR(run["stairs.contact.normal_load"], 4. * g, 1e-3);
}

TEST(SurfaceContact, OthersSayThatTheyDoNotPublishIt) {
  for (const char* settings : {"engine = ode;", "contact = impulse;"}) {
    const std::string message =
        load_text(
            world(
                settings,
                "Terrain.Flat ground { material = m; } Robot box { Base.mobile { Shape.Box { dimensions = "
                "1, 1, 1; mass = 1; } } } Record log { trails = w.ground.contact.force; }"))
            .diagnostics;
    EXPECT_NE(message.find("does not publish `contact.force` of a Terrain.Flat"), std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace hookpoint
