// A body that rests on its ground starts in static balance, unless it says `settled = false`. A
// block on a slope against the statics of a rigid body on springs, and that nothing moves, under
// every force law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/force_law.h"
#include "studies/measure/metric.h"
#include "studies/predictions/predictions.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, weight = 2. * g, half = 0.1, height = 0.05, k = 20e3, k_t = 10e3;
constexpr double slope = 15. * std::numbers::pi / 180.;

/// A box of 0.2 x 0.2 x 0.1 m and 2 kg on its four corners.
std::string block(const std::string& law, double degrees) {
  return "World w { gravity = 9.81; deltat = 0.1 ms; contact = " + law +
         "; Material m { normal_stiffness = 20 kN/m; normal_damping = 100; tangential_stiffness = "
         "10 kN/m; tangential_damping = 50; static_friction = 0.8; kinetic_friction = 0.7; "
         "exponent "
         "= 1; hysteresis_damping = 0.3; regularisation_speed = 1 mm/s; exponential_force = 0.5; "
         "exponential_rate = 2000; nominal_stiffness = 10 kN/m; nominal_penetration = 1 mm; breakaway "
         "= 0.7; restitution = 0.3; } "
         "Terrain.Slope s { angle = " +
         std::to_string(degrees) +
         " deg; azimuth = 30 deg; material = m; } Robot b { Base.mobile { rest_on = s; settled = "
         "true; yaw = 20 deg; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 2 kg; } } } }";
}

Vector3d vector(const Running& run, const std::string& port) {
  return {run[port + ".x"], run[port + ".y"], run[port + ".z"]};
}

// However it is turned, four corners of a square with half edge a have the second moment 4 a^2
// about an axis along the tile. The pull of the springs, W sin, has the lever h below the centre,
// and a lean phi carries the corners uphill by h phi under the load W cos:
//   4 a^2 k phi = W h sin + W h phi cos
TEST(SettledStart, LeansAndStretchesAsStaticsSays) {
  const Loaded loaded = load_text(block("hookpoint", 15.));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "");
  const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
  const contact::TilePoint below =
      contact::Terrain(*loaded.experiment->terrain).query(robot.location);
  const Vector3d& n = below.normal;
  EXPECT_NEAR(std::acos(n.z), slope, 1e-12);
  ASSERT_TRUE(robot.settled);
  ASSERT_EQ(robot.settled->stretch.size(), 8U);
  Vector3d pull;
  for (const Vector3d& stretch : robot.settled->stretch) pull += k_t * stretch;
  EXPECT_LT(norm(pull - tangential(Vector3d{0., 0., -weight}, n)), 1e-9 * weight);
  const double lean = weight * height * std::sin(slope) /
                      (4. * half * half * k - weight * height * std::cos(slope));
  const Vector3d up = rotate(robot.orientation, Vector3d{0., 0., 1.});
  EXPECT_NEAR(norm(cross(up, n)), lean, 2e-3 * lean);
  EXPECT_NEAR(-below.depth, height * std::cos(lean) - weight * std::cos(slope) / (4. * k), 1e-9);
}

TEST(SettledStart, NothingMovesUnderAnyLawThatHolds) {
  for (const contact::LawDescription& law : contact::law_table()) {
    if (law.is_impulse_law || law.name == "hunt_crossley") continue;
    SCOPED_TRACE(law.name);
    for (const char* integrator : {"semi_implicit_euler", "rk4", "cvode_bdf"}) {
      SCOPED_TRACE(integrator);
      const Loaded loaded =
          load_text(block(std::string(law.name) + "; integrator = " + integrator, 15.));
      ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
      Running run(loaded);
      const Vector3d start = vector(run, "w.b.base.location");
      run.step();
      EXPECT_LT(norm(vector(run, "w.b.base.linear_acceleration")), 1e-8 * g);
      EXPECT_LT(norm(vector(run, "w.b.base.angular_acceleration")), 1e-7 * g / half);
      run.step(2000);
      EXPECT_LT(norm(vector(run, "w.b.base.location") - start), 1e-12);
      EXPECT_LT(norm(vector(run, "w.b.base.velocity")), 1e-11);
    }
  }
}

// Kept in the plane of the slope, it leans by the same angle; nothing turns it otherwise.
TEST(SettledStart, OfABaseInAPlaneIsInThePlane) {
  std::string text = block("hookpoint", 15.);
  for (const auto& [from, to] : {std::pair{"azimuth = 30 deg", "azimuth = 0 deg"},
                                 {"Base.mobile", "Base.planar"},
                                 {"yaw = 20 deg; ", ""}})
    text.replace(text.find(from), std::string(from).size(), to);
  Running run(text);
  const double lean = weight * height * std::sin(slope) /
                      (4. * half * half * k - weight * height * std::cos(slope));
  const double turned =
      2. * std::atan2(run["w.b.base.orientation.y"], run["w.b.base.orientation.w"]);
  EXPECT_NEAR(std::abs(std::abs(turned) - slope), lean, 2e-3 * lean);
  const Vector3d start = vector(run, "w.b.base.location");
  run.step(2000);
  EXPECT_LT(norm(vector(run, "w.b.base.location") - start), 1e-12);
}

