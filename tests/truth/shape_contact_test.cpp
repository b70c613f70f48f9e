// Shapes that touch as they are: wheels, edges, grooves, corners, stairs and other bodies, against
// closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;
const double deg = std::numbers::pi / 180.;

/// A World with one Material, `ground`.
std::string yard(const std::string& fields, const std::string& content,
                 const std::string& material = "static_friction = 0.8;") {
  return std::string("World yard { touch = shapes; ") +
         (fields.find("gravity") == fields.npos ? "gravity = 9.81; " : "") + fields +
         " Material ground { normal_stiffness = 100 kN/m; normal_damping = 300 N.s/m; "
         "tangential_stiffness = 100 kN/m; tangential_damping = 300 N.s/m; " +
         material + " } " + content + " }";
}
const std::string slope = "Terrain.Slope floor { angle = 5 deg; material = ground; } ";
const std::string flat = "Terrain.Flat floor { material = ground; } ";

/// A shape of radius 0.09 whose centre lies 0.09 m over the slope, let go.
std::string rolling(const std::string& shape) {
  return slope + "Robot wheel { Base.mobile { location = 0.09*sin(5 deg), 0, 0.09*cos(5 deg); " +
         shape + " } }";
}

double downhill_speed(Running& run) {
  return run["yard.wheel.velocity.x"] * std::cos(5. * deg) -
         run["yard.wheel.velocity.z"] * std::sin(5. * deg);
}

// a = g sin / (1 + I/(m r^2)): 2/3 of g sin for a solid cylinder, 1/2 for a tube, whatever its material.
TEST(ShapeContact, CylindersRollDown) {
  const std::string tube =
      "mass = 2 kg; inertia = 0.01, 2*0.09^2, 0.01, 0, 0, 0; Shape.Cylinder { orientation = pi/2, 0, "
      "0; radius = 0.09; length = 0.04; }";
  const std::string solid =
      "orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.09; length = 0.04; mass = 2 kg; }";
  for (const auto& [shape, part] : {std::pair{solid, 2. / 3.}, std::pair{tube, 0.5}}) {
    Running run(yard("deltat = 0.1 ms;", rolling(shape)));
    run.step(2000);
    const double before = downhill_speed(run);
    run.step(5000);
    EXPECT_NEAR((downhill_speed(run) - before) / 0.5, part * g * std::sin(5. * deg), 1e-4);
  }
}

// Every law and a Runge-Kutta method: the truth does not depend on them.
TEST(ShapeContact, AWheelRollsUnderEveryLaw) {
  const std::string solid =
      "orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.09; length = 0.04; mass = 2 kg; }";
  for (const char* law : {"hookpoint_reset", "nominal", "hunt_crossley", "azad_featherstone",
                          "lugre", "elastoplastic", "exponential"}) {
    Running run(yard(std::string("deltat = 0.05 ms; contact = ") + law + "; ", rolling(solid)));
    run.step(8000);
    const double before = downhill_speed(run);
    run.step(8000);
    EXPECT_NEAR((downhill_speed(run) - before) / 0.4, 2. / 3. * g * std::sin(5. * deg), 0.01)
        << law;
  }
}

// A tin stands on three points of its rim, k each; lying it stands on two.
TEST(ShapeContact, ATinStandsAndLies) {
  Running run(
      yard("deltat = 0.1 ms;",
           flat + "Robot up { Base.mobile { location = 0, 0, 0.1; Shape.Cylinder { radius = "
                  "0.05; length = 0.2; mass = 1 kg; } } } Robot down { Base.mobile { location = "
                  "1, 0, 0.05; orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.05; length "
                  "= 0.2; mass = 1 kg; } } }"));
  run.step(20000);
  EXPECT_NEAR(run["yard.up.position.z"], 0.1 - g / 3e5, 1e-9);
  EXPECT_NEAR(run["yard.down.position.z"], 0.05 - g / 2e5, 1e-9);
  EXPECT_NEAR(run["yard.up.position.x"], 0., 1e-9);
}

const char* const stairs_down =
    "Terrain.Steps stairs { height = -0.17; run = 3; from = 0.5; count = 1; spacing = 10 mm; size = 4, "
    "1; material = ground; } ";

std::string sole(double over) {
  return stairs_down + std::string("Robot foot { Base.mobile { location = 0.5 - 0.12 + 0.24*") +
         std::to_string(over) +
         ", 0, 0.02; Shape.Box { dimensions = 0.24, 0.12, 0.04; mass = 20 kg; } } }";
}

