// Measurements that are made up from closed forms, with noise: a drop that bounces and a slide that
// stops, many cases in a table each. The search by distances finds what they were made with, inside
// the interval that it tells.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "application/calibration_plans.h"
#include "tests/support/command.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

constexpr double gravity = 9.81, restitution = 0.6, friction = 0.3;
constexpr double noise = 2e-3;  // [m]

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
      : application_(false, [](const language::Diagnostics& found) {
          for (const language::Diagnostic& diagnostic : found.all())
            ADD_FAILURE() << diagnostic.message;
        }) {}

  /// Tables of ten cases, each begun with another value of the Param `begin`.
  void measure(const std::string& unit, double from, double step,
               const std::function<double(double time, double begin)>& truth) {
    // Of twelve seeds eleven have the truth inside the interval of 95 %.
    std::mt19937_64 random(1);
    std::normal_distribution<double> error(0., noise);
    std::string states = "case,begin [" + unit + "]\n", curves = "case,time [s],way [m]\n";
    for (int i = 0; i < 10; ++i) {
      const double begin = from + step * i;
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
  SubjectCalibration calibrate(const std::string& port, const std::string& vary) {
    application::StudyArguments arguments;
    arguments.file =
        place_.file("measured.hook",
                    "Calibrate measured { scene = \"scene.hook\"; method = cmaes; generations = 8; "
                    "population = 8;\n"
                    "  Cases case { file = \"states.csv\"; case = case;\n"
                    "    Trace way { file = \"curves.csv\"; column = way; time = \"time\"; of = " +
                        port + "; weight = 1 / (2 mm); } }\n  Vary " + vary + " }\n");
    const auto root = application_.evaluate(arguments.file, {});
    const auto plans = application::plan_calibrate_file(application_, *root, arguments);
    CalibrationOptions options;
    options.run.jobs = 2;
    options.run.folder = place_.folder() / "out";
    const std::atomic<bool> stop = false;
    return run_calibration(plans->front(), application_.engines(), options, stop)
        .result.subjects[0];
  }

  static void expect_inside(const SubjectCalibration& found, double truth) {
    ASSERT_EQ(found.constants.size(), 1U) << found.status;
    const FittedConstant& constant = found.constants.front();
    EXPECT_TRUE(constant.told) << constant.reason;
    EXPECT_LE(*constant.low, truth);
    EXPECT_GE(*constant.high, truth);
    EXPECT_LT(*constant.high - *constant.low, 0.02);
    // The mean of |a normal error| is 0.8 of its spread.
    EXPECT_NEAR(*found.error, 0.8, 0.1);
    ASSERT_EQ(found.folds.size(), 5U);
    for (const FoldResult& fold : found.folds) EXPECT_NEAR(*fold.held, 0.8, 0.15);
  }

  Workplace place_;
  application::Application application_;
};

TEST_F(MeasuredCases, ADropTellsTheRestitution) {
  measure("m", 0.05, 0.02, bouncing);
  place_.file("scene.hook", R"(
Param begin = 0.1 m;
World world {
  gravity = 9.81;
  deltat = 1 ms;
  contact = impulse;
  Material floor { restitution = 0.3; static_friction = 0.5; kinetic_friction = 0.5; rebound_speed = 5 mm/s; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, begin; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)");
  expect_inside(calibrate("point.base.location.z", "restitution { from = 0; to = 1; }"),
                restitution);
}

TEST_F(MeasuredCases, ASlideTellsTheFriction) {
  measure("m/s", 0.6, 0.15, sliding);
  place_.file("scene.hook", R"(
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
)");
  expect_inside(calibrate("point.base.location.x", "mu { from = 0; to = 1; }"), friction);
}

}  // namespace
}  // namespace hookpoint::studies
