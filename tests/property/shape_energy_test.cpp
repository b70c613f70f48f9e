// Shapes dropped on random ground and on each other: without friction and damping nothing ever has more
// energy than at the start; with them everything stays above the ground.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "tests/support/drawn.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using test_support::drawn;

/// A World of three bodies at drawn places over drawn ground.
std::string drawn_yard(unsigned seed, const std::string& material) {
  std::mt19937_64 random(seed);
  const auto place = [&](double x, double z) {
    return fmt::format("location = {}, {}, {}; orientation = {}, {}, {};",
                       x + drawn(random, -0.2, 0.2), drawn(random, -0.2, 0.2), z,
                       drawn(random, -3., 3.), drawn(random, -1.5, 1.5), drawn(random, -3., 3.));
  };
  const bool steps = seed % 3 == 0;
  const std::string ground =
      steps ? fmt::format(
                  "Terrain.Steps floor {{ height = {}; run = {}; from = 0.1; count = 4; size = "
                  "6, 6; material = stuff; }}",
                  drawn(random, -0.1, 0.1), drawn(random, 0.15, 0.5))
            : fmt::format(
                  "Terrain.Rough floor {{ amplitude = {}; wavelength = 0.4; spacing = 0.05; size "
                  "= 8, 8; seed = {}; material = stuff; }}",
                  drawn(random, 0., 0.06), seed);
  const double apart = seed % 2 == 0 ? 1. : 0.25;
  return fmt::format(
      "World yard {{ touch = shapes; gravity = 9.81; deltat = 0.05 ms; Material stuff {{ {} }} {} "
      "Robot ball {{ Base.mobile {{ {} Shape.Sphere {{ radius = 0.05; mass = 1 kg; }} }} }} "
      "Robot box {{ Base.mobile {{ {} Shape.Box {{ dimensions = 0.2, 0.15, 0.1; mass = 1 kg; }} }} }} "
      "Robot tin {{ Base.mobile {{ {} Shape.Cylinder {{ radius = 0.06; length = 0.15; mass = 1 kg; }} "
      "}} }} }}",
      material, ground, place(0., 0.6), place(apart, 0.7 + 0.3 * (1. - apart)),
      place(-apart, 0.8 + 0.6 * (1. - apart)));
}

double energy(const Running& run) {
  double sum = 0.;
  for (const char* body : {"ball", "box", "tin"})
    sum += run[fmt::format("yard.{}.kinetic_energy", body)] +
           run[fmt::format("yard.{}.potential_energy", body)];
  return sum;
}

class DrawnYards : public ::testing::TestWithParam<unsigned> {};

TEST_P(DrawnYards, GainNoEnergy) {
  Running run(drawn_yard(GetParam(),
                         "normal_stiffness = 50 kN/m; normal_damping = 0; "
                         "tangential_stiffness = 50 kN/m; tangential_damping = 0; "
                         "static_friction = 0; kinetic_friction = 0;"));
  const double start = energy(run);
  double most = start;
  for (int i = 0; i < 150; ++i) {
    run.step(100);
    most = std::max(most, energy(run));
  }
  // Semi-implicit Euler's own ripple: 1/2 dt w of the energy in a spring.
  EXPECT_LT(most - start, 0.01 * start) << drawn_yard(GetParam(), "");
}

TEST_P(DrawnYards, StayAboveTheGround) {
  Running run(drawn_yard(GetParam(),
                         "normal_stiffness = 50 kN/m; normal_damping = 200; "
                         "tangential_stiffness = 50 kN/m; tangential_damping = 200; "
                         "static_friction = 0.6; kinetic_friction = 0.6;"));
  for (int i = 0; i < 150; ++i) {
    run.step(100);
    for (const char* body : {"ball", "box", "tin"})
      ASSERT_GT(run[fmt::format("yard.{}.position.z", body)], -0.5) << body;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnYards, ::testing::Range(1u, 5u));

}  // namespace
}  // namespace hookpoint
