// Calibrations of constants that are known: traces made from the laws' equations, by a closed form
// and by an integration of this test's own, with noise of twenty seeds. The true constants lie
// within their 95 % intervals in at least 18 of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "application/calibration_plans.h"
#include "tests/support/command.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

/// A mass of 1 kg on one point; `height` above the ground, at rest.
constexpr const char* point_scene = R"(
Param height = 0 m;
Param dt = 0.5 ms;
World world {
  gravity = 9.81;
  deltat = dt;
  integrator = rk4;
  Material floor { normal_stiffness = 10 kN/m; normal_damping = 10 N.s/m; exponent = 1.5; hysteresis_damping = 1 s/m; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, height; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)";

constexpr double gravity = 9.81;
constexpr double sample_interval = 4e-3;
constexpr int samples = 60;

/// Height over time.
using Motion = std::function<double(double time)>;

/// z'' = -g - k z - c z' from rest at 0: a point that never leaves, as k d + c d' > 0 throughout.
Motion damped_oscillation(double stiffness, double damping) {
  const double depth = gravity / stiffness, rate = 0.5 * damping;
  const double frequency = std::sqrt(stiffness - rate * rate);
  return [=](double time) {
    return -depth +
           depth * std::exp(-rate * time) *
               (std::cos(frequency * time) + rate / frequency * std::sin(frequency * time));
  };
}

/// z'' = -g + k d^1.5 (1 + alpha d'), d = -z, from rest at `height`, by Runge and Kutta in steps of
/// 10 us; at the samples' times.
Motion hunt_crossley_drop(double stiffness, double hysteresis, double height) {
  constexpr double step = 1e-5;
  const auto acceleration = [=](double z, double v) {
    if (z >= 0.) return -gravity;
    return std::max(0., stiffness * std::pow(-z, 1.5) * (1. - hysteresis * v)) - gravity;
  };
  std::vector<double> heights;
  double z = height, v = 0.;
  const auto steps = static_cast<int>(std::lround(sample_interval / step));
  for (int sample = 0; sample <= samples; ++sample) {
    heights.push_back(z);
    for (int i = 0; i < steps; ++i) {
      const double a1 = acceleration(z, v), v2 = v + 0.5 * step * a1;
      const double a2 = acceleration(z + 0.5 * step * v, v2), v3 = v + 0.5 * step * a2;
      const double a3 = acceleration(z + 0.5 * step * v2, v3), v4 = v + step * a3;
      const double a4 = acceleration(z + step * v3, v4);
      z += step / 6. * (v + 2. * v2 + 2. * v3 + v4);
      v += step / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
    }
  }
  return [heights](double time) {
    return heights[static_cast<std::size_t>(std::lround(time / sample_interval))];
  };
}

class KnownConstants : public ::testing::Test {
 protected:
  KnownConstants() : application_(false) { place_.file("scene.hook", point_scene); }

  /// The motion with normal noise of this deviation [m].
  void measure(const std::string& name, const Motion& motion, double noise, unsigned seed) {
    std::mt19937_64 random(seed);
    std::string text = "time [s],z [mm]\n";
    for (int i = 0; i <= samples; ++i) {
      // The mean of twelve uniform numbers, the same with every library (Irwin & Hall).
      double normal = -6.;
      for (int part = 0; part < 12; ++part) normal += static_cast<double>(random() >> 11) * 0x1p-53;
      const double time = sample_interval * i;
      text +=
          std::to_string(time) + "," + std::to_string(1e3 * (motion(time) + noise * normal)) + "\n";
    }
    place_.file(name, text);
  }

  CalibrationResult calibrate(const std::string& name, const std::string& text,
                              const std::string& folder, int jobs = 2) {
    application::StudyArguments arguments;
    arguments.file = place_.file(name, text);
    const auto root = application_.evaluate(arguments.file, {});
    if (!root) return {};
    const auto plans = application::plan_calibrate_file(application_, *root, arguments);
    if (!plans || plans->size() != 1) return {};
    const std::atomic<bool> stop = false;
    CalibrationOptions options;
    options.run.jobs = jobs;
    options.run.folder = place_.folder() / folder;
    return run_calibration(plans->front(), application_.engines(), options, stop).result;
  }

  Workplace place_;
  application::Application application_;
};

/// How often each true share lies in its interval.
struct Recovered {
  std::array<int, 2> inside{};
  int told = 0;

  void add(const SubjectCalibration& found, const std::array<double, 2>& truth) {
    ASSERT_EQ(found.constants.size(), 2U) << found.status;
    for (std::size_t i = 0; i < 2; ++i) {
      const FittedConstant& constant = found.constants[i];
      ASSERT_TRUE(constant.low) << constant.reason;
      told += constant.told ? 1 : 0;
      inside[i] += *constant.low <= truth[i] && truth[i] <= *constant.high ? 1 : 0;
    }
  }
};

double share_of_log(double value, double from, double to) {
  return std::log(value / from) / std::log(to / from);
}

TEST_F(KnownConstants, OfASpringAndDamperFromItsClosedForm) {
  constexpr double stiffness = 8e3, damping = 18.;
  const Motion motion = damped_oscillation(stiffness, damping);
  Recovered recovered;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::string number = std::to_string(seed);
    measure("drop" + number + ".csv", motion, 50e-6, seed);
    const auto result = calibrate(
        "calibrate" + number + ".hook",
        R"(Calibrate spring {
  scene = "scene.hook";
  Trace drop { file = "drop)" +
            number +
            R"(.csv"; column = "z [mm]"; of = world.point.base.location.z; weight = 1 / (50 um); }
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Vary normal_damping { from = 1 N.s/m; to = 100 N.s/m; scale = log; }
  subjects = hookpoint; starts = 4; resamples = 100; seed = )" +
            number + ";\n}\n",
        "out" + number);
    ASSERT_EQ(result.subjects.size(), 1U);
    recovered.add(result.subjects[0],
                  {share_of_log(stiffness, 1e3, 1e5), share_of_log(damping, 1., 100.)});
    EXPECT_NEAR(*result.subjects[0].error, 1., 0.25) << seed;
  }
  EXPECT_GE(recovered.inside[0], 18);
  EXPECT_GE(recovered.inside[1], 18);
  EXPECT_EQ(recovered.told, 40);
}

