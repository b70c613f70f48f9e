// `settled = true`: a body that rests on its ground starts in static balance. A block on a slope
// against the statics of a rigid body on springs, and that nothing moves, under every force law.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/force_law.h"
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
         "exponential_rate = 2000; nominal_stiffness = 10 kN/m; nominal_penetration = 1 mm; } "
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
  ASSERT_EQ(robot.start_stretch.size(), 8U);
  Vector3d pull;
  for (const Vector3d& stretch : robot.start_stretch) pull += k_t * stretch;
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
  const contact::AnyForceLaw law = *contact::find_force_law("hunt_crossley");
  const double creep =
      contact::creep_speed(law, std::tan(slope), loaded.experiment->materials.at(0).constants)
          .value();
  Running run(loaded);
  EXPECT_NEAR(norm(vector(run, "w.b.base.velocity")), creep, 1e-6 * creep);
  run.step();
  EXPECT_LT(norm(vector(run, "w.b.base.linear_acceleration")), 1e-7 * g);
  run.step(20000);
  EXPECT_NEAR(norm(vector(run, "w.b.base.velocity")), creep, 1e-6 * creep);
}

// Slack springs, by default: the block gives by what they take.
TEST(SettledStart, IsNotTheDefault) {
  std::string text = block("hookpoint", 15.);
  text.replace(text.find("settled = true; "), 16, "");
  Running run(text);
  const Vector3d start = vector(run, "w.b.base.location");
  run.step(20000);
  EXPECT_NEAR(norm(vector(run, "w.b.base.location") - start), weight * std::sin(slope) / (4. * k_t),
              0.2 * weight * std::sin(slope) / (4. * k_t));
}

TEST(SettledStart, SaysWhereNothingBalances) {
  const Loaded steep = load_text(block("hookpoint", 45.));
  ASSERT_TRUE(steep.experiment) << steep.diagnostics;
  EXPECT_NE(steep.diagnostics.find("`b` cannot start settled"), std::string::npos)
      << steep.diagnostics;
  EXPECT_TRUE(steep.experiment->robots.at(0).start_stretch.empty());
  const Loaded away = load_text(
      "World w { Terrain.Flat f; Robot b { Base.mobile { settled = true; location = 0, 0, 1; "
      "Shape.Sphere { radius = 0.1; mass = 1; } } } }");
  EXPECT_FALSE(away.experiment);
  EXPECT_NE(away.diagnostics.find("settled goes with rest_on"), std::string::npos)
      << away.diagnostics;
}

}  // namespace
}  // namespace hookpoint
