// Impulse laws between bodies: textbook collisions of two balls, momentum and energy of many, bodies that
// rest on bodies, and a robot's links.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

std::string world(const std::string& content, double restitution, const std::string& gravity = "0",
                  double friction = 0.) {
  const std::string mu = std::to_string(friction);
  return "World w { touch = shapes; contact = impulse; gravity = " + gravity +
         "; deltat = 1 ms; Material m { restitution = " + std::to_string(restitution) +
         "; rebound_speed = 0.2 mm/s; static_friction = " + mu + "; kinetic_friction = " + mu +
         "; } " + content + " }";
}
std::string ball(const std::string& name, double mass, const std::string& place,
                 const std::string& velocity = "0, 0, 0") {
  return " Robot " + name + " { Base.mobile { location = " + place + "; velocity = " + velocity +
         "; Shape.Sphere { radius = 0.05; mass = " + std::to_string(mass) + "; material = m; } } }";
}
std::string box(const std::string& name, const std::string& dimensions, const std::string& place,
                const std::string& more = "") {
  return " Robot " + name + " { Base.mobile { location = " + place + "; " + more +
         " Shape.Box { dimensions = " + dimensions + "; mass = 1; material = m; } } }";
}

// v1' = (m1 - e m2) v/(m1 + m2), v2' = (1 + e) m1 v/(m1 + m2).
TEST(ImpulseBetweenBodies, TwoBallsThatMeetHeadOn) {
  for (const double e : {0., 0.4, 1.}) {
    for (const double m2 : {0.3, 1., 5.}) {
      Running run(world(ball("a", 1., "0, 0, 0", "1, 0, 0") + ball("b", m2, "0.2, 0, 0"), e));
      run.step(300);
      // A ball that does not come back stays u0 behind.
      EXPECT_NEAR(run["w.a.velocity.x"], (1. - e * m2) / (1. + m2), 2.1e-4);
      EXPECT_NEAR(run["w.b.velocity.x"], (1. + e) / (1. + m2), 2.1e-4);
      EXPECT_NEAR(run["w.a.velocity.x"] + m2 * run["w.b.velocity.x"], 1., 1e-12);
    }
  }
}

// Smooth balls of one mass that meet off their centres part at right angles: along the line of centres
// the speed goes over, across it stays.
TEST(ImpulseBetweenBodies, ASmoothBallThatIsHitOffItsMiddle) {
  const double offset = 0.06, sine = offset / 0.1, cosine = std::sqrt(1. - sine * sine);
  Running run(world(ball("a", 1., "0, 0, 0", "1, 0, 0") + ball("b", 1., "0.3, 0.06, 0"), 1.));
  run.step(400);
  EXPECT_NEAR(run["w.b.velocity.x"], cosine * cosine, 1e-7);
  EXPECT_NEAR(run["w.b.velocity.y"], cosine * sine, 1e-7);
  EXPECT_NEAR(run["w.a.velocity.x"], sine * sine, 1e-7);
  EXPECT_NEAR(run["w.a.velocity.y"], -cosine * sine, 1e-7);
}

TEST(ImpulseBetweenBodies, ACradleOfBallsPassesTheBlowOn) {
  std::string balls = ball("a", 1., "-0.2, 0, 0", "1, 0, 0");
  for (int i = 0; i < 4; ++i)
    balls += ball("b" + std::to_string(i), 1., std::to_string(0.101 * i) + ", 0, 0");
  Running run(world(balls, 1.));
  run.step(600);
  EXPECT_NEAR(run["w.b3.velocity.x"], 1., 1e-9);
  for (const char* still : {"w.a", "w.b0", "w.b1", "w.b2"})
    EXPECT_NEAR(run[std::string(still) + ".velocity.x"], 0., 1e-9) << still;
}

// Rough boxes that tumble into each other, none of whose collisions loses energy but by friction.
TEST(ImpulseBetweenBodies, ACloudOfBoxesKeepsItsMomentum) {
  std::string boxes;
  for (int i = 0; i < 6; ++i) {
    const int side = i % 2 == 0 ? 1 : -1;
    const std::string place = std::to_string(0.13 * (i / 2)) + ", " + std::to_string(0.02 * i) +
                              ", " + std::to_string(0.1 * side);
    boxes += box("b" + std::to_string(i), "0.1, 0.08, 0.06", place,
                 "velocity = 0.05, 0.03, " + std::to_string(-0.5 * side) +
                     "; angular_velocity = 3, " + std::to_string(i) + ", -2;");
  }
  for (const double friction : {0., 0.5}) {
    Running run(world(boxes, 1., "0", friction));
    const auto sum = [&](const std::string& port) {
      double total = 0.;
      for (int i = 0; i < 6; ++i) total += run["w.b" + std::to_string(i) + port];
      return total;
    };
    const double energy = sum(".kinetic_energy");
    run.step(500);
    EXPECT_GT(run["w.impacts"], 3.);
    EXPECT_NEAR(sum(".velocity.x"), 6. * 0.05, 1e-11);
    EXPECT_NEAR(sum(".velocity.y"), 6. * 0.03, 1e-11);
    EXPECT_NEAR(sum(".velocity.z"), 0., 1e-11);
    // The flights' Runge-Kutta steps are as exact; a collision may add what lifts it to u0.
    EXPECT_LT(sum(".kinetic_energy"), energy * (1. + 1e-6));
    if (friction > 0.) continue;
    EXPECT_NEAR(sum(".kinetic_energy"), energy, 1e-6 * energy);
  }
}

