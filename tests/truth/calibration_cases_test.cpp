// Measurements that are made up from closed forms, with noise: a drop that bounces and a slide that
// stops, many cases in a table each. The search by distances finds what they were made with, inside
// the interval that it tells.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

#include "studies/calibrate/calibration.h"
#include "tests/support/command.h"
#include "tests/support/planned.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

constexpr double gravity = 9.81, restitution = 0.6, friction = 0.3;
constexpr double noise = 2e-3;                               // [m]
const double mean_noise = std::sqrt(2. / std::numbers::pi);  ///< of |a normal error|, in its spread
/// Of twelve intervals of 95 % fewer hold the truth with a chance of 2 % only.
constexpr int least_of_twelve = 10;

constexpr const char* drop_scene = R"(
Param begin = 0.1 m;
World world {
  gravity = 9.81;
  deltat = 1 ms;
  contact = impulse;
  Material floor { restitution = 0.3; static_friction = 0.5; kinetic_friction = 0.5; rebound_speed = 5 mm/s; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, begin; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)";

constexpr const char* slide_scene = R"(
Param begin = 1 m/s;
Param mu = 0.6;
World world {
  gravity = 9.81;
  deltat = 1 ms;
  contact = hookpoint;
  integrator = rk4;
  Material floor { normal_stiffness = 100 kN/m; tangential_stiffness = 100 kN/m; normal_damping = 300; tangential_damping = 300; static_friction = mu; kinetic_friction = mu; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, -9.81 / 100000 * 1 m; velocity = begin, 0, 0; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)";

/// Height of a point let fall from `height`, whose every bounce keeps e of the speed.
double bouncing(double time, double height) {
  double speed = std::sqrt(2. * gravity * height), landing = speed / gravity;
  if (time < landing) return height - 0.5 * gravity * time * time;
  while (true) {
    speed *= restitution;
    const double since = time - landing, flight = 2. * speed / gravity;
    if (since < flight) return speed * since - 0.5 * gravity * since * since;
    if (flight < 1e-6) return 0.;
    landing += flight;
  }
}

/// Way of a body that slides from `speed` until Coulomb's friction has stopped it.
double sliding(double time, double speed) {
  const double until = std::min(time, speed / (friction * gravity));
  return speed * until - 0.5 * friction * gravity * until * until;
}

class MeasuredCases : public ::testing::Test {
 protected:
  MeasuredCases()
      : application_({}, [](const language::Diagnostics& found) {
          for (const language::Diagnostic& diagnostic : found.all())
            ADD_FAILURE() << diagnostic.message;
        }) {}

  /// Tables of cases, each begun with another value of the Param `begin`; `seed` is the noise's.
  void measure(const std::string& unit, double from, double to,
               const std::function<double(double time, double begin)>& truth,
               std::uint64_t seed = 1, int cases = 10) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> error(0., noise);
    std::string states = "case,begin [" + unit + "]\n", curves = "case,time [s],way [m]\n";
    for (int i = 0; i < cases; ++i) {
      const double begin = from + (to - from) * i / (cases - 1);
      states += std::to_string(i) + "," + std::to_string(begin) + "\n";
      for (int sample = 0; sample <= 60; ++sample) {
        const double time = 0.01 * sample;
        curves += std::to_string(i) + "," + std::to_string(time) + "," +
                  std::to_string(truth(time, begin) + error(random)) + "\n";
      }
    }
    place_.file("states.csv", states);
    place_.file("curves.csv", curves);
  }

  /// What became of the one constant, and its range.
  SubjectCalibration calibrate(const std::string& port, const std::string& vary,
                               const std::string& more = "") {
    const auto file = place_.file(
        "measured.hook",
        "Calibrate measured { scene = \"scene.hook\"; method = cmaes; generations = 8; "
        "population = 8; " +
            more +
            "\n"
            "  Cases case { file = \"states.csv\"; case = case;\n"
            "    Trace way { file = \"curves.csv\"; column = way; time = \"time\"; of = " +
            port + "; weight = 1 / (2 mm); } }\n  Vary " + vary + " }\n");
    const auto plans = planned_calibrations(application_, file);
    CalibrationOptions options;
    options.run.jobs = 2;
    options.run.folder = place_.folder() / "out";
    const std::atomic<bool> stop = false;
    return run_calibration(plans.front(), application_.engines(), options, stop).result.subjects[0];
  }

  /// What is made up: the scene, the Param `begin` of its cases, their truth, and what is asked.
  struct Question {
    const char* scene;
    const char* unit;
    double from, to;
    double (*truth)(double time, double begin);
    const char* port;
    const char* constant;
  };

  /// Twelve noises, of which enough leave the constant's value inside the interval.
  void expect_told(const Question& asked, double value) {
    place_.file("scene.hook", asked.scene);
    int inside = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      measure(asked.unit, asked.from, asked.to, asked.truth, seed);
      const SubjectCalibration found = calibrate(
          asked.port, std::string(asked.constant) + " { from = 0; to = 1; }", "folds = 0;");
      ASSERT_EQ(found.constants.size(), 1U) << "seed " << seed << ": " << found.status;
      const FittedConstant& constant = found.constants.front();
      EXPECT_TRUE(constant.identifiable) << "seed " << seed << ": " << constant.reason;
      EXPECT_LT(*constant.high - *constant.low, 0.02) << "seed " << seed;
      EXPECT_NEAR(*found.error, mean_noise, 0.1) << "seed " << seed;
      if (*constant.low <= value && value <= *constant.high) ++inside;
    }
    EXPECT_GE(inside, least_of_twelve);
  }

  Workplace place_;
  application::Application application_;
};