TEST(ShapeContact, ASoleWithItsCentreOverTheTreadStands) {
  Running run(yard("deltat = 0.1 ms;", sole(0.4)));
  run.step(20000);
  EXPECT_NEAR(run["yard.foot.position.z"], 0.0195, 5e-4);
  EXPECT_NEAR(run["yard.foot.orientation.y"], 0., 5e-3);
  EXPECT_LT(std::abs(run["yard.foot.angular_velocity.y"]), 1e-6);
}

// Ground so soft that the sole sinks in by 2 % of its length and leans back: it comes to rest, its corners
// and its edges over the nosing as deep as an exponential spring is under their parts of its weight.
TEST(ShapeContact, ASoleRestsOnSoftTreads) {
  Running run(yard("deltat = 0.1 ms; contact = exponential;", sole(0.4)));
  run.step(100000);
  EXPECT_LT(std::abs(run["yard.foot.velocity.z"]), 1e-7);
  EXPECT_LT(std::abs(run["yard.foot.angular_velocity.y"]), 1e-6);
  const double x = run["yard.foot.position.x"], z = run["yard.foot.position.z"];
  const double q = 2. * std::asin(run["yard.foot.orientation.y"]);
  const double heel = x - 0.12 * std::cos(q) - 0.02 * std::sin(q);
  const double on_nosing = 20. * g * (x - heel) / (0.5 - heel);
  const auto sunk = [](double load) { return std::log(load / 0.5336) / 1150.; };
  EXPECT_NEAR(std::sin(q) * (0.5 - x) - std::cos(q) * z + 0.02, sunk(0.5 * on_nosing), 1e-4);
  EXPECT_NEAR(0.02 * std::cos(q) - 0.12 * std::sin(q) - z, sunk(0.5 * (20. * g - on_nosing)), 1e-4);
}

// Its centre d past the nosing and h above it, it turns about the nosing: what its centre has lost in
// height at the angle q is in the turn, I w^2/2 = m g (h (1 - cos q) + d sin q).
TEST(ShapeContact, ASoleWithItsCentreInTheAirTips) {
  const double d = 0.024, h = 0.02, m = 20.;
  const double inertia = m * (0.24 * 0.24 + 0.04 * 0.04) / 12. + m * (d * d + h * h);
  Running run(yard("deltat = 0.05 ms;", sole(0.6)));
  const double start = 2. * std::asin(run["yard.foot.orientation.y"]);
  while (2. * std::asin(run["yard.foot.orientation.y"]) - start < 0.3) run.step(10);
  const double q = 2. * std::asin(run["yard.foot.orientation.y"]);
  const double w = run["yard.foot.angular_velocity.y"];
  EXPECT_NEAR(0.5 * inertia * w * w, m * g * (h * (1. - std::cos(q)) + d * std::sin(q)),
              0.04 * 0.5 * inertia * w * w);
}

// Gravity at 45 degrees lays a ball into the corner of tread and riser: each carries its part.
TEST(ShapeContact, ABallRestsInACorner) {
  Running run(
      yard("deltat = 0.05 ms; gravity = 6.936718, 0, -6.936718;",
           "Terrain.Steps stairs { height = 0.1; run = 2; from = 0.5; count = 1; spacing = 5 "
           "mm; size = 3, 0.5; material = ground; } Robot ball { Base.mobile { location = "
           "0.45, 0, 0.02; Shape.Sphere { radius = 0.02; mass = 1 kg; } } }",
           "static_friction = 0; kinetic_friction = 0;"));
  run.step(40000);
  EXPECT_NEAR(run["yard.ball.position.x"], 0.48 + 6.936718e-5, 1e-7);
  EXPECT_NEAR(run["yard.ball.position.z"], 0.02 - 6.936718e-5, 1e-7);
}

// A ball that runs into a riser comes back; it is neither thrown nor let through.
TEST(ShapeContact, ABallThatRunsIntoARiserComesBack) {
  for (const double speed : {0.5, 3., 12.}) {
    Running run(
        yard("deltat = 0.02 ms; gravity = 0;",
             "Terrain.Steps stairs { height = 0.1; run = 2; from = 0.5; count = 1; spacing = 5 "
             "mm; size = 3, 0.5; material = ground; } Robot ball { Base.mobile { location = "
             "0.4, 0, 0.05; velocity = " +
                 std::to_string(speed) + ", 0, 0; Shape.Sphere { radius = 0.02; mass = 1 kg; } } }",
             "static_friction = 0;"));
    run.step(static_cast<int>(0.25 / speed / 2e-5));
    const double back = -run["yard.ball.velocity.x"];
    EXPECT_GT(back, 0.) << speed;
    EXPECT_LE(back, speed) << speed;
    EXPECT_LT(std::abs(run["yard.ball.velocity.z"]), 1e-9 * speed + 1e-12) << speed;
  }
}

