// Ground and obstacles that move, and gravity as an input, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

std::string hall(double friction, const std::string& terrain, const std::string& content,
                 const std::string& fields = "") {
  const std::string mu = std::to_string(friction);
  return "World hall { touch = shapes; gravity = 9.81; deltat = 0.1 ms; " + fields +
         " Material rubber { normal_stiffness = 200 kN/m; normal_damping = 500 N.s/m; "
         "tangential_stiffness = 200 kN/m; tangential_damping = 500 N.s/m; static_friction = " +
         mu + "; kinetic_friction = " + mu + "; } Terrain.Flat floor { material = rubber; " +
         terrain + " } " + content + " }";
}
const std::string box =
    "Robot box { Base.mobile { rest_on = floor; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } "
    "} }";

// Put down at rest it slips for v/(mu g), v^2/(2 mu g) behind the belt, then rides with it.
TEST(MovingGround, ABeltTakesABoxAlong) {
  const double v = 0.5, mu = 0.4;
  Running run(hall(mu, "velocity = 0.5, 0, 0;", box));
  const double slips = v / (mu * g);
  run.step(static_cast<int>(0.5 * slips / 1e-4));
  EXPECT_NEAR(run["hall.box.velocity.x"], 0.5 * v, 0.01 * v);
  run.step(static_cast<int>(std::lround((1. - 0.5 * slips) / 1e-4)));
  EXPECT_NEAR(run["hall.box.velocity.x"], v, 1e-6);
  const double behind = run.world().state().time * v - run["hall.box.position.x"];
  EXPECT_NEAR(behind, v * v / (2. * mu * g), 3e-4);
  EXPECT_EQ(run["hall.floor.position.x"], 0.);
  // m v^2: half of it moves the box, half is heat.
  EXPECT_NEAR(run["hall.floor.work"], v * v, 1e-3 * v * v);
}

// The work of a lift: m g h, and m v^2 to set the box in motion.
TEST(MovingGround, ALiftWorksAgainstGravity) {
  const double v = 0.3, t = 0.5;
  Running run(hall(0.5, "frame_velocity = 0, 0, 0.3;", box));
  run.step(static_cast<int>(std::lround(t / 1e-4)));
  EXPECT_NEAR(run["hall.box.velocity.z"], v, 1e-9);
  EXPECT_NEAR(run["hall.floor.work"], g * v * t + v * v, 1e-3);
}

/// How far a box slips over a floor that shakes with the largest acceleration `a`, 4 Hz.
double slip_on_shaker(double friction, double a) {
  const double w = 2. * std::numbers::pi * 4.;
  Running run(hall(friction, "",
                   box + " Signal.Sine shake { amplitude = " + std::to_string(a / w) +
                       " m/s; frequency = 4 Hz; Wire TO floor.frame_velocity.x; }"));
  run.step(5000);
  double low = 1., high = -1.;
  for (int i = 0; i < 50; ++i) {
    run.step(100);
    const double apart = run["hall.box.position.x"] - run["hall.floor.position.x"];
    low = std::min(low, apart);
    high = std::max(high, apart);
  }
  return high - low;
}

// A box slips on a shaken floor where A w^2 > mu g.
TEST(MovingGround, AShakenBoxSlipsBeyondItsFriction) {
  EXPECT_LT(slip_on_shaker(0.4, 3.16), 1e-4);
  EXPECT_GT(slip_on_shaker(0.25, 3.16), 5e-4);
}

// The same seen from the floor: gravity shakes.
TEST(MovingGround, GravityIsAnInput) {
  for (const auto& [mu, slips] : {std::pair{0.4, false}, std::pair{0.25, true}}) {
    Running run(hall(mu, "",
                     box + " Signal.Sine shake { amplitude = 3.16 m/s^2; frequency = 4 Hz; Wire TO "
                           "hall.gravity.x; }"));
    double farthest = 0.;
    for (int i = 0; i < 50; ++i) {
      run.step(100);
      farthest = std::max(farthest, std::abs(run["hall.box.position.x"]));
    }
    EXPECT_EQ(farthest > 5e-4, slips) << farthest;
  }
}

// A plate that tilts by w t about y: the box slides once tan(w t) > mu.
TEST(MovingGround, ABoxSlidesOffATiltingPlate) {
  const double mu = 0.3, rate = 0.2;
  Running run(hall(mu, "frame_angular_velocity = 0, 0.2, 0;", box));
  const double slides_at = std::atan(mu) / rate;
  const auto along = [&] {
    const double angle = rate * run.world().state().time;
    return run["hall.box.position.x"] * std::cos(angle) -
           run["hall.box.position.z"] * std::sin(angle);
  };
  run.step(static_cast<int>(0.9 * slides_at / 1e-4));
  EXPECT_LT(std::abs(along()), 1e-3);
  run.step(static_cast<int>(0.3 * slides_at / 1e-4));
  const double t = run.world().state().time - slides_at;
  // From there a' = g w (cos + mu sin).
  EXPECT_NEAR(along(), g * rate * std::sqrt(1. + mu * mu) * t * t * t / 6., 5e-4);
}

// A wall that moves pushes a ball ahead of it; one that stands stops it.
TEST(Obstacles, PushAndStop) {
  Running run(
      hall(0., "",
           "Robot ball { Base.mobile { location = 0.15, 0, 0.05; Shape.Sphere { radius = 0.05; "
           "mass = 1 kg; } } } Obstacle.Box wall { dimensions = 0.1, 1, 0.5; location = 0, 0, "
           "0.25; velocity = 0.2, 0, 0; material = rubber; } Obstacle.Cylinder post { radius = "
           "0.05; length = 1; location = 0.6, 0, 0.5; material = rubber; }"));
  run.step(10000);
  EXPECT_NEAR(run["hall.wall.position.x"], 0.2, 1e-9);
  EXPECT_GT(run["hall.ball.position.x"], 0.29);
  // F . v of a wall of steady velocity sums up to v times the momentum that it has given.
  EXPECT_NEAR(run["hall.wall.work"], 0.2 * run["hall.ball.velocity.x"], 1e-6);
  EXPECT_EQ(run["hall.post.work"], 0.);
  double farthest = 0.;
  for (int i = 0; i < 100; ++i) {
    run.step(100);
    farthest = std::max(farthest, run["hall.ball.position.x"]);
  }
  EXPECT_LT(farthest, 0.501);
}

TEST(Obstacles, CarryWhatStandsOnThem) {
  Running run(
      hall(0.6, "",
           "Robot box { Base.mobile { location = 0, 0, 0.25; Shape.Box { dimensions = 0.1, 0.1, "
           "0.1; mass = 1 kg; } } } Obstacle.Box table { dimensions = 1, 1, 0.2; location = 0, "
           "0, 0.1; velocity = 0.3, 0.1, 0; material = rubber; }"));
  run.step(20000);
  EXPECT_NEAR(run["hall.box.velocity.x"], 0.3, 1e-6);
  EXPECT_NEAR(run["hall.box.velocity.y"], 0.1, 1e-6);
  EXPECT_NEAR(run["hall.box.position.z"], 0.25 - g / 8e5, 2e-6);
}

}  // namespace
}  // namespace hookpoint
