// Every law that can hold a body on a slope, against closed forms: depth, shift under a slow load,
// the threshold at mu_s, the slide at mu_k. Under a model of its own (tests/support/point_mass.h).
#include <gtest/gtest.h>

#include <numbers>

#include "contact/force_law.h"
#include "tests/support/point_mass.h"

namespace hookpoint::contact {
namespace {

using namespace test_support;

constexpr double degree = std::numbers::pi / 180.;

template <class Law>
class HoldingLaw : public ::testing::Test {};
using HoldingLaws = ::testing::Types<Hookpoint, HookpointReset, Nominal, AzadFeatherstone, Lugre,
                                     Elastoplastic, Exponential>;
TYPED_TEST_SUITE(HoldingLaw, HoldingLaws);

/// A soft first 0.5 mm for `nominal`, on springs k = 20 kN/m (N/m^1.5).
MaterialConstants<double> ground() {
  MaterialConstants<double> material = well_damped();
  material.nominal_penetration = 5e-4;
  material.nominal_stiffness = 4e3;
  return material;
}

/// Penetration under N, from each law's equation by hand.
template <class Law>
double expected_depth(double N) {
  if (std::is_same_v<Law, Nominal>) return 5e-4 + (N - 4e3 * 5e-4) / 2e4;
  if (std::is_same_v<Law, AzadFeatherstone>) return std::pow(N / 2e4, 2. / 3.);
  if (std::is_same_v<Law, Exponential>) return std::log(N / 0.5336) / 1150.;
  return N / 2e4;
}

/// Shift under a slow load f on N with mu = 0.8.
template <class Law>
double expected_shift(double f, double N) {
  if (std::is_same_v<Law, Lugre>) return -0.8 * N / 1e4 * std::log(1. - f / (0.8 * N));
  return f / 1e4;
}

/// At its static depth, unloaded along the slope.
template <class Law>
PointMass lying(double mass, double slope, const MaterialConstants<double>& material) {
  PointMass block{.mass = mass, .slope = slope, .azimuth = 0.7, .material = material};
  block.position.z = -Law::static_depth(block.normal_load(), material);
  return block;
}

TYPED_TEST(HoldingLaw, SticksWithThePredictedDepthAndShift) {
  auto block = lying<TypeParam>(2., 20. * degree, ground());
  EXPECT_NEAR(-block.position.z, expected_depth<TypeParam>(block.normal_load()), 1e-15);
  block.template load_slowly<TypeParam>(1e-4, 2.);
  block.template run<TypeParam>(1e-4, 2.);

  const double expected = expected_shift<TypeParam>(block.tangential_load(), block.normal_load());
  EXPECT_NEAR(block.downhill_position(), expected, 1e-3 * expected);
  const auto predicted =
      TypeParam::stick_displacement(block.tangential_load(), block.normal_load(), block.material);
  EXPECT_NEAR(*predicted, expected, 1e-12);
  EXPECT_NEAR(-block.position.z, expected_depth<TypeParam>(block.normal_load()), 1e-12);
  const Vector3d before = block.position;
  block.template run<TypeParam>(1e-4, 5.);
  EXPECT_LE(norm(block.position - before), 1e-14);  // no creep: round-off only
}

// Near break-away a bristle creeps, and with mu_s > mu_k the faster it creeps the less it holds:
// the threshold of LuGre and its like depends on how fast the load grows, except without that drop.
TYPED_TEST(HoldingLaw, HoldsUpToTheStaticFriction) {
  const double mu_k = std::is_base_of_v<LugrePredictions, TypeParam> ? 0.8 : 0.5;
  for (const double offset : {-1e-4, 1e-4}) {  // 0.0035 deg
    auto material = ground();
    material.kinetic_friction = mu_k;
    auto block = lying<TypeParam>(1., std::atan(0.8 + offset), material);
    block.template load_slowly<TypeParam>(1e-4, 4.);
    block.template run<TypeParam>(1e-4, 1.);
    const double before = block.downhill_speed();
    block.template run<TypeParam>(1e-4, 1.);
    const double gained = block.downhill_speed() - before;
    if (offset < 0.) {
      EXPECT_LE(gained, 1e-9);
      block.template run<TypeParam>(1e-4, 30.);  // it may have come in with some speed
      EXPECT_LE(block.downhill_speed(), 1e-7);
    } else {
      const double fall = slip_acceleration(g, block.slope, mu_k);
      EXPECT_NEAR(gained, fall, 0.05 * fall);
    }
    EXPECT_EQ(TypeParam::creep_speed(std::tan(block.slope), material).has_value(), offset < 0.);
  }
}

// Not hookpoint_reset, which loses friction as dt -> 0.
template <class Law>
class SlidingLaw : public ::testing::Test {};
using SlidingLaws =
    ::testing::Types<Hookpoint, Nominal, AzadFeatherstone, Lugre, Elastoplastic, Exponential>;
TYPED_TEST_SUITE(SlidingLaw, SlidingLaws);

TYPED_TEST(SlidingLaw, SlidesWithKineticFrictionInEveryDirection) {
  for (const double azimuth : {0., 0.6, std::numbers::pi / 4., 2.5}) {
    auto material = ground();
    material.static_friction = 0.5;
    material.kinetic_friction = 0.3;
    auto block = lying<TypeParam>(1., 30. * degree, material);
    block.azimuth = azimuth;
    block.template run<TypeParam>(1e-4, 1.);
    const double before = block.downhill_speed();
    block.template run<TypeParam>(1e-4, 0.5);
    const double expected = g * (0.5 - 0.3 * std::sqrt(0.75));
    EXPECT_NEAR((block.downhill_speed() - before) / 0.5, expected, 1e-5 * expected);
    EXPECT_NEAR(block.velocity.x * std::sin(azimuth), block.velocity.y * std::cos(azimuth), 1e-12);
  }
}

template <class Law>
class BristleLaw : public ::testing::Test {};
using BristleLaws = ::testing::Types<AzadFeatherstone, Lugre, Elastoplastic, Exponential>;
TYPED_TEST_SUITE(BristleLaw, BristleLaws);

// Far more than a step's worth of relaxation: the step then ends where friction is steady.
TYPED_TEST(BristleLaw, FollowsSteadyFrictionWhereAStepCannotResolveTheBristle) {
  auto material = ground();
  material.static_friction = material.kinetic_friction = 0.4;
  material.tangential_stiffness = 1e6;
  material.tangential_damping = 100.;
  auto block = lying<TypeParam>(1., 0., material);
  block.velocity.x = 1.;
  EXPECT_LT(TypeParam::resolved_speed(block.normal_load(), 1e-3, material), 0.1);
  block.template run<TypeParam>(1e-3, 0.1);
  EXPECT_NEAR(block.velocity.x, 1. - 0.4 * g * 0.1, 0.005);
  for (int i = 0; i < 20; ++i) {
    block.template step<TypeParam>(1e-3);
    ASSERT_NEAR(-block.ground_force.x, 0.4 * block.ground_force.z, 1e-9);
  }
}

// The load comes and goes with every bounce, and takes the bristle's steady deflection with it.
TYPED_TEST(BristleLaw, SlidesWithKineticFrictionWhileItBounces) {
  auto material = ground();
  material.static_friction = material.kinetic_friction = 0.4;
  material.tangential_stiffness = 1e6;
  auto block = lying<TypeParam>(1., 0., material);
  block.velocity = {3., 0., 0.5};
  double friction = 0., normal = 0.;
  for (int i = 0; i < 300; ++i) {
    block.template step<TypeParam>(1e-3);
    friction -= block.ground_force.x;
    normal += block.ground_force.z;
  }
  EXPECT_NEAR(friction, 0.4 * normal, 0.02 * normal);
}

TEST(LugreTruth, SlidesAtItsTerminalSpeedUnderViscousFriction) {
  auto material = ground();
  material.static_friction = material.kinetic_friction = 0.3;
  material.viscous_friction = 20.;
  auto block = lying<Lugre>(1., 30. * degree, material);
  block.run<Lugre>(1e-4, 2.);
  EXPECT_NEAR(block.downhill_speed(), g * (0.5 - 0.3 * std::sqrt(0.75)) / 20., 1e-9);
}

// z' over v at a deflection of `bent` times mu_k N/k_t: all of the motion bends the bristle up to
// breakaway and whenever it unbends, none from mu_k N on, half a sine between (Dupont et al. 2002).
TEST(ElastoplasticTruth, IsPlasticAsDupontsAlphaSays) {
  auto material = ground();
  material.static_friction = material.kinetic_friction = 0.5;
  const double N = 10.;
  const auto bending = [&](double bent, double breakaway, double speed) {
    material.breakaway = breakaway;
    const double z = bent * 0.5 * N / 1e4;
    const PointKinematics<double> point{
        {}, {speed, 0., 0.}, {0., 0., 1.}, N / 2e4, {{z, 0., 0.}, 0.}};
    return Elastoplastic::evaluate(point, {}, material, 0.).bristle_rate.deflection.x / speed;
  };
  for (const double bent : {0., 0.3, 0.6}) EXPECT_NEAR(bending(bent, 0.6, 0.01), 1., 1e-12);
  EXPECT_NEAR(bending(0.8, 0.6, 0.01), 1. - 0.5 * 0.8, 1e-12);
  const double at_quarter = 0.5 - 0.5 * std::sqrt(0.5);
  EXPECT_NEAR(bending(0.7, 0.6, 0.01), 1. - at_quarter * 0.7, 1e-12);
  EXPECT_NEAR(bending(1., 0.6, 0.01), 0., 1e-12);
  for (const double bent : {0.3, 0.8, 1.}) EXPECT_NEAR(bending(bent, 0.6, -0.01), 1., 1e-12);
  EXPECT_NEAR(bending(0.999, 1., 0.01), 1., 1e-12);
  // What is beyond what the load holds lets go within a microsecond, so hardly beyond.
  EXPECT_NEAR(bending(1. + 1e-13, 1., 0.01), 0., 1e-8);
}

TEST(NominalTruth, IsSmoothOverTheBlendAndLinearBeyond) {
  auto material = ground();
  material.blend_width = 2e-4;
  const auto force = [&](double depth) { return Nominal::spring_force(depth, material); };
  EXPECT_DOUBLE_EQ(force(5e-4), 2.);
  EXPECT_NEAR(force(6e-4), 4e3 * 6e-4 + 1.6e4 * 1e-8 / 4e-4, 1e-12);
  EXPECT_NEAR(force(9e-4), 4e3 * 9e-4 + 1.6e4 * 3e-4, 1e-12);
  for (const double border : {5e-4, 7e-4}) {
    const double h = 1e-9;
    const double below = (force(border) - force(border - h)) / h;
    const double above = (force(border + h) - force(border)) / h;
    EXPECT_NEAR(above, below, 1e-4 * below);
  }
  for (const double N : {1., 2.3, 3.9, 8., 50.})
    EXPECT_NEAR(force(Nominal::static_depth(N, material)), N, 1e-12 * N);
}

// sqrt(g d0): the reason for a soft top. Twice the stiffness beyond does not change it.
TEST(NominalTruth, HooksSurviveBobbingBelowTheSurvivalSpeed) {
  for (const double factor : {0.98, 1.02}) {
    auto material = ground();
    material.normal_damping = 0.;
    material.nominal_penetration = 1e-3;
    material.nominal_stiffness = g / 1e-3;
    auto block = lying<Nominal>(1., 0., material);
    EXPECT_NEAR(-block.position.z, 1e-3, 1e-15);
    block.memory.attached = true;
    block.velocity.z = factor * std::sqrt(g * 1e-3);
    bool lost = false;
    for (int i = 0; i < 20000; ++i) {
      block.step<Nominal>(1e-5);
      lost = lost || !block.memory.attached;
    }
    EXPECT_EQ(lost, factor > 1.);
  }
}

/// Rebound speed over impact speed of a mass thrown down at `speed` from `height`, without gravity.
template <class Law>
double rebound(const MaterialConstants<double>& material, double speed, double height) {
  PointMass ball{.mass = 0.5, .material = material};
  ball.position.z = height;
  ball.velocity.z = -speed;
  const double dt = 2e-7;
  do {
    ball.position += 0.5 * dt * ball.velocity;
    const PointKinematics<double> point{
        ball.position, ball.velocity, {0., 0., 1.}, -ball.position.z, {}};
    ball.velocity += dt / ball.mass * Law::evaluate(point, {}, material, dt).force;
    ball.position += 0.5 * dt * ball.velocity;
  } while (ball.velocity.z < 0. || ball.position.z < height);
  return ball.velocity.z / speed;
}

TEST(ReboundTruth, OfEveryNormalForce) {
  auto material = ground();
  for (const double damping : {0., 10., 60.}) {
    material.normal_damping = damping;
    for (const double speed : {0.02, 0.3}) {
      EXPECT_NEAR(rebound<Nominal>(material, speed, 0.), Nominal::restitution(0.5, speed, material),
                  2e-4);
      EXPECT_NEAR(rebound<AzadFeatherstone>(material, speed, 0.),
                  AzadFeatherstone::restitution(0.5, speed, material), 2e-4);
    }
  }
  material.normal_damping = 10.;
  EXPECT_NEAR(Nominal::restitution(0.5, 0.02, material),
              kelvin_voigt_restitution(10. / (2. * std::sqrt(4e3 * 0.5))), 1e-12);
  for (const double c : {0., 0.5, 4.}) {
    material.hysteresis_damping = c;
    EXPECT_NEAR(rebound<Exponential>(material, 0.3, Exponential::reach(material)),
                hunt_crossley_restitution(c * 0.3), 2e-4);
  }
}

}  // namespace
}  // namespace hookpoint::contact
