// A point mass on the ground under each law, with a model of its own (semi-implicit Euler, a dozen
// lines), against the closed forms of docs/contact.md: penetration, stick, threshold, slip,
// braking, creep, rebound.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/force_law.h"
#include "tests/support/point_mass.h"

namespace hookpoint::contact {
namespace {

using namespace test_support;

template <class Law>
class HookLaw : public ::testing::Test {};
using HookLaws = ::testing::Types<Hookpoint, HookpointReset>;
TYPED_TEST_SUITE(HookLaw, HookLaws);

TYPED_TEST(HookLaw, SticksWithTheDisplacementAndPenetrationOfItsSprings) {
  PointMass block{2., 20. * std::numbers::pi / 180., 0.7, well_damped()};
  block.position.z =
      -block.normal_load() / block.material.normal_stiffness;  // in the ground, no hook yet
  block.template run<TypeParam>(1e-4, 3.);
  const double shift = dot(block.position, block.downhill());
  EXPECT_NEAR(shift, 2. * g * std::sin(block.slope) / 1e4, 1e-12);
  EXPECT_NEAR(-block.position.z, 2. * g * std::cos(block.slope) / 2e4, 1e-12);
  EXPECT_NEAR(
      shift,
      *TypeParam::stick_displacement(block.tangential_load(), block.normal_load(), block.material),
      1e-12);
  const Vector3d before = block.position;
  block.template run<TypeParam>(1e-4, 5.);
  EXPECT_LE(norm(block.position - before), 1e-15);  // no creep: round-off only
}

TYPED_TEST(HookLaw, SticksExactlyUpToTheStaticFriction) {
  for (const double offset : {-1e-6, 1e-6}) {
    PointMass block{1., std::atan(0.8 + offset), 0.3, well_damped()};
    block.material.static_friction = 0.8;
    block.material.kinetic_friction = 0.5;
    block.settle();
    block.template run<TypeParam>(1e-4, 1.);
    const double speed = dot(block.velocity, block.downhill());
    if (offset < 0.) {
      EXPECT_LE(std::abs(speed), 1e-9);
    } else {
      EXPECT_GE(speed, 0.1);
    }
    EXPECT_EQ(TypeParam::creep_speed(std::tan(block.slope), block.material).has_value(),
              offset < 0.);
  }
}

TEST(HookpointTruth, SlidesWithKineticFrictionExactlyAtEveryAzimuth) {
  for (const double azimuth : {0., 0.6, std::numbers::pi / 4., 2.5}) {
    PointMass block{1., 30. * std::numbers::pi / 180., azimuth, well_damped()};
    block.material.static_friction = 0.5;
    block.material.kinetic_friction = 0.3;
    block.settle();
    block.run<Hookpoint>(
        1e-4, 0.5);  // the normal direction has come to rest, the spring is fully stretched
    const double before = dot(block.velocity, block.downhill());
    for (int i = 0; i < 1000; ++i) {
      block.step<Hookpoint>(1e-4);
      const double friction = norm(tangential(block.ground_force, {0., 0., 1.}));
      ASSERT_NEAR(friction, 0.3 * block.ground_force.z, 1e-13);
    }
    const double acceleration = (dot(block.velocity, block.downhill()) - before) / 0.1;
    EXPECT_NEAR(acceleration, slip_acceleration(g, block.slope, 0.3), 1e-9);
    EXPECT_NEAR(acceleration, g * (0.5 - 0.3 * std::sqrt(0.75)), 1e-9);
    EXPECT_NEAR(block.velocity.x * std::sin(azimuth), block.velocity.y * std::cos(azimuth), 1e-12);
  }
}

/// A block that slides at `speed` on the level; returns where the forward and backward ends of its
/// last swing lie.
template <class Law>
std::pair<double, double> braked(const MaterialConstants<double>& material, double speed, double dt,
                                 double until, double window) {
  PointMass block{1., 0., 0., material};
  block.settle();
  block.velocity.x = speed;
  block.run<Law>(dt, until - window);
  std::pair<double, double> ends{block.position.x, block.position.x};
  for (long i = std::lround(window / dt); i > 0; --i) {
    block.step<Law>(dt);
    ends = {std::min(ends.first, block.position.x), std::max(ends.second, block.position.x)};
  }
  return ends;
}

TEST(HookpointTruth, BrakesWithinCoulombsDistanceLessTheElasticOffset) {
  MaterialConstants<double> material = well_damped();
  material.static_friction = material.kinetic_friction = 0.5;
  material.tangential_stiffness = 1e3;
  const double coulomb = braking_distance(1., g, 0.5);
  const double e0 = braking_elastic_offset(g, material);
  EXPECT_NEAR(coulomb, 1. / 9.81, 1e-15);
  EXPECT_NEAR(e0, 0.5 * 9.81 / 1e3, 1e-15);

  material.tangential_damping = 30.;
  const auto [rest, still] = braked<Hookpoint>(material, 1., 1e-5, 1.5, 0.1);
  EXPECT_NEAR(rest, coulomb - e0, 0.01 * e0);
  EXPECT_NEAR(still, rest, 1e-9);

  material.tangential_damping = 0.;  // swings about its hook for ever
  const auto [back, front] = braked<Hookpoint>(material, 1., 1e-5, 1.5, 0.5);
  EXPECT_NEAR(0.5 * (front + back), coulomb - 0.5 * e0, 0.01 * e0);
  EXPECT_NEAR(0.5 * (front - back), e0, 0.01 * e0);
}

TEST(HookpointResetTruth, LosesHalfItsFrictionAsTheStepShrinks) {
  MaterialConstants<double> material = well_damped();
  material.static_friction = material.kinetic_friction = 0.5;
  material.tangential_damping = 0.;
  const double coulomb = braking_distance(1., g, 0.5);
  const double fine = braked<HookpointReset>(material, 1., 2e-6, 0.6, 0.2).second;
  const double mapped = braked<Hookpoint>(material, 1., 2e-6, 0.6, 0.2).second;
  const double coarse = braked<HookpointReset>(material, 1., 1e-3, 0.6, 0.2).second;
  EXPECT_NEAR(fine, 2. * coulomb, 0.02 * 2. * coulomb);
  EXPECT_NEAR(mapped, coulomb, 0.01 * coulomb);
  EXPECT_LT(coarse, 1.5 * coulomb);  // a coarse step hides it

  // Dragged at constant speed: the mean over many teeth.
  material.tangential_damping = 2.;
  PointMass block{1., 0., 0., material};
  block.settle();
  double sum = 0.;
  const int steps = 400000;
  for (int i = 0; i < steps; ++i) {
    block.velocity = {0.5, 0., 0.};
    block.step<HookpointReset>(1e-6);
    sum -= block.ground_force.x;
  }
  const double predicted = HookpointReset::mean_sliding_friction(0.5, g, material);
  EXPECT_NEAR(predicted, 0.5 * (0.5 * g + 2. * 0.5), 1e-12);
  EXPECT_NEAR(sum / steps, predicted, 0.01 * predicted);
}

TEST(HookpointTruth, HooksWhereThePathCrossedTheSurface) {
  const MaterialConstants<double> material;
  // 3 mm deep at 4 m/s down: crossed 0.75 ms ago, 1.5 mm back along x at 2 m/s.
  const PointKinematics<double> point{{1., 0., -3e-3}, {2., 0., -4.}, {0., 0., 1.}, 3e-3};
  const auto entered = Hookpoint::evaluate(point, {}, material, 1e-3);
  EXPECT_NEAR(point.position.x - entered.next.hook.x, 1.5e-3, 1e-15);
  // Placed in the ground, it may not look back further than the step.
  const auto placed = Hookpoint::evaluate(point, {}, material, 1e-4);
  EXPECT_NEAR(point.position.x - placed.next.hook.x, 2e-4, 1e-15);
  PointKinematics<double> leaving = point;
  leaving.velocity = {0.2, 0., 0.1};
  const auto left = Hookpoint::evaluate(leaving, {}, material, 1e-3);
  EXPECT_FALSE(left.next.sliding);
  EXPECT_EQ(left.next.stretch, Vector3d{});
}

TEST(HookpointTruth, RelaxesItsStretchWhileTheNormalForceIsNought) {
  MaterialConstants<double> material = well_damped();
  const double dt = 1e-6;
  // Rising so fast that the damper alone would pull: N = 0 although the point is inside.
  Memory<double> memory{{}, {1e-3, 0., 0.}, true, false};
  for (int i = 0; i < 10000; ++i) {
    const PointKinematics<double> point{{1e-3, 0., -1e-3}, {0., 0., 1.}, {0., 0., 1.}, 1e-3};
    const auto reaction = Hookpoint::evaluate(point, memory, material, dt);
    ASSERT_EQ(reaction.force, Vector3d{});
    ASSERT_TRUE(reaction.next.attached);
    memory = reaction.next;
  }
  // e' = -(k_t/c_t) e over 10 ms
  EXPECT_NEAR(memory.stretch.x, 1e-3 * std::exp(-1e4 / 150. * 1e-2), 1e-6);
}

TEST(HookpointTruth, StaysSlidingUntilTheTrialFallsBelowKineticFriction) {
  MaterialConstants<double> material = well_damped();
  material.static_friction = 0.8;
  material.kinetic_friction = 0.4;
  material.tangential_damping = 0.;
  const double depth = 10. / material.normal_stiffness;  // N = 10
  const auto pulled = [&](double stretch, bool sliding) {
    const Memory<double> memory{{}, {stretch, 0., 0.}, true, sliding};
    const PointKinematics<double> point{{stretch, 0., -depth}, {}, {0., 0., 1.}, depth};
    return Hookpoint::evaluate(point, memory, material, 1e-3);
  };
  EXPECT_FALSE(pulled(7.9e-4, false).next.sliding);  // 7.9 N < 8 N
  EXPECT_NEAR(pulled(7.9e-4, false).force.x, -7.9, 1e-12);
  EXPECT_TRUE(pulled(8.1e-4, false).next.sliding);
  EXPECT_NEAR(pulled(8.1e-4, false).force.x, -4., 1e-12);
  EXPECT_TRUE(pulled(4.1e-4, true).next.sliding);  // between the two it depends on the past
  EXPECT_FALSE(pulled(4.1e-4, false).next.sliding);
  EXPECT_FALSE(pulled(3.9e-4, true).next.sliding);
}

TEST(HuntCrossleyTruth, CreepsAtThePredictedSpeed) {
  MaterialConstants<double> material = well_damped();
  material.hysteresis_damping = 20.;
  material.static_friction = material.kinetic_friction = 0.8;
  PointMass block{1., 20. * std::numbers::pi / 180., 0.4, material};
  block.position.z = -HuntCrossley::static_depth(block.normal_load(), material);
  block.run<HuntCrossley>(2e-5, 2.);
  const double ratio = std::tan(block.slope) / 0.8;
  const double speed = dot(block.velocity, block.downhill());
  EXPECT_NEAR(speed, 1e-3 * ratio / std::sqrt(1. - ratio * ratio), 1e-9);
  EXPECT_NEAR(HuntCrossley::creep_speed(std::tan(block.slope), material).value(), speed, 1e-9);

  block.material.kinetic_friction =
      0.2;  // a steeper slope than kinetic friction holds: on Stribeck's rising side
  block.run<HuntCrossley>(2e-5, 2.);
  EXPECT_NEAR(HuntCrossley::creep_speed(std::tan(block.slope), block.material).value(),
              dot(block.velocity, block.downhill()), 1e-9);
}

TEST(HuntCrossleyTruth, HasNoCreepSpeedWhereFrictionCannotHold) {
  MaterialConstants<double> material;
  material.static_friction = material.kinetic_friction = 0.5;
  EXPECT_FALSE(HuntCrossley::creep_speed(0.5, material).has_value());
  EXPECT_FALSE(HuntCrossley::creep_speed(0.7, material).has_value());
  EXPECT_EQ(HuntCrossley::creep_speed(0., material), 0.);
  material.static_friction =
      0.8;  // on mu_k side of a peak near mu_s: 0.79 is not reached at v_s = 1 mm/s
  EXPECT_FALSE(HuntCrossley::creep_speed(0.799, material).has_value());
  EXPECT_NEAR(friction_regularisation_inverse(friction_regularisation(0.7)), 0.7, 1e-15);
}

/// Rebound speed over impact speed of a mass thrown down at `speed`, without gravity.
template <class Law>
double rebound(const MaterialConstants<double>& material, double mass, double speed) {
  Vector3d position{0., 0., 0.}, velocity{0., 0., -speed};
  Memory<double> memory;
  const double dt = 2e-7;
  do {
    position += 0.5 * dt * velocity;
    const PointKinematics<double> point{position, velocity, {0., 0., 1.}, -position.z};
    const auto reaction = Law::evaluate(point, memory, material, dt);
    memory = reaction.next;
    velocity += dt / mass * reaction.force;
    position += 0.5 * dt * velocity;
  } while (position.z < 0.);
  return velocity.z / speed;
}

TEST(SpringDamperTruth, ReboundsAsTheClampedKelvinVoigtBodyDoes) {
  MaterialConstants<double> material;
  material.normal_stiffness = 1e5;
  for (const double zeta : {0., 0.05, 0.3, 0.8, 0.999999999999, 1., 1.5}) {
    material.normal_damping = zeta * 2. * std::sqrt(1e5 * 0.7);
    const double e = rebound<Hookpoint>(material, 0.7, 0.5);
    EXPECT_NEAR(e, Hookpoint::restitution(0.7, 0.5, material), 2e-4) << zeta;
    EXPECT_NEAR(kelvin_voigt_damping_ratio(kelvin_voigt_restitution(zeta)), zeta, 1e-6);
  }
  EXPECT_EQ(kelvin_voigt_restitution(0.), 1.);
  EXPECT_TRUE(std::isinf(kelvin_voigt_damping_ratio(0.)));
  EXPECT_NEAR(kelvin_voigt_restitution(1.), std::exp(-2.), 1e-12);
}

TEST(HuntCrossleyTruth, ReboundsByItsEnergyBalanceWhateverTheExponent) {
  MaterialConstants<double> material;
  material.normal_stiffness = 1e6;
  for (const double exponent : {1., 1.5, 2.}) {
    for (const double a : {0.1, 0.6, 3.}) {
      material.exponent = exponent;
      material.hysteresis_damping = a / 0.8;
      const double e = rebound<HuntCrossley>(material, 0.5, 0.8);
      EXPECT_NEAR(e, HuntCrossley::restitution(0.5, 0.8, material), 2e-4) << exponent << " " << a;
    }
  }
  EXPECT_EQ(hunt_crossley_restitution(0.), 1.);
  EXPECT_NEAR(hunt_crossley_restitution(1e-3), 1. - 2e-3 / 3., 1e-6);
}

TEST(HookpointTruth, HooksSurviveBobbingBelowTheSurvivalSpeed) {
  for (const double factor : {0.98, 1.02}) {
    PointMass block{1., 0., 0., well_damped()};
    block.material.normal_damping = 0.;
    block.settle();
    block.velocity.z = factor * hook_survival_speed(g, 1., block.material.normal_stiffness);
    bool lost = false;
    for (int i = 0; i < 20000; ++i) {
      block.step<Hookpoint>(1e-5);
      lost = lost || !block.memory.attached;
    }
    EXPECT_EQ(lost, factor > 1.);
  }
}

}  // namespace
}  // namespace hookpoint::contact