// Tiles of a plane are one face: the same bytes as on the plane.
TEST(ShapeContact, TilesOfAPlaneAreThePlane) {
  const std::string robots =
      "Robot ball { Base.mobile { location = -0.3, 0.01, 0.1; velocity = 1, 0.3, 0; Shape.Sphere { "
      "radius = 0.05; mass = 1 kg; } } } Robot box { Base.mobile { location = 0.4, 0, 0.12; velocity = "
      "1, 0, 0; orientation = 0.1, 0.2, 0.3; Shape.Box { dimensions = 0.2, 0.1, 0.1; mass = 1 kg; } } }";
  const auto end = [&](const std::string& terrain) {
    Running run(yard("deltat = 0.1 ms;", terrain + robots));
    run.step(8000);
    return std::array{run["yard.ball.position.x"], run["yard.ball.position.z"],
                      run["yard.box.position.x"], run["yard.box.position.z"],
                      run["yard.box.orientation.y"]};
  };
  EXPECT_EQ(end(flat),
            end("Terrain.Rough floor { amplitude = 0; wavelength = 1; spacing = 0.07; size "
                "= 4, 4; material = ground; } "));
}

// Momentum of two bodies that meet is that before, to rounding.
TEST(ShapeContact, BodiesThatMeetKeepTheirMomentum) {
  Running run(
      yard("deltat = 0.05 ms; gravity = 0;",
           "Robot ball { Base.mobile { location = 0, 0, 0; velocity = 1, 0, 0; Shape.Sphere { "
           "radius = 0.1; mass = 0.4 kg; } } } Robot box { Base.mobile { location = 0.26, 0.03, "
           "0.02; Shape.Box { dimensions = 0.3, 0.3, 0.3; mass = 2 kg; } } } Terrain.Flat floor "
           "{ height = -9; material = ground; }"));
  double most = 0.;
  for (int i = 0; i < 100; ++i) {
    run.step(100);
    const auto sum = [&](const char* axis) {
      const std::string velocity = std::string(".velocity.") + axis;
      return 0.4 * run["yard.ball" + velocity] + 2. * run["yard.box" + velocity];
    };
    most = std::max({most, std::abs(sum("x") - 0.4), std::abs(sum("y")), std::abs(sum("z"))});
  }
  EXPECT_LT(most, 1e-13);
  EXPECT_GT(run["yard.box.velocity.x"], 0.01);
}

// Flush or shifted, a box on a box rests, with its weight on the springs between them.
TEST(ShapeContact, BoxesRestOnBoxes) {
  for (const char* shift : {"0, 0", "0.013, 0", "0.013, 0.007"}) {
    Running run(yard("deltat = 0.1 ms;",
                     flat +
                         "Robot a { Base.mobile { location = 0, 0, 0.05; Shape.Box { dimensions = "
                         "0.1, 0.1, 0.1; mass = 1 kg; } } } Robot b { Base.mobile { location = " +
                         shift +
                         ", 0.15; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } }"));
    run.step(15000);
    EXPECT_NEAR(run["yard.a.position.z"], 0.05 - 2. * g / 4e5, 1e-6) << shift;
    EXPECT_NEAR(run["yard.b.position.z"], 0.15 - 3. * g / 4e5, 5e-5) << shift;
    for (const char* axis : {"x", "y", "z"})
      EXPECT_LT(std::abs(run[std::string("yard.b.velocity.") + axis]), 1e-6) << shift;
  }
}