TEST_F(KnownConstants, OfHuntAndCrossleysLawFromAnIntegrationOfItsEquation) {
  constexpr double stiffness = 3e5, hysteresis = 0.6, height = 0.02;
  const Motion motion = hunt_crossley_drop(stiffness, hysteresis, height);
  Recovered recovered;
  // What the scene's step of 0.5 ms leaves at touch-down is a hundredth of a standard deviation.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::string number = std::to_string(seed);
    measure("drop" + number + ".csv", motion, 100e-6, seed);
    const auto result = calibrate(
        "calibrate" + number + ".hook",
        R"(Calibrate drop {
  scene = "scene.hook";
  Fix height { value = 20 mm; }
  Trace drop { file = "drop)" +
            number + R"(.csv"; column = "z"; of = point.base.location.z; weight = 1 / (0.1 mm); }
  Vary normal_stiffness { from = 10 kN/m; to = 10 MN/m; scale = log; }
  Vary hysteresis_damping { from = 0.01 s/m; to = 10 s/m; scale = log; }
  subjects = hunt_crossley; starts = 4; resamples = 100; seed = )" +
            number + ";\n}\n",
        "out" + number);
    ASSERT_EQ(result.subjects.size(), 1U);
    recovered.add(result.subjects[0],
                  {share_of_log(stiffness, 1e4, 1e7), share_of_log(hysteresis, 0.01, 10.)});
    EXPECT_NEAR(*result.subjects[0].error, 1., 0.25) << seed;
  }
  EXPECT_GE(recovered.inside[0], 18);
  EXPECT_GE(recovered.inside[1], 18);
  EXPECT_EQ(recovered.told, 40);
}

}  // namespace
}  // namespace hookpoint::studies
