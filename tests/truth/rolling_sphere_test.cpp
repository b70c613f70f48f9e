// A ball rolls: the ground feels the slip of its material, not the wandering of the place that
// touches. Closed forms under every force law are in configs/scenes/rolling_sphere.hook and
// slide_to_roll.hook; here, what must hold whatever the integrator, the frame and the moment at
// which a run is saved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "contact/terrain/rolling.h"
#include "integrators/stepper.h"
#include "tests/support/run_text.h"
#include "tests/support/scene.h"

namespace hookpoint {
namespace {

constexpr double degree = std::numbers::pi / 180.;
constexpr double g = 9.81;

/// A ball of 1 kg and 0.1 m, told how its body touches the ground.
std::string ball_on(const std::string& terrain, const std::string& touches,
                    const std::string& motion = "rest_on = ground;",
                    const std::string& world = "") {
  return "World w { deltat = 0.2 ms; " + world +
         " Material m { normal_stiffness = 20000; normal_damping = 100; tangential_stiffness = "
         "20000; tangential_damping = 100; static_friction = 0.3; kinetic_friction = 0.3; } " +
         terrain + " Robot ball { Base.mobile { " + motion +
         " mass = 1; inertia = 0.004, 0.004, 0.004, 0, 0, 0; " + touches + " } } }";
}
const std::string ball_point = "ContactPoint ball { radius = 0.1; }";
std::string slope_of(double angle, double azimuth) {
  return "Terrain.Slope ground { material = m; angle = " + std::to_string(angle) +
         " deg; azimuth = " + std::to_string(azimuth) + " deg; }";
}
const std::string level = "Terrain.Flat ground { material = m; }";

double downhill_speed(const Running& run, double angle, double azimuth) {
  const double a = angle * degree, z = azimuth * degree;
  return run["ball.velocity.x"] * std::cos(a) * std::cos(z) +
         run["ball.velocity.y"] * std::cos(a) * std::sin(z) - run["ball.velocity.z"] * std::sin(a);
}

TEST(RollingSphere, RollsDownEverySlopeItsFrictionHolds) {
  for (const double angle : {5., 30., 46.}) {  // tan(46 deg) = 1.036 < 3.5 mu = 1.05
    Running run(ball_on(slope_of(angle, 0.), ball_point));
    run.step(1500);
    const double before = downhill_speed(run, angle, 0.);
    run.step(2000);
    const double a = (downhill_speed(run, angle, 0.) - before) / 0.4;
    EXPECT_NEAR(a, 5. / 7. * g * std::sin(angle * degree), 1e-6) << angle;
    EXPECT_EQ(run["ball.base.ball.contact.sliding"], 0.) << angle;
  }
}

TEST(RollingSphere, SkidsDownASteeperOne) {
  const double angle = 47.;  // tan = 1.072
  Running run(ball_on(slope_of(angle, 0.), ball_point));
  run.step(1500);
  const double before = downhill_speed(run, angle, 0.), spin = run["ball.angular_velocity.y"];
  run.step(2000);
  const double s = std::sin(angle * degree), c = std::cos(angle * degree);
  EXPECT_NEAR((downhill_speed(run, angle, 0.) - before) / 0.4, g * (s - 0.3 * c), 1e-6);
  EXPECT_NEAR((run["ball.angular_velocity.y"] - spin) / 0.4, 2.5 * 0.3 * g * c / 0.1, 1e-4);
}

/// Its hook has to be carried round with it, in each integrator's own way of committing memory.
TEST(RollingSphere, RollsOnForeverOnTheLevel) {
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    const std::string integrator(stepper.name);
    const Loaded loaded = load_text(ball_on(
        level, ball_point, "rest_on = ground; velocity = 2, 0, 0; angular_velocity = 0, 20, 0;",
        "integrator = " + integrator + ";"));
    Running run(loaded);
    run.step(5000);  // more than three turns
    EXPECT_NEAR(run["ball.velocity.x"], 2., 1e-9) << integrator;
    EXPECT_NEAR(run["ball.angular_velocity.y"], 20., 1e-8) << integrator;
    EXPECT_NEAR(run["ball.base.ball.contact.hook.x"], run["ball.position.x"], 1e-9) << integrator;
    EXPECT_NEAR(run["ball.base.ball.position.z"], -g / 20000., 1e-8) << integrator;
  }
}

TEST(RollingSphere, IsTheSameInEveryDirection) {
  Running straight(ball_on(slope_of(20., 0.), ball_point));
  straight.step(2000);
  for (const double azimuth : {33., 135., 260.}) {
    Running turned(ball_on(slope_of(20., azimuth), ball_point));
    turned.step(2000);
    EXPECT_NEAR(downhill_speed(turned, 20., azimuth), downhill_speed(straight, 20., 0.), 1e-9)
        << azimuth;
  }
}

/// A body that starts turned rolls as one that does not: only its rotation since counts.
TEST(RollingSphere, DoesNotDependOnTheBodysAxes) {
  const std::string at = "location = 0, 0, 0.0995; velocity = 1, 0, 0; ";
  Running plain(ball_on(level, ball_point, at));
  Running turned(ball_on(level, ball_point, at + "orientation = 40 deg, -70 deg, 120 deg;"));
  plain.step(2000);
  turned.step(2000);
  for (const char* port : {"ball.position.x", "ball.velocity.x", "ball.angular_velocity.y"})
    EXPECT_NEAR(turned[port], plain[port], 1e-10) << port;
}

TEST(RollingSphere, APointIsABallOfRadiusZero) {
  const std::string motion = "rest_on = ground; velocity = 1, 0.5, 0; angular_velocity = 3, 2, 1;";
  const std::string feet[] = {"-0.1,-0.1,-0.1", "0.1,-0.1,-0.1", "0,0.1,-0.1"};
  std::string points, balls;
  for (const std::string& foot : feet) {
    points += "ContactPoint { location = " + foot + "; } ";
    balls += "ContactPoint { location = " + foot + "; radius = 0; } ";
  }
  Running a(ball_on(level, points, motion)), b(ball_on(level, balls, motion));
  ASSERT_EQ(a.world().state_size(), b.world().state_size());
  a.step(1000);
  b.step(1000);
  for (const char* port : {"ball.position.x", "ball.velocity.z", "ball.orientation.w"})
    EXPECT_EQ(a[port], b[port]) << port;
}

TEST(RollingSphere, GoesOnFromASavedStateToTheLastBit) {
  const std::string text = ball_on(slope_of(20., 10.), ball_point);
  Running whole(text), resumed(text);
  whole.step(777);
  std::vector<double> saved(whole.world().state_size());
  whole.world().save(saved);
  whole.step(500);
  resumed.world().restore(saved);
  resumed.step(500);
  for (const char* port : {"ball.position.x", "ball.velocity.y", "ball.angular_velocity.x"})
    EXPECT_EQ(resumed[port], whole[port]) << port;
}

TEST(RollingSphere, AShapeIsOneBallUnlessItsSurfaceIsToBeSampled) {
  const auto base = [](const std::string& shape) {
    const Loaded loaded = load_text("World w { Robot b { Base.mobile { mass = 1; " + shape +
                                    " } Chain c { Link l { mass = 1; Shape.Sphere radius = 2; } } "
                                    "} }");
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    return loaded.experiment->robots[0].base;
  };
  const simulation::BodySpec one = base(
      "ContactPoint { location = 1, 0, 0; } Shape.Sphere { radius = 0.5; location = 0, 0, 1; }");
  ASSERT_EQ(one.boundary_points.size(), 2U);
  EXPECT_EQ(one.boundary_points[1], (Vector3d{0., 0., 1.}));
  EXPECT_EQ(one.boundary_radius(0), 0.);
  EXPECT_EQ(one.boundary_radius(1), 0.5);
  const simulation::BodySpec many = base("Shape.Sphere { radius = 0.5; boundary_points = 4; }");
  EXPECT_EQ(many.boundary_points.size(), 26U);
  EXPECT_EQ(many.boundary_radius(25), 0.);
}

/// Over an edge the touching place jumps round a ball that stands still: nothing slips.
TEST(RollingSphere, NothingSlipsWhereTheNormalTurns) {
  const Vector3d n0{0., 0., 1.}, n{std::sin(0.2), 0., std::cos(0.2)};
  const double r = 0.3;
  const Vector3d moved = contact::rolling_displacement({{}, n0}, {{}, n}, r);
  EXPECT_NEAR(norm(moved - r * (n0 - n)), 0., 1e-15);  // the place moves by -r dn, the hook too
  // Rolling about y by phi on the plane takes place and hook r phi along x.
  const Quaterniond turned = exponential(Vector3d{0., 0.4, 0.});
  EXPECT_NEAR(
      norm(contact::rolling_displacement({{}, n0}, {turned, n0}, r) - Vector3d{r * 0.4, 0., 0.}),
      0., 1e-15);
}

TEST(RollingSphere, PassesTheEdgesOfTilesUnfelt) {
  const std::string grid =
      "Terrain.Rough ground { material = m; amplitude = 0; wavelength = 0.4; spacing = 0.05; "
      "slope = 20 deg; azimuth = 15 deg; size = 8; }";
  Running plane(ball_on(slope_of(20., 15.), ball_point)), tiles(ball_on(grid, ball_point));
  plane.step(2500);
  tiles.step(2500);
  for (const char* port : {"ball.position.x", "ball.position.y", "ball.angular_velocity.x"})
    EXPECT_NEAR(tiles[port], plane[port], 1e-9) << port;
}

}  // namespace
}  // namespace hookpoint