// A tin on a post, and one on it, rim upon rim: three places of k each on the post's end; of two rims
// that lie on each other, three of either.
TEST(ShapeContact, TinsStandOnEachOther) {
  const std::string post =
      flat +
      "Obstacle.Cylinder post { radius = 0.1; length = 0.2; location = 0, 0, 0.1; material = "
      "ground; } ";
  const std::string tin = "Shape.Cylinder { radius = 0.05; length = 0.1; mass = 1 kg; } } } ";
  Running pile(
      yard("deltat = 0.1 ms;", post + "Robot a { Base.mobile { location = 0.03, 0, 0.25; " + tin +
                                   "Robot b { Base.mobile { location = 0.03, 0, 0.35; " + tin));
  pile.step(10000);
  EXPECT_NEAR(pile["yard.a.position.z"], 0.25 - 2. * g / 3e5, 1e-8);
  EXPECT_NEAR(pile["yard.b.position.z"] - pile["yard.a.position.z"], 0.1 - g / 6e5, 1e-8);
  // Its centre over the other's end, a tin stands; past it, it tips.
  for (const auto& [beside, stands] : {std::pair{0.045, true}, std::pair{0.055, false}}) {
    Running run(
        yard("deltat = 0.1 ms;",
             post +
                 "Obstacle.Cylinder foot { radius = 0.05; length = 0.1; location = 0, 0, 0.25; "
                 "material = ground; } Robot tin { Base.mobile { location = " +
                 std::to_string(beside) + ", 0, 0.35; " + tin));
    run.step(10000);
    EXPECT_EQ(std::abs(run["yard.tin.position.z"] - 0.35) < 1e-3, stands) << beside;
    if (stands) {
      EXPECT_NEAR(run["yard.tin.angular_velocity.y"], 0., 1e-6);
    }
  }
}

// A log in the groove between two others touches each along a line: its axis lies sqrt(4 r^2 - a^2/4)
// over theirs, a apart, but for what its weight presses.
TEST(ShapeContact, ALogLiesInTheGrooveBetweenTwo) {
  const double r = 0.05, apart = 0.12;
  const std::string lies =
      " orientation = pi/2, 0, 0; Shape.Cylinder { radius = 0.05; length = 0.4; mass = 1 kg; } } } ";
  const std::string post =
      " orientation = pi/2, 0, 0; radius = 0.05; length = 0.4; material = ground; } ";
  Running run(
      yard("deltat = 0.1 ms;", flat + "Obstacle.Cylinder left { location = -0.06, 0, 0.2;" + post +
                                   "Obstacle.Cylinder right { location = 0.06, 0, 0.2;" + post +
                                   "Robot log { Base.mobile { location = 0, 0.05, 0.281;" + lies));
  run.step(20000);
  EXPECT_NEAR(run["yard.log.position.z"], 0.2 + std::sqrt(4. * r * r - 0.25 * apart * apart), 1e-4);
  EXPECT_NEAR(run["yard.log.position.x"], 0., 1e-6);
  EXPECT_NEAR(run["yard.log.velocity.z"], 0., 1e-6);
  EXPECT_NEAR(run["yard.log.angular_velocity.z"], 0., 1e-6);
}

// A cone that rolls about its tip on a plane of slope b swings with w^2 = 5 g sin b cos a/(h (1 + 5 cos^2 a)),
// a half its opening: of its kinetic energy 3 m h^2 (1 + 5 cos^2 a) q'^2/40 (Landau and Lifshitz, Mechanics,
// section 32, problem 7), with its centre of mass 3 h/4 from the tip.
TEST(ShapeContact, AConeRollsAboutItsTip) {
  const double h = 0.2, r = 0.08, b = 20. * deg, half = std::atan(r / h);
  Running run(yard(
      "deltat = 0.05 ms; gravity = " + std::to_string(g * std::sin(b)) + ", 0, " +
          std::to_string(-g * std::cos(b)) + ";",
      flat + "Robot cone { Base.mobile { location = 0, 0, 0; orientation = 0, " +
          std::to_string(-half) +
          ", 0.1; Shape.Legcone { length = 0.2; proximal_radius = 0; distal_radius = 0.08; mass = 1 "
          "kg; } } }"));
  // Of the axis in the plane.
  const auto direction = [&] {
    const auto q = [&](const char* axis) {
      return run[std::string("yard.cone.orientation.") + axis];
    };
    const double x = 1. - 2. * (q("y") * q("y") + q("z") * q("z"));
    const double y = 2. * (q("x") * q("y") + q("w") * q("z"));
    return std::atan2(y, x);
  };
  std::vector<double> crossings;
  double before = direction();
  for (int i = 0; i < 80000; ++i) {
    run.step();
    const double now = direction();
    if ((before < 0.) != (now < 0.)) crossings.push_back((i + before / (before - now)) * 5e-5);
    before = now;
  }
  ASSERT_GE(crossings.size(), 4u);
  const double period =
      2. * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const double cosine = std::cos(half);
  const double rate = std::sqrt(5. * g * std::sin(b) * cosine / (h * (1. + 5. * cosine * cosine)));
  EXPECT_NEAR(period, 2. * std::numbers::pi / rate, 0.01 * period);
}

