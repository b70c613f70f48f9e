// What a Material does beside its law: resistance to rolling and spinning, adhesion, friction across
// the foot; and what a body publishes of its contacts. Against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

/// Ground of 1e5 N/m a point with `constants`, and what stands on it.
std::string scene(const std::string& constants, const std::string& rest,
                  const std::string& world = "") {
  return "World w { deltat = 0.1 ms; " + world +
         " Material m { normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = 1e5; "
         "tangential_damping = 300; " +
         constants + " } Terrain.Flat ground { material = m; } " + rest + " }";
}

/// A solid ball of 1 kg and 0.1 m that rolls at 1 m/s and spins about the vertical.
std::string ball(double spin) {
  return "Robot ball { Base.mobile { rest_on = ground; velocity = 1, 0, 0; angular_velocity = 0, "
         "10, " +
         std::to_string(spin) + "; Shape.Sphere { radius = 0.1; mass = 1; } } }";
}

class SurfaceForces : public ::testing::TestWithParam<const char*> {
 protected:
  std::string touch() const { return std::string("touch = ") + GetParam() + ";"; }
};
INSTANTIATE_TEST_SUITE_P(Touch, SurfaceForces, ::testing::Values("points", "shapes"));

TEST_P(SurfaceForces, ARollingBallStops) {
  const double b = 0.02, r = 0.1, a = 5. / 7. * g * b / r;
  Running run(scene("rolling_resistance = 0.02;", ball(0.), touch()));
  run.step(5000);
  EXPECT_NEAR(run["ball.velocity.x"], 1. - a * 0.5, 1e-3);
  run.step(5000);
  EXPECT_NEAR(run["ball.velocity.x"], 0., 1e-3);
  EXPECT_NEAR(run["ball.position.x"], 0.5 / a, 2e-3);
}

TEST_P(SurfaceForces, ASpinningBallLosesItsSpinEvenly) {
  const double s = 0.002, I = 0.4 * 0.01;
  Running run(scene("spinning_resistance = 0.002;",
                    "Robot ball { Base.mobile { rest_on = ground; angular_velocity = 0, 0, 10; "
                    "Shape.Sphere { radius = 0.1; mass = 1; } } }",
                    touch()));
  run.step(10000);
  EXPECT_NEAR(run["ball.angular_velocity.z"], 10. - s * g / I, 1e-3);
  EXPECT_NEAR(run["ball.velocity.x"], 0., 1e-9);
}

/// Without the constants nothing brakes.
TEST_P(SurfaceForces, ABallWithoutResistanceRollsOn) {
  Running run(scene("", ball(1.), touch()));
  run.step(5000);
  EXPECT_NEAR(run["ball.velocity.x"], 1., 1e-6);
}

/// Deceleration from 0.3 to 0.8 s of robot b, which rolls along x.
double braking(const std::string& text) {
  Running run(text);
  run.step(3000);
  const double before = run["b.velocity.x"];
  run.step(5000);
  return (before - run["b.velocity.x"]) / 0.5;
}

/// A body of 1 kg with `shape` of radius 0.1 m about the world's y, which rolls at 1 m/s on `ground`.
std::string rolls(const std::string& ground, const std::string& turn, const std::string& shape) {
  return "World w { deltat = 0.1 ms; gravity = 9.81; Material m { normal_stiffness = 1e5; "
         "normal_damping = 300; tangential_stiffness = 1e5; tangential_damping = 300; "
         "rolling_resistance = 2 mm; } " +
         ground + " Robot b { Base.mobile { location = 0, 0, 0.0999; orientation = " + turn +
         "; velocity = 1, 0, 0; angular_velocity = 0, 10, 0; mass = 1; inertia = 0.005, 0.005, 0.005, "
         "0, 0, 0; " +
         shape + " } } }";
}
const std::string flat = "Terrain.Flat ground { material = m; }";

