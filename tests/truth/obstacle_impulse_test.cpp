// Impulse laws at risers, edges and obstacles, still and moving: what touches leaves with the speed that
// restitution says.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

std::string room(const std::string& content, double restitution, const std::string& gravity = "0") {
  return "World w { touch = shapes; contact = impulse; gravity = " + gravity +
         "; deltat = 1 ms; Material m { restitution = " + std::to_string(restitution) +
         "; rebound_speed = 1 mm/s; static_friction = 0; kinetic_friction = 0; } " + content + " }";
}
std::string ball(const std::string& place, const std::string& velocity) {
  return " Robot ball { Base.mobile { location = " + place + "; velocity = " + velocity +
         "; Shape.Sphere { radius = 0.05; mass = 1 kg; material = m; } } }";
}
const std::string stairs =
    "Terrain.Steps stairs { height = 0.1; run = 0.3; from = 0.5; material = m; }";

TEST(ImpulseOnShapes, ABallComesBackFromARiser) {
  Running run(room(stairs + ball("0.2, 0, 0.06", "1, 0, 0"), 0.6));
  double farthest = 0.;
  for (int i = 0; i < 500; ++i) {
    run.step();
    farthest = std::max(farthest, run["w.ball.position.x"]);
  }
  EXPECT_NEAR(run["w.ball.velocity.x"], -0.6, 1e-9);
  EXPECT_NEAR(farthest, 0.45, 1e-3);  // a radius before the riser
  EXPECT_LE(farthest, 0.45 + 1e-9);
}

// Over the nosing the normal is from the edge to the centre: a ball that comes down beside it at an
// angle a is thrown off at 2 a.
TEST(ImpulseOnShapes, ABallBouncesOffANosing) {
  const double beside = 0.03;
  Running run(room(stairs + ball(std::to_string(0.5 - beside) + ", 0, 0.2", "0, 0, -1"), 1.));
  run.step(150);
  const double sine = beside / 0.05, cosine = std::sqrt(1. - sine * sine);
  EXPECT_NEAR(run["w.ball.velocity.x"], -2. * sine * cosine, 1e-6);
  EXPECT_NEAR(run["w.ball.velocity.z"], cosine * cosine - sine * sine, 1e-6);
}

TEST(ImpulseOnShapes, ObstaclesStopABall) {
  for (const std::string obstacle :
       {"Obstacle.Box o { dimensions = 0.2, 1, 1; location = 0.6, 0, 0; material = m; }",
        "Obstacle.Cylinder o { radius = 0.1; length = 1; location = 0.6, 0, 0; material = m; }",
        "Obstacle.Sphere o { radius = 0.1; location = 0.6, 0, 0; material = m; }"}) {
    Running run(room(obstacle + ball("0.2, 0, 0", "1, 0, 0"), 0.5));
    run.step(600);
    EXPECT_NEAR(run["w.ball.velocity.x"], -0.5, 1e-9) << obstacle;
  }
}

// A box at rest on an obstacle, one of its corners over the edge.
TEST(ImpulseOnShapes, ABoxRestsOnATable) {
  Running run(
      room("Obstacle.Box table { dimensions = 1, 1, 0.2; material = m; } Robot box { "
           "Base.mobile { location = 0, 0, 0.1505; Shape.Box { dimensions = 0.1, 0.1, 0.1; "
           "mass = 1; material = m; } } }",
           0., "9.81"));
  run.step(1000);
  EXPECT_NEAR(run["w.box.position.z"], 0.15, 1e-6);
}

// A wall that comes at V sends a ball that waits off at (1 + e) V, and does m (1 + e) V on it for V a
// second.
TEST(ImpulseOnShapes, AWallThatMovesThrowsABall) {
  const double V = 0.8, e = 0.5;
  Running run(room("Obstacle.Box wall { dimensions = 0.2, 1, 1; velocity = " + std::to_string(V) +
                       ", 0, 0; material = m; }" + ball("0.4, 0, 0", "0, 0, 0"),
                   e));
  run.step(500);
  EXPECT_NEAR(run["w.ball.velocity.x"], (1. + e) * V, 1e-9);
  EXPECT_NEAR(run["w.wall.work"], (1. + e) * V * V, 1e-9);
  // It met the wall when that had come the gap of 0.25 m, at V; they stay 2 nm apart.
  EXPECT_NEAR(run["w.ball.position.x"], 0.4 + (1. + e) * V * (0.5 - 0.25 / V), 5e-9);
}

// A block on a belt slides at mu g until it has the belt's speed.
TEST(ImpulseOnShapes, ABeltTakesABlockAlong) {
  const std::string text =
      "World w { touch = shapes; contact = impulse; gravity = 9.81; deltat = 1 ms; Material m { "
      "restitution = 0; rebound_speed = 0.1 mm/s; kinetic_friction = 0.2; static_friction = 0.2; } "
      "Terrain.Flat belt { velocity = 0.5, 0, 0; material = m; } Robot block { Base.mobile { location = 0, 0, 0.02; Shape.Box { dimensions = "
      "0.2, 0.2, 0.04; mass = 1 kg; material = m; } } } }";
  Running run(text);
  run.step(100);
  EXPECT_NEAR(run["w.block.velocity.x"], 0.2 * 9.81 * 0.1, 2e-3);
  run.step(300);
  EXPECT_NEAR(run["w.block.velocity.x"], 0.5, 2e-3);
}

// The place where a tumbling disc touches runs along its rim, from impact to impact: the run does not stop
// at what its flights sink by meanwhile. Impacts without restitution take energy, and none brings any.
TEST(ImpulseOnShapes, ATumblingDiscLosesEnergyAndDoesNotStop) {
  Running run(
      "World w { gravity = 9.81; deltat = 1 ms; contact = impulse; Material s { kinetic_friction = 0.5; "
      "restitution = 0; rebound_speed = 1 mm/s; } Terrain.Flat g { material = s; } Robot d { Base.mobile { "
      "location = 0, 0, 0.3; orientation = 1.9, 0.3, 0; angular_velocity = 3, 1, 2; Shape.Disc { radius = "
      "0.09; mass = 1; } } } }");
  const auto energy = [&] { return run["d.kinetic_energy"] + 9.81 * run["d.position.z"]; };
  const double start = energy();
  for (int i = 0; i < 400; ++i) {
    run.step();
    EXPECT_LT(energy(), start + 1e-6) << i;
    EXPECT_GT(run["d.position.z"], -1e-6) << i;
  }
}

}  // namespace
}  // namespace hookpoint
