// Calibrations of constants that are known: traces made from the laws' equations, by a closed form
// and by an integration of this test's own, with noise of twenty seeds. The true constants lie
// within their 95 % intervals in at least 18 of them.
#include "studies/calibrate/calibration.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/support/command.h"
#include "tests/support/normal_noise.h"
#include "tests/support/planned.h"

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
  KnownConstants() { place_.file("scene.hook", point_scene); }

  /// The motion with normal noise of this deviation [m].
  void measure(const std::string& name, const Motion& motion, double noise, unsigned seed) {
    std::mt19937_64 random(seed);
    std::string text = "time [s],z [mm]\n";
    for (int i = 0; i <= samples; ++i) {
      const double time = sample_interval * i;
      text += std::to_string(time) + "," +
              std::to_string(1e3 * (motion(time) + noise * testing::normal_number(random))) + "\n";
    }
    place_.file(name, text);
  }

  CalibrationResult calibrate(const std::string& name, const std::string& text,
                              const std::string& folder, int jobs = 2) {
    const auto plans = planned_calibrations(application_, place_.file(name, text));
    if (plans.size() != 1) return {};
    const std::atomic<bool> stop = false;
    CalibrationOptions options;
    options.run.jobs = jobs;
    options.run.folder = place_.folder() / folder;
    return run_calibration(plans.front(), application_.engines(), options, stop).result;
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
      told += constant.identifiable ? 1 : 0;
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

/// A point that is pulled along the ground and sticks: m x'' = F sin(2 pi f t) - k x - c x' from
/// rest, in closed form: what is forced, and what dies away.
Motion pulled_and_sticking(double stiffness, double damping, double force, double frequency) {
  const double w = 2. * std::numbers::pi * frequency, rate = 0.5 * damping;
  const double own = std::sqrt(stiffness - rate * rate), stiff = stiffness - w * w;
  const double scale = force / (stiff * stiff + damping * damping * w * w);
  const double sine = scale * stiff, cosine = -scale * damping * w;
  // x(0) = x'(0) = 0.
  const double a = -cosine, b = -(w * sine + rate * cosine) / own;
  return [=](double time) {
    return sine * std::sin(w * time) + cosine * std::cos(w * time) +
           std::exp(-rate * time) * (a * std::cos(own * time) + b * std::sin(own * time));
  };
}

/// Friction that never slips says only that it is more than the greatest pull needs.
TEST_F(KnownConstants, OfAPointThatSticksItsFrictionIsNotIdentifiable) {
  constexpr double stiffness = 3000., damping = 20., force = 6., frequency = 2.;
  place_.file("scene.hook", R"(
Param kt = 2 kN/m;
Param mu = 0.9;
World world {
  gravity = 9.81;
  deltat = 0.5 ms;
  integrator = rk4;
  contact = hookpoint;
  Material floor { normal_stiffness = 20 kN/m; normal_damping = 30 N.s/m; tangential_stiffness = kt; tangential_damping = 20 N.s/m; static_friction = mu; kinetic_friction = mu; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, -0.0004905; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { } } }
  Force pull { body = point.base; }
  Signal.Sine s { amplitude = 6; frequency = 2 Hz; Wire FROM output TO pull.force.x; }
}
)");
  const Motion motion = pulled_and_sticking(stiffness, damping, force, frequency);
  // The scene's friction just holds the greatest of F - m x'' = k x + c x'.
  double greatest = 0.;
  for (double time = 0.; time < sample_interval * samples; time += 1e-5) {
    const double speed = (motion(time + 1e-6) - motion(time - 1e-6)) / 2e-6;
    greatest = std::max(greatest, std::abs(stiffness * motion(time) + damping * speed));
  }
  const double least = greatest / gravity;
  ASSERT_LT(least, 0.85);
  int inside = 0;
  for (const char* bootstrap : {"one_step", "refits"}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const std::string number = std::string(bootstrap) + std::to_string(seed);
      measure("pull" + number + ".csv", motion, 200e-6, seed);
      const auto result = calibrate(
          "calibrate" + number + ".hook",
          R"(Calibrate pulled {
  scene = "scene.hook";
  Trace x { file = "pull)" +
              number + R"(.csv"; column = "z [mm]"; of = point.position.x; weight = 1 / (0.2 mm); }
  Vary kt { from = 300 N/m; to = 30 kN/m; scale = log; }
  Vary mu { from = 0.1; to = 2; }
  starts = 6; resamples = 60; bootstrap = )" +
              bootstrap + "; seed = " + std::to_string(seed) + ";\n}\n",
          "out" + number);
      ASSERT_EQ(result.subjects.size(), 1U);
      const auto& constants = result.subjects[0].constants;
      ASSERT_EQ(constants.size(), 2U) << result.subjects[0].status;
      EXPECT_TRUE(constants[0].identifiable) << number << ": " << constants[0].reason;
      const double truth = share_of_log(stiffness, 300., 30e3);
      inside += *constants[0].low <= truth && truth <= *constants[0].high ? 1 : 0;
      // Not of width 0 because the friction is singular, nor much wider than it is known.
      EXPECT_GT(*constants[0].high - *constants[0].low, 1e-3) << number;
      EXPECT_FALSE(constants[1].identifiable) << number;
      EXPECT_GT(*constants[1].high, 0.999) << number;
      const double low = 0.1 + 1.9 * *constants[1].low;
      EXPECT_LT(low, least + 0.05) << number;
      EXPECT_GT(low, least - 0.15) << number;
    }
  }
  EXPECT_GE(inside, 36);
}

}  // namespace
}  // namespace hookpoint::studies