// The moment b N and the friction F give m a = F and I a/r = b N - F r: a = g b/(r (1 + I/(m r^2))), with
// I = m r^2/2 here for every shape.
TEST(RollingResistance, BrakesEveryRoundShape) {
  const double a = g * 0.002 / (0.1 * 1.5);
  const std::string lying = "pi/2, 0, 0";
  for (
      const char* shape :
      {"Shape.Sphere { radius = 0.1; }", "Shape.Cylinder { radius = 0.1; length = 0.05; }",
       "Shape.Capsule { radius = 0.1; length = 0.05; }", "Shape.Disc { radius = 0.1; }",
       "Shape.Legcone { length = 0.05; proximal_radius = 0.1; distal_radius = 0.1; orientation = 0, "
       "pi/2, 0; location = 0, 0, 0.025; }"})
    EXPECT_NEAR(braking(rolls(flat, lying, shape)), a, 0.01 * a) << shape;
}

TEST(RollingResistance, BrakesOnEveryGround) {
  const double a = g * 0.002 / (0.1 * 1.5);
  for (const char* ground :
       {"Obstacle.Box ground { dimensions = 10, 10, 1; location = 0, 0, -0.5; material = m; }",
        "Terrain.Steps ground { height = 0.1; run = 1; from = 3; count = 1; material = m; }"})
    for (const char* shape :
         {"Shape.Sphere { radius = 0.1; }", "Shape.Cylinder { radius = 0.1; length = 0.05; }"})
      EXPECT_NEAR(braking(rolls(ground, "pi/2, 0, 0", shape)), a, 0.01 * a) << ground << shape;
  EXPECT_NEAR(
      braking(rolls("Terrain.Rough ground { amplitude = 1e-9; wavelength = 0.4; material = m; }",
                    "0, 0, 0", "Shape.Sphere { radius = 0.1; }")),
      a, 0.01 * a);
}

// A car of M on a wheel of m: (M + m) a = F and I a/r = b (M + m) g - F r.
TEST(RollingResistance, BrakesAWheel) {
  const double a = 0.002 * 2. * g / (0.1 * (2. + 0.5));
  EXPECT_NEAR(
      braking(
          "World w { gravity = 9.81; deltat = 0.1 ms; Material m { rolling_resistance = 2 mm; } "
          "Terrain.Flat ground { material = m; } Robot b { Base.planar { plane = xz; location = 0, "
          "0, 0.0999; velocity = 1, 0, 0; mass = 1; inertia = 0.01, 0.01, 0.01, 0, 0, 0; } Chain f "
          "{ hip_orientation = -pi/2, 0, 0; Link wheel { rate = 10; mass = 1; Shape.Cylinder { "
          "radius = 0.1; length = 0.05; } } } } }"),
      a, 0.01 * a);
}

/// Spin about the vertical that robot b of 1 kg and I = 0.005 kg m^2 has after 0.5 s, from 10 rad/s and
/// without friction.
double spin_left(const std::string& ground, double height, const std::string& shape) {
  Running run(
      "World w { deltat = 0.1 ms; gravity = 9.81; Material m { normal_stiffness = 1e5; normal_damping = "
      "300; static_friction = 0; kinetic_friction = 0; spinning_resistance = 1 mm; } " +
      ground + " Robot b { Base.mobile { location = 0, 0, " + std::to_string(height) +
      "; angular_velocity = 0, 0, 10; mass = 1; inertia = 0.005, 0.005, 0.005, 0, 0, 0; " + shape +
      " } } }");
  run.step(5000);
  return run["b.angular_velocity.z"];
}

