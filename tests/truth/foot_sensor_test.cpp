// A foot's force sensor at its own rate: a reading is the impulse of the ground over the sensor's
// period by that period, whatever the step and whatever the law or engine makes of a step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "reference/engines.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// 1 kg that stands for 1 s on its ground, with a sensor of 200 Hz.
std::string standing(std::string_view engine, std::string_view law, std::string_view deltat) {
  return fmt::format(
      "World w {{ gravity = 9.81; deltat = {}; engine = {}; contact = {}; "
      "Material m {{ normal_stiffness = 20 kN/m; normal_damping = 150; tangential_stiffness = 20 "
      "kN/m; tangential_damping = 150; static_friction = 0.8; kinetic_friction = 0.8; }} "
      "Terrain.Flat g {{ material = m; }} Robot foot {{ Base.mobile {{ location = 0, 0, 0.02; "
      "Shape.Box {{ dimensions = 0.1, 0.1, 0.04; mass = 1 kg; }} }} }} "
      "Sensor.Foot plate {{ body = foot.base; rate = 200 Hz; threshold = 2 N; }} }}",
      deltat, engine, law);
}

/// Every reading of the second half of a second is the weight within `error` [N], flag 1.
void expect_weight(const std::string& text, double error,
                   simulation::EngineFactory make = simulation::make_dts) {
  Running run(text, make);
  const double* normal = run.port("w.plate.normal").value;
  const double* flag = run.port("w.plate.contact").value;
  const double* time = run.port("w.time").value;
  double least = 1e9, greatest = -1e9, flags = 1.;
  while (*time < 1.) {
    run.step();
    if (*time < 0.5) continue;
    least = std::min(least, *normal);
    greatest = std::max(greatest, *normal);
    flags = std::min(flags, *flag);
  }
  EXPECT_NEAR(least, 9.81, error) << text;
  EXPECT_NEAR(greatest, 9.81, error) << text;
  EXPECT_EQ(flags, 1.) << text;
}

// Under an impulse law a foot that stands moves up and down with at most the law's rebound speed u0
// = 1 mm/s. Of momentum balance over a period T the mean force differs from the weight by at most
// 2 m u0/T = 0.4 N, whatever the step; of single steps it is 0 or twice the weight.
TEST(FootSensor, ReadsTheWeightUnderImpulses) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    for (const char* deltat : {"0.1 ms", "0.5 ms"})
      expect_weight(standing("dts", law, deltat), 2. * 1e-3 / 5e-3);
  }
}

TEST(FootSensor, ReadsTheWeightUnderForces) {
  expect_weight(standing("dts", "hookpoint", "0.1 ms"), 1e-6);
  expect_weight(standing("dts", "hookpoint", "1 ms"), 1e-6);
}

TEST(FootSensor, ReadsTheWeightInEveryEngine) {
  for (const auto& peer : reference::peers())
    expect_weight(standing(peer.name, "hookpoint", "0.5 ms"), 0.01 * 9.81, peer.make);
}

// A push of the ground that lasts less than a period: the reading is its impulse by the period, and
// the flag says that there was contact. A ball of 1 kg that falls from 4.905 cm and comes to rest
// in the ground or rebounds with e changes its momentum by (1 + e) m v, v = 0.981 m/s.
TEST(FootSensor, FeelsAnImpactOfOneStep) {
  const std::string text =
      "World w { gravity = 9.81; deltat = 0.1 ms; contact = impulse; Material m { restitution = 0.5; "
      "} Terrain.Flat g { material = m; } Robot ball { Base.mobile { location = 0, 0, 0.14905; "
      "Shape.Sphere { radius = 0.1; mass = 1 kg; } } } "
      "Sensor.Foot plate { body = ball.base; rate = 20 Hz; } }";
  Running run(text);
  const double* normal = run.port("w.plate.normal").value;
  const double* flag = run.port("w.plate.contact").value;
  double impulse = 0., flags = 0.;
  // Falls until 0.1 s, is back there after 0.1 s more.
  for (int reading = 1; reading <= 3; ++reading) {
    run.step(500);
    impulse += *normal * 0.05;
    flags += *flag;
  }
  EXPECT_NEAR(impulse, 1.5 * 0.981, 1.5 * 9.81 * 1e-4);
  EXPECT_EQ(flags, 1.);
}

}  // namespace
}  // namespace hookpoint