// On the level the points carry as levers say: a centre of mass c beside the middle leans the body
// by W c/(4 a^2 k - W h).
TEST(SettledStart, LeansUnderALoadBesideTheMiddle) {
  constexpr double c = 0.02;
  std::string text = block("hookpoint", 0.);
  text.replace(text.find("yaw = 20 deg; "), 14,
               "center_of_mass = 0.02, 0, 0; mass = 2; inertia = 0.01, 0.01, 0.01, 0, 0, 0; ");
  const std::size_t of_shape = text.rfind("mass = 2 kg; ");
  text.erase(of_shape, 13);
  const Loaded loaded = load_text(text);
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const Vector3d up = rotate(loaded.experiment->robots.at(0).orientation, Vector3d{0., 0., 1.});
  const double lean = weight * c / (4. * half * half * k - weight * height);
  EXPECT_NEAR(norm(Vector3d{up.x, up.y, 0.}), lean, 5e-3 * lean);
  EXPECT_GT(up.x, 0.) << "towards the load";
}

// A law without tangential spring holds by creeping: v_s phi^-1(tan/mu) from time 0 on, with
// phi(s) = s/sqrt(1 + s^2) and, at that speed, the static coefficient but for Stribeck's drop.
TEST(SettledStart, ALawWithoutSpringStartsWithItsCreep) {
  // Its friction is a damper of mu N/v_s, 16 kN s/m in all.
  std::string text = block("hunt_crossley", 15.);
  text.replace(text.find("deltat = 0.1 ms"), 15, "deltat = 0.01 ms");
  const Loaded loaded = load_text(text);
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const contact::LawDescription& law = *contact::find_force_law("hunt_crossley");
  const double creep =
      law.creep_speed(std::tan(slope), loaded.experiment->materials.at(0).constants).value();
  Running run(loaded);
  EXPECT_NEAR(norm(vector(run, "w.b.base.velocity")), creep, 1e-6 * creep);
  run.step();
  EXPECT_LT(norm(vector(run, "w.b.base.linear_acceleration")), 1e-7 * g);
  run.step(20000);
  EXPECT_NEAR(norm(vector(run, "w.b.base.velocity")), creep, 1e-6 * creep);
}

std::string without(std::string text, const std::string& part) {
  return text.erase(text.find(part), part.size());
}

// Slack springs: the block deflects by what they take.
TEST(SettledStart, IsLeftOutWhereTheFileSaysSo) {
  std::string text = block("hookpoint", 15.);
  text.replace(text.find("settled = true"), 14, "settled = false");
  Running run(text);
  const Vector3d start = vector(run, "w.b.base.location");
  run.step(20000);
  EXPECT_NEAR(norm(vector(run, "w.b.base.location") - start), weight * std::sin(slope) / (4. * k_t),
              0.2 * weight * std::sin(slope) / (4. * k_t));
}

// Every law with tangential springs, without a word in the file; a point, whose stretch is all of
// m g sin/k_t, and a block.
TEST(SettledStart, IsTheDefaultOfLawsWithSprings) {
  for (const contact::LawDescription& law : contact::law_table()) {
    if (law.is_impulse_law || law.name == "hunt_crossley") continue;
    for (const double degrees : {5., 20.}) {
      SCOPED_TRACE(std::string(law.name) + " " + std::to_string(degrees));
      const std::string plain = without(block(std::string(law.name), degrees), "settled = true; ");
      std::string point = plain;
      const std::string box = "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 2 kg; }";
      point.replace(point.find(box), box.size(),
                    "mass = 2; inertia = 0.01, 0.01, 0.01, 0, 0, 0; ContactPoint tip { }");
      for (const std::string& text : {plain, point}) {
        const Loaded loaded = load_text(text);
        ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
        EXPECT_EQ(loaded.diagnostics.find("settled"), std::string::npos) << loaded.diagnostics;
        const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
        ASSERT_TRUE(robot.settled);
        Vector3d pull;
        for (const Vector3d& stretch : robot.settled->stretch) pull += k_t * stretch;
        EXPECT_NEAR(norm(pull), weight * std::sin(degrees * std::numbers::pi / 180.),
                    1e-9 * weight);
        Running run(loaded);
        run.step();
        EXPECT_LT(norm(vector(run, "w.b.base.linear_acceleration")), 1e-9 * g);
        for (int i = 0; i < 1000; ++i) {
          run.step();
          ASSERT_LT(norm(vector(run, "w.b.base.velocity")), 1e-9);
        }
      }
    }
  }
}