// I w' = -s m g on a ball and on a tin that stands, on whatever it stands; corners of a box have no radius.
TEST(SpinningResistance, SlowsRoundShapesAndNoCorners) {
  const double left = 10. - 0.001 * g / 0.005 * 0.5;
  const std::string box =
      "Obstacle.Box ground { dimensions = 9, 9, 1; location = 0, 0, -0.5; material = m; }";
  const std::string post =
      "Obstacle.Cylinder ground { radius = 1; length = 1; location = 0, 0, -0.5; material = m; }";
  const std::string rough =
      "Terrain.Rough ground { amplitude = 1e-9; wavelength = 0.4; material = m; }";
  for (const std::string& ground : {flat, box, post, rough}) {
    EXPECT_NEAR(spin_left(ground, 0.0999, "Shape.Sphere { radius = 0.1; }"), left, 2e-3) << ground;
    EXPECT_NEAR(spin_left(ground, 0.02, "Shape.Cylinder { radius = 0.1; length = 0.04; }"), left,
                2e-3)
        << ground;
    EXPECT_NEAR(spin_left(ground, 0.02, "Shape.Box { dimensions = 0.1, 0.1, 0.04; }"), 10., 0.01)
        << ground;
  }
}

/// A magnet foot of 2 kg on a wall: four points of 15 N hold it by friction, less what pulls at it;
/// more than 60 N tears it off.
TEST_P(SurfaceForces, AMagnetHoldsUntilItIsTornOff) {
  const auto foot = [this](const std::string& pull) {
    return scene("adhesion = 15 N; static_friction = 0.5; kinetic_friction = 0.5;",
                 "Robot foot { Base.mobile { location = 0, 0, 0.03985; Shape.Box { dimensions = "
                 "0.08, 0.08, 0.08; mass = 2; } } } Force tear { body = foot.base; } "
                 "Signal.Step later { start = 0.3; initial = 0; final = " +
                     pull + "; Wire TO tear.force.z; }",
                 touch() + " gravity = -9.81, 0, 0;");
  };
  Running held(foot("15"));
  held.step(3000);
  EXPECT_NEAR(held["foot.contact.force.z"], 0., 0.1);
  held.step(3000);
  EXPECT_NEAR(held["foot.contact.force.z"], -15., 0.1);
  EXPECT_NEAR(held["foot.velocity.x"], 0., 1e-4);
  // 60 N less 30 N press it on: friction of 15 N does not hold its weight.
  Running slipping(foot("30"));
  slipping.step(4000);
  const double before = slipping["foot.velocity.x"];
  slipping.step(2000);
  EXPECT_NEAR((slipping["foot.velocity.x"] - before) / 0.2, -(g - 0.5 * 30. / 2.), 1e-2);
  EXPECT_LT(slipping["foot.position.z"], 0.04);
  Running torn(foot("80"));
  torn.step(6000);
  // Of 80 N, 60 N hold over the 0.15 mm to the surface; then 40 m/s^2 for 0.3 s.
  EXPECT_NEAR(torn["foot.position.z"], 0.04 + 0.5 * 40. * 0.09, 0.05);
}

/// 0.02 along the blade, 0.8 across it, pushed at 45 degrees: the slip gives up the most that the
/// ellipse allows, so that the blade stops sideways within v^2/(2 mu g) = 31 mm and glides on. It is
/// flat: friction of 0.8 tips a foot over that is narrower than 0.8 times its height.
TEST_P(SurfaceForces, ASkateGlidesAlongItsBlade) {
  Running run(scene("static_friction = 0.02; friction_across = 0.8;",
                    "Robot skate { Base.mobile { rest_on = ground; velocity = 0.7, 0.7, 0; "
                    "Shape.Box { dimensions = 0.3, 0.1, 0.01; mass = 2; } } }",
                    touch() + " contact = hookpoint;"));
  run.step(10000);
  const double sideways = 0.49 / (2. * 0.8 * g);
  EXPECT_NEAR(run["skate.position.y"], sideways, 1.5e-3);
  EXPECT_NEAR(run["skate.velocity.y"], 0., 2e-3);
  // Along it the ellipse brakes by mu g at most, and hardly while it slips sideways.
  EXPECT_NEAR(run["skate.velocity.x"], 0.7 - 0.02 * g * (1. - 0.09), 0.01);
}