TEST(ShapeContact, AConeCarriesABox) {
  Running run(yard("deltat = 0.1 ms;",
                   flat +
                       "Robot cone { Base.mobile { location = 0, 0, 0; orientation = 0, -pi/2, 0; "
                       "Shape.Legcone { length = 0.2; proximal_radius = 0.1; distal_radius = 0.06; "
                       "mass = 2 kg; } } } Robot box { Base.mobile { location = 0.01, 0, 0.23; "
                       "Shape.Box { dimensions = 0.2, 0.2, 0.06; mass = 1 kg; } } }"));
  run.step(20000);
  EXPECT_NEAR(run["yard.box.position.z"], 0.23, 2e-4);
  EXPECT_NEAR(run["yard.box.velocity.z"], 0., 1e-6);
  EXPECT_NEAR(run["yard.box.orientation.w"], 1., 1e-6);
}

// A disc has no thickness, but two faces: what falls on either stays on it.
TEST(ShapeContact, ADiscCarriesABallAndLiesOnAPost) {
  for (const char* turn : {"0", "pi"}) {
    Running run(yard(
        "deltat = 0.1 ms;",
        flat +
            "Obstacle.Cylinder post { radius = 0.04; length = 0.2; location = 0, 0, 0.1; material = "
            "ground; } Robot plate { Base.mobile { location = 0, 0, 0.2001; orientation = " +
            turn +
            ", 0, 0; Shape.Disc { radius = 0.1; mass = 1 kg; } } } Robot ball { Base.mobile { location = "
            "0, 0, 0.2202; Shape.Sphere { radius = 0.02; mass = 0.1 kg; } } }"));
    run.step(10000);
    EXPECT_NEAR(run["yard.plate.position.z"], 0.2, 2e-4) << turn;
    EXPECT_NEAR(run["yard.ball.position.z"], 0.22, 2e-4) << turn;
  }
}

// Lying flat a disc is all below the face that carries it: on the ground, on a box, on a tin and on
// another disc, at m g/(3 k) for its three points.
TEST(ShapeContact, ADiscLiesFlat) {
  const std::string lies = "Shape.Disc { radius = 0.05; mass = 1 kg; } } } ";
  Running run(yard(
      "deltat = 0.1 ms;",
      flat +
          "Obstacle.Box box { dimensions = 0.4, 0.4, 0.2; location = 2, 0, 0.1; material = ground; } "
          "Obstacle.Cylinder post { radius = 0.1; length = 0.2; location = 3, 0, 0.1; material = "
          "ground; } Robot a { Base.mobile { location = 0, 0, 1e-4; " +
          lies +
          "Robot shelf { Base.fixed { location = 4, 0, 0.3; Shape.Disc { radius = 0.1; } } } Robot b { "
          "Base.mobile { location = 4.02, 0, 0.3001; " +
          lies + "Robot c { Base.mobile { location = 2.02, 0, 0.2001; orientation = pi, 0, 0; " +
          lies + "Robot d { Base.mobile { location = 3.01, 0, 0.22; orientation = 0.3, 0.2, 0; " +
          lies));
  run.step(20000);
  EXPECT_NEAR(run["yard.a.position.z"], -g / 3e5, 1e-8);
  EXPECT_NEAR(run["yard.b.position.z"], 0.3 - g / 3e5, 1e-8);
  EXPECT_NEAR(run["yard.c.position.z"], 0.2 - g / 3e5, 1e-8);
  EXPECT_NEAR(run["yard.d.position.z"], 0.2 - g / 3e5, 1e-6);
}