// Nothing gives from a balance, under bristles either, whose give from slack springs has no closed
// form; slack springs give W sin/(4 k_t).
TEST(SettledStart, ClosedFormsKnowIt) {
  for (const char* law : {"hookpoint", "lugre"}) {
    for (const bool settled : {true, false}) {
      SCOPED_TRACE(std::string(law) + (settled ? " settled" : " slack"));
      std::string text = block(law, 15.);
      if (!settled) text.replace(text.find("settled = true"), 14, "settled = false");
      const Loaded loaded = load_text(text);
      ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
      const studies::RunContext context = studies::make_context(*loaded.experiment, 0.5, 1.);
      const auto shift = studies::predict("stick_displacement", context);
      const auto creep = studies::predict("creep_speed", context);
      const double give = weight * std::sin(slope) / (4. * k_t);
      if (settled) {
        ASSERT_TRUE(shift) << shift.why();
        EXPECT_EQ(*shift, 0.);
      } else if (std::string(law) == "hookpoint") {
        ASSERT_TRUE(shift) << shift.why();
        EXPECT_NEAR(*shift, give, 1e-12 * give);
      }
      if (settled && std::string(law) == "hookpoint") {
        const auto rest = studies::tangential_give(context);
        ASSERT_TRUE(rest) << rest.why();
        EXPECT_NEAR(*rest, give, 1e-12 * give);
      }
      ASSERT_TRUE(creep) << creep.why();
      EXPECT_EQ(*creep, 0.);
    }
  }
}

// What is meant to move starts as it always did, and says nothing: a slope steeper than friction
// holds, a ball, a law that holds by creeping, an impulse law, a base with a speed.
TEST(SettledStart, IsLevelWithoutAWordWhereNothingRests) {
  const std::string holds = without(block("hookpoint", 15.), "settled = true; ");
  std::string ball = holds, moving = holds;
  const std::string box = "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 2 kg; }";
  ball.replace(ball.find(box), box.size(), "Shape.Sphere { radius = 0.1; mass = 2 kg; }");
  moving.replace(moving.find("yaw"), 0, "velocity = 1, 0, 0; ");
  for (const std::string& text :
       {without(block("hookpoint", 45.), "settled = true; "), ball, moving,
        without(block("hunt_crossley", 15.), "settled = true; ")}) {
    const Loaded loaded = load_text(text);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(loaded.diagnostics.find("settled"), std::string::npos) << loaded.diagnostics;
    const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
    EXPECT_FALSE(robot.settled);
    const contact::TilePoint below =
        contact::Terrain(*loaded.experiment->terrain).query(robot.location);
    const Vector3d up = rotate(robot.orientation, Vector3d{0., 0., 1.});
    EXPECT_LT(norm(cross(up, below.normal)), 1e-12);
  }
}

// A link whose centre of mass lies on its joint's axis loads no joint, so that the robot rests as
// one rigid body of 2 kg with its centre of mass in the middle. A robot with joints starts in
// balance only where the file says so.
TEST(SettledStart, OfARobotWithJointsIsThatOfOneRigidBody) {
  std::string text = block("hookpoint", 15.);
  const std::string end = "mass = 2 kg; } } }";
  text.replace(text.find(end), end.size(),
               "mass = 1 kg; } } Chain arm { Link tip { mass = 1 kg; inertia = 0.001, 0.001, "
               "0.001, 0, 0, 0; } } }");
  const Loaded written = load_text(text);
  ASSERT_TRUE(written.experiment) << written.diagnostics;
  const simulation::RobotSpec& robot = written.experiment->robots.at(0);
  ASSERT_TRUE(robot.settled);
  Vector3d pull;
  for (const Vector3d& stretch : robot.settled->stretch) pull += k_t * stretch;
  // 2 kg in all, whichever body they are on.
  EXPECT_NEAR(norm(pull), weight * std::sin(slope), 1e-9 * weight);
  Running run(written);
  run.step();
  EXPECT_LT(norm(vector(run, "w.b.base.linear_acceleration")), 1e-8 * g);
  const Loaded plain = load_text(without(text, "settled = true; "));
  ASSERT_TRUE(plain.experiment) << plain.diagnostics;
  EXPECT_FALSE(plain.experiment->robots.at(0).settled);
}

TEST(SettledStart, SaysWhereNothingBalances) {
  const Loaded steep = load_text(block("hookpoint", 45.));
  ASSERT_TRUE(steep.experiment) << steep.diagnostics;
  EXPECT_NE(steep.diagnostics.find("`b` cannot start settled"), std::string::npos)
      << steep.diagnostics;
  EXPECT_FALSE(steep.experiment->robots.at(0).settled);
  const Loaded away = load_text(
      "World w { Terrain.Flat f; Robot b { Base.mobile { settled = true; location = 0, 0, 1; "
      "Shape.Sphere { radius = 0.1; mass = 1; } } } }");
  EXPECT_FALSE(away.experiment);
  EXPECT_NE(away.diagnostics.find("settled goes with rest_on"), std::string::npos)
      << away.diagnostics;
}

}  // namespace
}  // namespace hookpoint