/// Turned by 90 degrees it glides the other way: the axis is the body's.
TEST_P(SurfaceForces, TheBladeTurnsWithItsBody) {
  Running run(scene("static_friction = 0.02; friction_across = 0.8;",
                    "Robot skate { Base.mobile { rest_on = ground; yaw = 90 deg; velocity = 0.7, "
                    "0.7, 0; Shape.Box { dimensions = 0.3, 0.1, 0.01; mass = 2; } } }",
                    touch()));
  run.step(10000);
  EXPECT_NEAR(run["skate.position.x"], 0.49 / (2. * 0.8 * g), 1.5e-3);
  EXPECT_GT(run["skate.velocity.y"], 0.4);
}

/// 300 N on a sole, 60 mm before its middle: moment -18 N m, centre of pressure at 60 mm.
TEST_P(SurfaceForces, ASolePublishesItsCentreOfPressure) {
  Running run(scene("",
                    "Robot sole { Base.mobile { rest_on = ground; mass = 1; inertia = 0.01, 0.01, "
                    "0.01, 0, 0, 0; Shape.Box { dimensions = 0.24, 0.12, 0.03; } } } Force load { "
                    "body = sole.base; point = 0.06, 0, 0; force = 0, 0, -290.19; }",
                    touch()));
  run.step(10000);
  const double moment = -0.06 * 290.19;
  EXPECT_NEAR(run["sole.contact.moment.y"], moment, 0.05);
  EXPECT_NEAR(run["sole.contact.moment.x"], 0., 1e-6);
  EXPECT_NEAR(run["sole.contact.normal_load"], 300., 1e-2);
  EXPECT_NEAR(run["sole.contact.center_of_pressure.x"] - run["sole.position.x"],
              0.06 * 290.19 / 300., 5e-4);
  EXPECT_NEAR(run["sole.base.contact.moment.y"], run["sole.contact.moment.y"], 0.);
  EXPECT_NEAR(run["sole.contact.tangential_load"], 0., 0.05);
}

/// Impulse laws read none of them, and a run says so once, of the ground's material and of a foot's.
TEST(SurfaceConstants, AreSaidToBeUnreadUnderAnImpulseLaw) {
  const auto diagnostics = [](const std::string& law) {
    return load_text("World w { contact = " + law +
                     "; Material m { adhesion = 1 N; restitution = 0.1; } Material foot { "
                     "rolling_resistance = 1 mm; } Terrain.Flat ground { material = m; } Robot r { "
                     "Base.mobile { Shape.Sphere { radius = 0.1; mass = 1; material = foot; } } } "
                     "}")
        .diagnostics;
  };
  const std::string said = diagnostics("impulse");
  EXPECT_NE(said.find("`adhesion` is not read by contact law impulse"), std::string::npos) << said;
  EXPECT_NE(said.find("`rolling_resistance` is not read by"), std::string::npos) << said;
  EXPECT_EQ(diagnostics("hookpoint").find("adhesion"), std::string::npos);
}

TEST(ContactPorts, APointPublishesItsLoads) {
  Running run(scene("static_friction = 0.9;",
                    "Robot r { Base.mobile { rest_on = ground; mass = 1; inertia = 1, 1, 1, 0, 0, "
                    "0; For y in -0.1, 0.1 { ContactPoint { location = -0.1, y, 0; } } "
                    "ContactPoint toe { location = 0.2, 0, 0; } } } Force push { body = r.base; "
                    "force = 3, 0, 0; }"));
  run.step(20000);
  EXPECT_NEAR(run["r.base.toe.contact.normal_load"], g / 3., 1e-3);
  EXPECT_NEAR(run["r.contact.normal_load"], g, 1e-3);
  EXPECT_NEAR(run["r.contact.tangential_load"], 3., 1e-3);
}

}  // namespace
}  // namespace hookpoint
