// A contact in MuJoCo's words as a spring and damper: against its rows, integrated as they stand in the
// manual.
#include "contact/mujoco_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/predictions.h"

namespace hookpoint::contact {
namespace {

/// One mass on the row, in steps so small that only the row counts. Depth is positive here.
struct Mass {
  MujocoRow row;
  MujocoFriction friction;
  MujocoLoading at;
  double depth = 0., approach = 0.;

  /// f = (B v + K d r - a)/R with m a = m g - f, over a step.
  void step(double gravity, double dt) {
    const double d = mujoco_impedance(row, std::max(0., depth));
    const double R = mujoco_normal_softness(at.inverse_weight, at.coefficient, friction, d);
    const MujocoReference own = mujoco_reference(row, 0.);
    const double force = std::max(
        0., (own.damping * approach + own.stiffness * d * depth + gravity) / (R + 1. / at.mass));
    approach += dt * (gravity - (depth >= 0. ? force : 0.) / at.mass);
    depth += dt * approach;
  }
};

const MujocoLoading foot{30., 3., 0.4, 0.8, 0.};

TEST(MujocoContact, StandsAsDeepAsItsRowUnderTheLoad) {
  for (const MujocoFriction friction : {MujocoFriction{true, 1.}, MujocoFriction{true, 100.},
                                        MujocoFriction{false, 1.}, MujocoFriction{false, 10.}})
    for (const MujocoRow& row : {MujocoRow{}, MujocoRow{{0.01, 0.7}, {0.5, 0.99, 5e-3, 0.3, 3.}},
                                 MujocoRow{{-2000., -60.}, {0.8, 0.8, 0., 0.5, 1.}}}) {
      Mass mass{row, friction, foot};
      const double dt = 2e-6;
      for (int i = 0; i < 400'000; ++i) mass.step(foot.load / foot.mass, dt);
      const MujocoSpring spring = mujoco_spring(row, friction, foot);
      EXPECT_NEAR(spring.depth / mass.depth, 1., 1e-6);
      EXPECT_NEAR(spring.stiffness * spring.depth, foot.load, 1e-9);
    }
}

TEST(MujocoContact, ReboundsAsItsRowWithoutWeight) {
  for (const double ratio : {0.1, 0.4, 0.8}) {
    MujocoRow row{{0.02, ratio}, {0.9, 0.9, 1e-3, 0.5, 2.}};
    Mass mass{row, {true, 1.}, foot, 0., 1.};
    while (mass.depth >= 0.) mass.step(0., 1e-7);
    const MujocoSpring spring = mujoco_spring(row, {true, 1.}, foot);
    EXPECT_NEAR(kelvin_voigt_restitution(spring.damping_ratio), -mass.approach, 1e-3) << ratio;
    EXPECT_NEAR(spring.damping, 2. * spring.damping_ratio * std::sqrt(spring.stiffness * foot.mass),
                1e-9);
  }
}

// Where the mass is that of the row, the ratio is solref's own.
TEST(MujocoContact, KeepsTheDampingRatioOfSolref) {
  const MujocoLoading own{30., 3., 1. / 3., 0.8, 0.};
  const MujocoRow row{{0.02, 0.6}, {0.9, 0.9, 1e-3, 0.5, 2.}};
  EXPECT_NEAR(mujoco_spring(row, {true, 1.}, own).damping_ratio, 0.6, 1e-12);
}

TEST(MujocoContact, ATimeConstantBelowTwoStepsIsTwoSteps) {
  const MujocoRow short_time{{1e-3, 1.}, {0.9, 0.95, 1e-3, 0.5, 2.}};
  const MujocoRow two_steps{{4e-3, 1.}, {0.9, 0.95, 1e-3, 0.5, 2.}};
  EXPECT_EQ(mujoco_reference(short_time, 2e-3).stiffness,
            mujoco_reference(two_steps, 0.).stiffness);
}

TEST(MujocoContact, BringsImpedancesToTheirBounds) {
  EXPECT_EQ(mujoco_impedance({{0.02, 1.}, {0., 0.9, 1e-3, 0.5, 2.}}, 0.), mujoco_least_impedance);
  EXPECT_EQ(mujoco_impedance({{0.02, 1.}, {0.9, 2., 1e-3, 0.5, 2.}}, 1.),
            1. - mujoco_least_impedance);
  EXPECT_EQ(mujoco_impedance({{0.02, 1.}, {0.8, 0.9, 0., 0.5, 2.}}, 0.), 0.5 * (0.8 + 0.9));
}

TEST(MujocoContact, MixesTwoSides) {
  const MujocoRow a{{0.02, 1.}, {0.9, 0.95, 1e-3, 0.5, 2.}},
      b{{0.01, 0.5}, {0.8, 0.85, 3e-3, 0.3, 4.}};
  const MujocoRow mean = mujoco_mixed(a, b);
  EXPECT_DOUBLE_EQ(mean.reference[0], 0.015);
  EXPECT_DOUBLE_EQ(mean.impedance[2], 2e-3);
  const MujocoRow direct{{-1000., -50.}, b.impedance};
  EXPECT_EQ(mujoco_mixed(a, direct).reference, direct.reference);
}

}  // namespace
}  // namespace hookpoint::contact
