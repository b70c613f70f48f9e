// A World that says nothing of its step, its ground or its law holds what stands on it: the cube of
// a newcomer's first file, dropped on its edge, comes to rest.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, mass = 1., edge = 0.1;

TEST(DefaultWorld, HoldsADroppedCubeAtRest) {
  const Loaded loaded = load_text(
      "World w { duration = 20 s; Terrain.Flat f; Robot r { Base.mobile { location = 0, 0, 0.15; "
      "orientation = 10 deg, 0, 0; Shape.Cube { dimensions = 0.1, 0.1, 0.1; mass = 1 kg; } } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const double stiffness = loaded.experiment->materials.at(0).constants.normal_stiffness;
  Running run(loaded);
  const int steps = static_cast<int>(std::lround(1. / loaded.experiment->deltat));
  const double inertia = mass * edge * edge / 6.;
  const auto kinetic = [&] {
    double energy = 0.;
    for (const char* axis : {"x", "y", "z"}) {
      const double v = run[std::string("w.r.base.velocity.") + axis];
      const double w = run[std::string("w.r.base.angular_velocity.") + axis];
      energy += 0.5 * (mass * v * v + inertia * w * w);
    }
    return energy;
  };
  // A fall of 0.1 m and what it leaves; the ground gives nothing.
  const double whole = mass * g * 0.15;
  double greatest = 0.;
  for (int second = 0; second < 10; ++second) {
    for (int i = 0; i < steps; ++i) {
      run.step();
      greatest = std::max(greatest, kinetic() + mass * g * run["w.r.base.location.z"]);
    }
  }
  EXPECT_LT(greatest, whole * (1. + 1e-3));
  const double x = run["w.r.base.location.x"], y = run["w.r.base.location.y"];
  // It tips about an edge, whose distance from the middle is edge/sqrt(2).
  EXPECT_LT(std::hypot(x, y), edge);
  EXPECT_LT(kinetic(), 1e-12);
  run.step(10 * steps);
  EXPECT_LT(std::hypot(run["w.r.base.location.x"] - x, run["w.r.base.location.y"] - y), 1e-9);
  EXPECT_LT(kinetic(), 1e-18);
  // On a face, m g/4 on the spring of each corner.
  EXPECT_NEAR(run["w.r.base.location.z"], 0.5 * edge - mass * g / (4. * stiffness), 1e-9);
}

}  // namespace
}  // namespace hookpoint