TEST_F(MeasuredCases, ADropTellsTheRestitution) {
  expect_told({drop_scene, "m", 0.05, 0.23, bouncing, "point.base.location.z", "restitution"},
              restitution);
}

TEST_F(MeasuredCases, ASlideTellsTheFriction) {
  expect_told({slide_scene, "m/s", 0.6, 1.95, sliding, "point.base.location.x", "mu"}, friction);
}

TEST_F(MeasuredCases, WhatAFoldHasNotSeenIsAsItPromised) {
  place_.file("scene.hook", slide_scene);
  measure("m/s", 0.6, 1.95, sliding, 1, 60);
  const SubjectCalibration found =
      calibrate("point.base.location.x", "mu { from = 0; to = 1; }", "most_cases = 6;");
  ASSERT_EQ(found.folds.size(), 5U);
  int kept = 0;
  std::size_t held = 0;
  for (const FoldResult& fold : found.folds) {
    ASSERT_TRUE(fold.prediction);
    held += fold.held_out.size();
    EXPECT_NEAR(fold.prediction->error, mean_noise, 0.1);
    // A case's mean of 61 spreads by sqrt(1 - 2/pi)/sqrt(61) = 0.077, twelve and twelve of them
    // differ by 2.2 * 0.077 sqrt(2/12) = 0.07.
    EXPECT_NEAR(fold.prediction->high - fold.prediction->low, 0.14, 0.07);
    if (fold.prediction->low <= *fold.held && *fold.held <= fold.prediction->high) ++kept;
  }
  EXPECT_GE(kept, 4);
  EXPECT_EQ(held, 54U);  // all but those of the first search, where the folds' begin
}

TEST_F(MeasuredCases, NothingIsPromisedWhereASearchLooksAtAll) {
  place_.file("scene.hook", slide_scene);
  measure("m/s", 0.6, 1.95, sliding);
  const SubjectCalibration found = calibrate("point.base.location.x", "mu { from = 0; to = 1; }");
  ASSERT_EQ(found.folds.size(), 5U);
  for (const FoldResult& fold : found.folds) {
    EXPECT_FALSE(fold.prediction);
    EXPECT_NEAR(*fold.held, mean_noise, 0.15);
  }
}

}  // namespace
}  // namespace hookpoint::studies
