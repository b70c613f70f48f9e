// Bodies that spin, at the default step and integrator, over 100 s: a free symmetric top keeps both
// of its rates, a free body its energy and its angular momentum, a swing under gravity its energy.
// ctest: long
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/four_bar.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr int steps_of_100_s = 100000;

/// A drum stick that spins about its length and tumbles across; `more` are fields of the world.
std::string stick(double spin, const std::string& more = "") {
  return fmt::format(
      "World air {{ gravity = 9.81; duration = 100 s; {} Robot stick {{ Base.mobile {{ location = 0, "
      "0, 50; angular_velocity = 0, {}, 5; mass = 0.12 kg; inertia = 1.7243e-4, 6.58e-6, 1.7243e-4, "
      "0, 0, 0; }} }} }}",
      more, spin);
}

/// In the axes of body `i`.
Vector3d own_rates(Running& run, std::size_t i) {
  const simulation::BodyState& body = run.world().state().bodies[i];
  return rotate(conjugate(body.orientation), body.angular_velocity);
}

TEST(SpinningBodies, ASymmetricTopKeepsBothOfItsRates) {
  // With gyroscopic forces of the step's start it is not finite after a second.
  for (const auto& [spin, deltat] :
       {std::pair{5., "auto"}, {50., "auto"}, {200., "auto"}, {1000., "auto"}, {1000., "1 ms"}}) {
    SCOPED_TRACE(spin);
    Running run(stick(spin, fmt::format("deltat = {};", deltat)));
    double least = 5., most = 5.;
    while (run.world().state().time < 100.) {
      run.step();
      const Vector3d w = own_rates(run, 0);
      ASSERT_NEAR(w.y, spin, 1e-6 * spin);
      const double across = std::hypot(w.x, w.z);
      least = std::min(least, across);
      most = std::max(most, across);
    }
    EXPECT_GT(least, 0.9999 * 5.);
    EXPECT_LT(most, 1.0001 * 5.);
  }
}

// A body that spins about its middle axis turns over and over (Dzhanibekov), twice in the period of
// its rates, 4 K(k^2) sqrt(I1 I2 I3/((I1 - I2)(L^2 - 2 E I3))) of Landau & Lifshitz, Mechanics, 37.
TEST(SpinningBodies, AFlippingHandleKeepsEnergyMomentumAndPeriod) {
  const double I1 = 3e-3, I2 = 5e-3, I3 = 7e-3;
  Running run(
      "World orbit { gravity = 0; duration = 100 s; Robot handle { Base.mobile { angular_velocity "
      "= 0.1, 10, 0; mass = 1 kg; inertia = 3e-3, 5e-3, 7e-3, 0, 0, 0; } } }");
  const double energy = 0.5 * (I1 * 0.01 + I2 * 100.);
  const Vector3d momentum{I1 * 0.1, I2 * 10., 0.};
  const double squared = dot(momentum, momentum);
  const double k2 =
      (I3 - I2) * (squared - 2. * energy * I1) / ((I2 - I1) * (2. * energy * I3 - squared));
  const double rate = std::sqrt((I2 - I1) * (2. * energy * I3 - squared) / (I1 * I2 * I3));
  const double period = 4. * std::comp_ellint_1(std::sqrt(k2)) / rate;
  int flips = 0;
  double wandered = 0.;
  bool upright = true;
  for (int i = 0; i < steps_of_100_s; ++i) {
    run.step();
    const Vector3d w = own_rates(run, 0);
    const Vector3d now =
        rotate(run.world().state().bodies[0].orientation, Vector3d{I1 * w.x, I2 * w.y, I3 * w.z});
    ASSERT_NEAR(run["orbit.handle.kinetic_energy"], energy, 1e-4 * energy);
    ASSERT_NEAR(norm(now), norm(momentum), 1e-4 * norm(momentum));
    wandered = std::max(wandered, norm(now - momentum) / norm(momentum));
    if ((w.y > 0.) != upright && std::abs(w.y) > 5.) {
      upright = !upright;
      ++flips;
    }
  }
  EXPECT_EQ(flips, static_cast<int>(std::round(200. / period)));
  EXPECT_LT(wandered, 0.01);
}

// A satellite that tumbles slowly carries a wheel that turns fast. Both are symmetric about the
// wheel's axis z, I across and J along of both together, j along of the wheel. Euler's equations
//   I w_x' + ((J - I) w_z + j W) w_y = 0,  I w_y' - ((J - I) w_z + j W) w_x = 0
// turn the rate across by ((J - I) w_z + j W)/I in body axes; w_z and W stay.
TEST(SpinningBodies, ASatelliteWithAFastWheelNutatesForEver) {
  const double wheel = 500.;
  Running run(fmt::format(
      "World orbit {{ gravity = 0; duration = 100 s; Robot satellite {{ Base.mobile {{ "
      "angular_velocity = 0.2, 0, 0.1; mass = 10 kg; inertia = 0.5, 0.5, 0.4, 0, 0, 0; }} Chain c {{ "
      "Link wheel {{ rate = {}; mass = 0.5; inertia = 1e-3, 1e-3, 2e-3, 0, 0, 0; }} }} }} }}",
      wheel));
  const double I = 0.501, J = 0.402, j = 2e-3;
  const double turning = ((J - I) * 0.1 + j * wheel) / I;
  double least = 1., most = 0., phase = 0., before = 0.;
  while (run.world().state().time < 100.) {
    run.step();
    const Vector3d w = own_rates(run, 0);
    ASSERT_NEAR(w.z, 0.1, 1e-6);
    ASSERT_NEAR(run["orbit.satellite.c.wheel.rate"], wheel, 1e-6 * wheel);
    least = std::min(least, std::hypot(w.x, w.y));
    most = std::max(most, std::hypot(w.x, w.y));
    const double angle = std::atan2(w.y, w.x);
    phase += std::remainder(angle - before, 2. * M_PI);
    before = angle;
  }
  EXPECT_GT(least, 0.999 * 0.2);
  EXPECT_LT(most, 1.001 * 0.2);
  EXPECT_NEAR(std::abs(phase), std::abs(turning) * 100., 1e-3 * std::abs(turning) * 100.);
}

