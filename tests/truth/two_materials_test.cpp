// Friction of both sides of a contact: a sled on a slope with a front pad of one material and a rear
// runner of another, against the balance of forces and moments by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, degree = std::numbers::pi / 180.;

/// A sled of 2 kg whose centre of mass is 50 mm above its four points, 0.1 m before and behind it.
std::string sled(double angle, const std::string& world, const std::string& base,
                 const std::string& front, const std::string& rear) {
  return "World w { deltat = 0.1 ms; " + world +
         " Material floor { normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = "
         "1e5; tangential_damping = 300; static_friction = 0.5; kinetic_friction = 0.5; } "
         "Material rubber { static_friction = 0.9; } Material steel { static_friction = 0.1; } "
         "Terrain.Slope ground { angle = " +
         std::to_string(angle) +
         " deg; material = floor; } Robot sled { Base.mobile { rest_on = ground; settled = false; "
         "mass = 2; inertia = 0.02, 0.02, 0.02, 0, 0, 0; " +
         base + " For y in -0.1, 0.1 { ContactPoint { location = 0.1, y, -0.05; " + front +
         " } ContactPoint { location = -0.1, y, -0.05; " + rear + " } } } } }";
}

double downhill(const Running& run, double angle) {
  return run["sled.velocity.x"] * std::cos(angle * degree) -
         run["sled.velocity.z"] * std::sin(angle * degree);
}

/// Of the sled as it slides: N1 + N2 = m g cos, (N1 - N2) l = h (mu1 N1 + mu2 N2).
double acceleration(double angle, double front, double rear) {
  const double l = 0.1, h = 0.05;
  const double share = (l + h * rear) / ((l - h * front) + (l + h * rear));  // of the front
  const double friction = front * share + rear * (1. - share);
  return g * (std::sin(angle * degree) - friction * std::cos(angle * degree));
}

double measured(Running& run, double angle) {
  run.step(2000);
  const double before = downhill(run, angle);
  run.step(2000);
  return (downhill(run, angle) - before) / 0.2;
}

const std::string rubber = "material = rubber;", steel = "material = steel;";

TEST(TwoMaterials, ASledHoldsByItsRubberAlone) {
  Running run(sled(20., "", "", rubber, steel));
  run.step(10000);
  const double z = run["sled.position.z"];
  run.step(5000);
  EXPECT_NEAR(run["sled.position.z"], z, 1e-6);
}

TEST(TwoMaterials, EachFootSlidesWithItsOwnFriction) {
  Running run(sled(35., "", "", rubber, steel));
  EXPECT_NEAR(measured(run, 35.), acceleration(35., 0.9, 0.1), 1e-3);
  Running turned(sled(35., "", "", steel, rubber));
  EXPECT_NEAR(measured(turned, 35.), acceleration(35., 0.1, 0.9), 1e-3);
}

TEST(TwoMaterials, ABodysMaterialIsTheDefaultOfItsPoints) {
  Running run(sled(35., "", steel, rubber, ""));
  EXPECT_NEAR(measured(run, 35.), acceleration(35., 0.9, 0.1), 1e-3);
}

TEST(TwoMaterials, TheWorldsRuleAndAPairDecide) {
  const struct {
    const char* world;
    double front, rear;
  } cases[] = {
      {"combine = ground;", 0.5, 0.5},
      {"combine = minimum;", 0.5, 0.1},
      {"combine = product;", 0.45, 0.05},
      {"combine = geometric;", std::sqrt(0.45), std::sqrt(0.05)},
      {"combine = harmonic;", 0.9 / 1.4, 0.1 / 0.6},
      {"combine = series;", 0.45 / 1.4, 0.05 / 0.6},
      {"combine = maximum; Pair { a = floor; b = steel; material = frost; } Material frost { "
       "static_friction = 0.05; }",
       0.9, 0.05},
  };
  for (const auto& [world, front, rear] : cases) {
    Running run(sled(40., world, "", rubber, steel));
    EXPECT_NEAR(measured(run, 40.), acceleration(40., front, rear), 2e-3) << world;
  }
}

TEST(TwoMaterials, StiffnessesAreInSeriesWhereBothStateOne) {
  const auto depth = [](const std::string& rubber_stiffness) {
    Running run(
        "World w { deltat = 0.1 ms; Material floor { normal_stiffness = 2000; "
        "normal_damping = 100; } Material rubber { " +
        rubber_stiffness +
        " } Terrain.Flat ground { material = floor; } Robot r { Base.mobile { rest_on = "
        "ground; mass = 1; inertia = 1, 1, 1, 0, 0, 0; material = rubber; For x in -1, 1 { "
        "For y in -1, 1 { ContactPoint { location = x, y, 0; } } } } } }");
    run.step(100);
    return -run["r.position.z"];
  };
  const double load = g / 4.;
  EXPECT_NEAR(depth(""), load / 2000., 1e-9);
  EXPECT_NEAR(depth("normal_stiffness = 3000;"), load / 1200., 1e-9);
}

/// Impulse laws read the same constants.
TEST(TwoMaterials, ImpulsesHaveTheFootsFriction) {
  Running run(sled(35., "contact = impulse;", steel, "", ""));
  EXPECT_NEAR(measured(run, 35.), acceleration(35., 0.1, 0.1), 2e-2);
}

/// Under touch = shapes as under touch = points.
TEST(TwoMaterials, ShapesHaveTheirMaterials) {
  for (const char* const touch : {"points", "shapes"}) {
    Running run(std::string("World w { deltat = 0.1 ms; touch = ") + touch +
                "; Material floor { static_friction = 0.9; } Material steel { static_friction = "
                "0.1; } Terrain.Slope ground { angle = 30 deg; material = floor; } Robot sled { "
                "Base.mobile { rest_on = ground; settled = false; Shape.Cylinder { radius = 0.1; "
                "length = 0.02; mass = 2; material = steel; } } } }");
    run.step(1000);
    const double before = downhill(run, 30.);
    run.step(1000);
    EXPECT_NEAR((downhill(run, 30.) - before) / 0.1,
                g * (std::sin(30. * degree) - 0.1 * std::cos(30. * degree)), 2e-2)
        << touch;
  }
}

}  // namespace
}  // namespace hookpoint