// A spring whose end goes round the rim of a disc, from the one face to the other, takes a ball along,
// always touching: it is a radius off, on that side on which it is.
TEST(ShapeContact, ABallGoesRoundTheRimOfADisc) {
  Running run(yard(
      "deltat = 0.05 ms; gravity = 0;",
      "Robot plate { Base.fixed { location = 0, 0, 0; Shape.Disc { radius = 0.1; } } } Robot ball { "
      "Base.mobile { location = 0.1, 0, 0.02; Shape.Sphere { radius = 0.02; mass = 0.1 kg; } } } Force "
      "pull { body = ball.base; } Expression x { formula = \"-1 N/mm * (ball.position.x - 0.1 m - 18 mm * "
      "sin(pi * min(time / (1 s), 1)) + 30 mm * max(0, time / (1 s) - 1))\"; unit = \"N\"; Wire TO "
      "pull.force.x; } Expression z { formula = \"-1 N/mm * (ball.position.z - 18 mm * cos(pi * "
      "min(time / (1 s), 1)))\"; unit = \"N\"; Wire TO pull.force.z; }",
      "static_friction = 0;"));
  for (int i = 0; i < 300; ++i) {
    run.step(100);
    const double x = run["yard.ball.position.x"], z = run["yard.ball.position.z"];
    ASSERT_NEAR(std::hypot(std::max(0., x - 0.1), z), 0.02, 5e-4) << i;
  }
  EXPECT_NEAR(run["yard.ball.position.z"], -0.02, 5e-4);
  EXPECT_LT(run["yard.ball.position.x"], 0.095);
}

// A disc that falls on a box's edge with its rim or one of its faces.
TEST(ShapeContact, ADiscIsStoppedByAnEdge) {
  for (const char* turn : {"0.7, 0.1, 0", "2.4, 0.1, 0", "pi/2, 0, 0.3", "pi/2, 0, 1.5"}) {
    Running run(
        yard("deltat = 0.02 ms;",
             flat +
                 "Obstacle.Box block { dimensions = 0.2, 0.6, 0.2; orientation = 0, pi/4, 0; "
                 "location = 0, 0, 0.15; material = ground; } Robot plate { Base.mobile { "
                 "location = 0.01, 0, 0.5; orientation = " +
                 std::string(turn) + "; Shape.Disc { radius = 0.06; mass = 0.5 kg; } } }"));
    run.step(7500);
    EXPECT_LT(run["yard.plate.velocity.z"], -1.4);
    double highest = -2.;
    for (int i = 0; i < 50; ++i) {
      run.step(100);
      highest = std::max(highest, run["yard.plate.velocity.z"]);
    }
    EXPECT_GT(highest, -0.6) << turn;
  }
}

// A state that is saved and restored goes on with the same bytes: hooks, faces that hold corners, and
// where everything stood.
TEST(ShapeContact, ASavedStateGoesOnAlike) {
  for (const char* law : {"hookpoint", "lugre"}) {
    Running run(
        yard(std::string("deltat = 0.1 ms; contact = ") + law + ";",
             std::string(stairs_down) +
                 "Robot foot { Base.mobile { location = 0.4, 0, 0.03; velocity = 0.5, 0, 0; "
                 "Shape.Box { dimensions = 0.24, 0.12, 0.04; mass = 2 kg; } } } Robot tin { "
                 "Base.mobile { location = 0.4, 0.02, 0.12; orientation = 0.3, 0, 0; "
                 "Shape.Cylinder { radius = 0.03; length = 0.1; mass = 1 kg; } } }"));
    run.step(1500);
    simulation::World& world = run.world();
    std::vector<double> numbers(world.state_size());
    world.save(numbers);
    const auto go_on = [&] {
      run.step(1500);
      std::vector<double> end(world.state_size());
      world.save(end);
      return end;
    };
    const std::vector<double> first = go_on();
    world.restore(numbers);
    EXPECT_EQ(go_on(), first) << law;
  }
}

// What is saved is what evolves: of boxes that have left the ground a new world has the same state as
// the one in which they touched it before.
TEST(ShapeContact, ASavedStateHoldsNothingOfContactsThatAreOver) {
  const std::string leaping = yard(
      "deltat = 0.2 ms;",
      flat +
          "For i in 0..1 { Robot box[i] { Base.mobile { location = i, 0, 0.0496; velocity = 0, "
          "0, 0.5; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } } }");
  Running run(leaping);
  std::vector<simulation::ContactView> contacts;
  run.step(1);
  run.world().tell_contacts(contacts);
  EXPECT_EQ(contacts.size(), 8u);
  run.step(100);
  run.world().tell_contacts(contacts);
  EXPECT_TRUE(contacts.empty());
  std::vector<double> middle(run.world().state_size()), end(middle.size()),
      other_end(middle.size());
  run.world().save(middle);
  run.step(5);
  run.world().save(end);
  Running other(leaping);
  other.world().restore(middle);
  other.step(5);
  other.world().save(other_end);
  EXPECT_EQ(other_end, end);
}