// Crossed beams touch by their edges alone.
TEST(ImpulseBetweenBodies, BoxesRestOnBoxes) {
  for (const std::string second : {"0.1, 0.1, 0.1", "0.04, 0.3, 0.1"}) {
    Running run(world("Terrain.Flat ground { material = m; }" +
                          box("below", "0.3, 0.08, 0.1", "0, 0, 0.0505") +
                          box("above", second, "0.01, 0.013, 0.152"),
                      0., "9.81", 0.5));
    run.step(400);
    EXPECT_NEAR(run["w.below.position.z"], 0.05, 1e-7) << second;
    EXPECT_NEAR(run["w.above.position.z"], 0.15, 1e-7) << second;
    EXPECT_NEAR(run["w.above.position.x"], 0.01, 1e-4) << second;
  }
}

// A rod on a hinge, hit at its end by a ball: P = (1 + e) V/(1/m + l^2/I).
TEST(ImpulseBetweenBodies, ABallHitsAHingedRod) {
  const double m = 0.5, V = 2., l = 0.6, e = 0.5, I = 0.03 + 1.2 * 0.3 * 0.3;
  Running run(world(ball("ball", m, "0.6, -0.3, 0", "0, 2, 0") +
                        " Robot rod { Base.fixed { } Chain arm { Link rod { mass = 1.2; "
                        "center_of_mass = 0.3, 0, 0; inertia = 0.03, 0.03, 0.03, 0, 0, 0; "
                        "Shape.Sphere { location = 0.6, 0, 0; radius = 0.03; material = m; } } } }",
                    e));
  run.step(200);
  const double P = (1. + e) * V / (1. / m + l * l / I);
  EXPECT_NEAR(run["w.ball.velocity.y"], V - P / m, 1e-6);
  EXPECT_NEAR(run["w.rod.arm.rod.rate"], P * l / I, 1e-6);
}

// A double pendulum that folds touches itself where it is to, and keeps its energy.
TEST(ImpulseBetweenBodies, ARobotTouchesItself) {
  const auto folded = [](bool self_contact) {
    Running run(
        world(std::string(" Robot arm { ") + (self_contact ? "self_contact = true; " : "") +
                  "Base.fixed { } Chain c { Link a { mass = 9; center_of_mass = 0.2, 0, 0; "
                  "inertia = 9, 9, 9, 0, 0, 0; Shape.Sphere { location = 0.3, 0, 0; "
                  "radius = 0.03; material = m; } } Link b { dhlength = 0.4; mass = 9; "
                  "center_of_mass = 0.1, 0, 0; inertia = 9, 9, 9, 0, 0, 0; } "
                  "Link c { dhlength = 0.2; angle = 100 deg; rate = 3; mass = 1; "
                  "center_of_mass = 0.2, 0, 0; inertia = 0.01, 0.01, 0.01, 0, 0, 0; "
                  "Shape.Sphere { location = 0.3, 0, 0; radius = 0.03; material = m; } } } }",
              1.));
    const double energy = run["w.arm.kinetic_energy"];
    run.step(1500);
    EXPECT_NEAR(run["w.arm.kinetic_energy"], energy, 1e-6 * energy);
    return run["w.impacts"];
  };
  EXPECT_EQ(folded(false), 0.);
  EXPECT_GT(folded(true), 0.);
}

TEST(ImpulseBetweenBodies, ASavedStateGoesOnAlike) {
  const std::string text = world("Terrain.Flat ground { velocity = 0.1, 0, 0; material = m; }" +
                                     box("below", "0.3, 0.08, 0.1", "0, 0, 0.0505") +
                                     box("above", "0.04, 0.3, 0.1", "0.01, 0.013, 0.152"),
                                 0., "9.81", 0.5);
  Running whole(text);
  whole.step(40);
  std::vector<double> numbers(whole.world().state_size());
  whole.world().save(numbers);
  Running resumed(text);
  resumed.world().restore(numbers);
  for (Running* run : {&whole, &resumed}) run->step(20);
  for (const char* port : {"w.above.position.x", "w.above.velocity.z", "w.below.contact.force.z",
                           "w.ground.work", "w.impacts"})
    EXPECT_EQ(whole[port], resumed[port]) << port;
}

}  // namespace
}  // namespace hookpoint