TEST(SpinningBodies, ADoublePendulumKeepsItsEnergyAndItsAmplitude) {
  // Point masses of 1 kg at 1 m and 2 m, released at `start` from hanging down.
  for (const double start : {0.1, 1.5, 2.5}) {
    SCOPED_TRACE(start);
    const std::string rod =
        "mass = 1; center_of_mass = 1, 0, 0; inertia = 1e-9, 1e-9, 1e-9, 0, 0, 0; }";
    Running run(fmt::format(
        "World w {{ gravity = 0, -9.81, 0; duration = 100 s; Robot p {{ Base.fixed {{ }} Chain c {{ "
        "Link upper {{ angle = {}; {} Link fore {{ dhlength = 1; {} }} }} }}",
        start - M_PI / 2., rod, rod));
    const double deep = -3. * 9.81;
    const auto energy = [&] {
      const double a = run["w.p.c.upper.angle"], s = a + run["w.p.c.fore.angle"];
      const double w = run["w.p.c.upper.rate"], u = w + run["w.p.c.fore.rate"];
      return 0.5 * (2. * w * w + u * u + 2. * w * u * std::cos(s - a)) +
             9.81 * (2. * std::sin(a) + std::sin(s)) - deep;
    };
    const double first = energy();
    double highest_at_end = 0.;
    for (int i = 0; i < steps_of_100_s; ++i) {
      run.step();
      ASSERT_NEAR(energy(), first, 0.01 * first) << i;
      if (i > steps_of_100_s - 20000)
        highest_at_end = std::max(highest_at_end, run["w.p.c.upper.angle"] + M_PI / 2.);
    }
    // Small swings alone are quasiperiodic: the amplitude comes back.
    if (start < 0.2) {
      EXPECT_NEAR(highest_at_end, start, 0.05 * start);
    }
  }
}

// One degree of freedom: kinetic and potential energy follow from the crank's angle and rate.
TEST(SpinningBodies, AClosedLinkageKeepsItsEnergy) {
  Running run(test_support::FourBar::text("duration = 100 s;"));
  const auto energy = [&] {
    return test_support::FourBar::energy(run["w.bar.left.crank.angle"],
                                         run["w.bar.left.crank.rate"]);
  };
  double bottom = INFINITY;  // the least potential energy [J]
  for (int degree = 0; degree < 360; ++degree)
    bottom = std::min(bottom, test_support::FourBar::potential(degree * M_PI / 180.));
  const double first = energy() - bottom;
  for (int i = 0; i < steps_of_100_s; ++i) {
    run.step();
    ASSERT_NEAR(energy() - bottom, first, 0.01 * first) << i;
  }
}

TEST(SpinningBodies, BodiesThatMayTouchKeepTheirRatesToo) {
  // Robots with shapes step together.
  Running run(
      "World air { gravity = 0; duration = 20 s; For i in 0..1 { Robot top[i] { Base.mobile { "
      "location = 3*i, 0, 0; angular_velocity = 1, 0, 100 + 50*i; mass = 1 kg; inertia = 1e-3, 1e-3, "
      "1.8e-3, 0, 0, 0; Shape.Sphere ball { radius = 0.1; } } } } }");
  for (int i = 0; i < 20000; ++i) {
    run.step();
    for (const std::size_t top : {0, 1}) {
      const Vector3d w = own_rates(run, top);
      ASSERT_NEAR(std::hypot(w.x, w.y), 1., 0.01) << i;
      ASSERT_NEAR(w.z, 100. + 50. * double(top), 1e-6);
    }
  }
}

TEST(SpinningBodies, TheDefaultStepKnowsRates) {
  const auto step_of = [](double spin) { return load_text(stick(spin)).experiment->deltat; };
  EXPECT_EQ(step_of(200.), 1e-3);
  EXPECT_EQ(step_of(990.), 0.5e-3);
  EXPECT_EQ(step_of(3000.), 0.1e-3);
  // Rates of joints add up along a chain, and a prismatic joint turns nothing.
  const auto of_arm = [](const std::string& joint) {
    const std::string mass = "mass = 1; inertia = 1, 1, 1, 0, 0, 0;";
    const Loaded loaded = load_text(
        "World w { gravity = 0; duration = 1 s; Robot r { Base.fixed { } Chain c { Link a { rate = 600; " +
        mass + " } Link b { " + joint + mass + " } } } }");
    return loaded.experiment->deltat;
  };
  EXPECT_EQ(of_arm("rate = 600;"), 0.2e-3);
  EXPECT_EQ(of_arm("joint = prismatic; rate = 600;"), 0.5e-3);
}

TEST(SpinningBodies, WhatTurnsTooFarInAStepSaysSo) {
  for (const char* integrator : {"semi_implicit_euler", "implicit_joints"}) {
    Running run(stick(3000., fmt::format("deltat = 1 ms; integrator = {};", integrator)));
    const simulation::StepStatus status = run.world().step();
    EXPECT_EQ(status.kind, simulation::StepStatus::Kind::step_too_large);
    EXPECT_NE(status.advice.find("by 3 rad"), std::string::npos) << status.advice;
    EXPECT_EQ(run.world().state().step, 0);
  }
}

}  // namespace
}  // namespace hookpoint