// A plate on fine rough ground touches in more places than there is room for: the deepest carry it, and
// the run says so.
TEST(ShapeContact, OfTooManyPlacesTheDeepestCarry) {
  Running run(
      "World yard { touch = shapes; gravity = 9.81; deltat = 0.2 ms; Material soft { "
      "normal_stiffness = 500 N/m; normal_damping = 20 N.s/m; } Terrain.Rough floor { amplitude = "
      "1 mm; wavelength = 40 mm; spacing = 10 mm; size = 1, 1; material = soft; } Robot plate { "
      "Base.mobile { location = 0, 0, 0.021; Shape.Box { dimensions = 0.2, 0.2, 0.04; mass = 5 kg; "
      "} } } }");
  run.step(1000);
  const auto says = [](const std::string& notice) {
    return notice.find("the deepest of them carry") != std::string::npos;
  };
  EXPECT_TRUE(std::ranges::any_of(run.world().state().notices, says));
  // Which places are the deepest changes, so the plate trembles; the mean force on it is its weight.
  const double before = run["yard.plate.velocity.z"];
  run.step(2000);
  EXPECT_NEAR(run["yard.plate.velocity.z"], before, 1e-3 * 9.81 * 0.4);
  EXPECT_NEAR(run["yard.plate.position.z"], 0.02, 0.01);
}

/// How far two boxes of `half` edges overlap: the least of their overlaps along the axes that may part
/// them (separating axes); < 0 where they are apart [m].
double overlap(const std::array<Vector3d, 2>& places, const std::array<Quaterniond, 2>& turns,
               const Vector3d& half) {
  std::vector<Vector3d> axes;
  for (const Quaterniond& turn : turns)
    for (const Vector3d& axis : {Vector3d{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
      axes.push_back(rotate(turn, axis));
  const std::vector<Vector3d> own = axes;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j < 6; ++j) axes.push_back(cross(own[i], own[j]));
  double least = HUGE_VAL;
  for (const Vector3d& axis : axes) {
    const double length = norm(axis);
    if (length < 1e-6) continue;
    double reach = -std::abs(dot(axis, places[1] - places[0]));
    for (std::size_t k = 0; k < 6; ++k)
      reach += std::abs(dot(axis, own[k])) * std::array{half.x, half.y, half.z}[k % 3];
    least = std::min(least, reach / length);
  }
  return least;
}

// Boxes that fall on one another in any attitude lie apart in the end, but for what their weight presses.
TEST(ShapeContact, AHeapOfBoxesLiesApart) {
  constexpr int count = 8;
  std::string boxes;
  for (int i = 0; i < count; ++i)
    boxes += "Robot b" + std::to_string(i) +
             " { Base.mobile { location = " + std::to_string(0.05 * std::cos(2.4 * i)) + ", " +
             std::to_string(0.05 * std::sin(2.4 * i)) + ", " + std::to_string(0.1 + 0.1 * i) +
             "; orientation = " + std::to_string(0.3 * i) + ", " + std::to_string(0.2 * i) + ", " +
             std::to_string(0.7 * i) +
             "; Shape.Box { dimensions = 0.1, 0.1, 0.06; mass = 0.5; } } } ";
  Running run(
      yard("deltat = 0.2 ms;", flat + boxes, "static_friction = 0.5; kinetic_friction = 0.5;"));
  run.step(15000);
  const auto at = [&](int i, const char* what) {
    return run["yard.b" + std::to_string(i) + ".base." + what];
  };
  double deepest = -HUGE_VAL;
  for (int i = 0; i < count; ++i) {
    EXPECT_LT(at(i, "velocity.z"), 1e-3);
    for (int j = i + 1; j < count; ++j) {
      const auto place = [&](int k) {
        return Vector3d{at(k, "location.x"), at(k, "location.y"), at(k, "location.z")};
      };
      const auto turn = [&](int k) {
        return Quaterniond{at(k, "orientation.w"), at(k, "orientation.x"), at(k, "orientation.y"),
                           at(k, "orientation.z")};
      };
      deepest =
          std::max(deepest, overlap({place(i), place(j)}, {turn(i), turn(j)}, {0.05, 0.05, 0.03}));
    }
  }
  EXPECT_LT(deepest, 2e-3);
}

}  // namespace
}  // namespace hookpoint
