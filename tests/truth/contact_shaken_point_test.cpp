// A point on a slope, shaken along it and sideways. Below the cone a rigid Coulomb body does not
// move: hooks and elastoplastic bristles return, LuGre drifts by its closed form. Above it the
// return map slips as Coulomb's does, the nearer the stiffer; a hook thrown to the foot does not.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/force_law.h"
#include "tests/support/point_mass.h"

namespace hookpoint::contact {
namespace {

using namespace test_support;

constexpr double mu = 0.5;

/// Load along the slope over the normal load: `mean` + `amplitude` sin(2 pi f t).
struct Shaking {
  double mean = 0.25, amplitude = 0., frequency = 1.;
  double at(double time) const {
    return mean + amplitude * std::sin(2. * std::numbers::pi * frequency * time);
  }
};

/// Distance [m] from the end of cycle `from` to that of cycle `to`, the mean load put on slowly
/// before.
template <class Law>
double drift(const MaterialConstants<double>& material, const Shaking& shaking, int from, int to,
             double dt) {
  PointMass block{.mass = 1., .slope = std::atan(1.), .material = material};
  const double load = block.normal_load();
  block.position.z = -Law::static_depth(load, material);
  for (long i = std::lround(1. / dt); i > 0; --i) {
    block.pull = shaking.mean * (1. - dt * static_cast<double>(i));
    block.template step<Law>(dt);
  }
  block.pull = shaking.mean;
  block.template run<Law>(dt, 1.);
  double start = 0.;
  const long steps = std::lround(1. / (shaking.frequency * dt));
  for (long i = 0; i < to * steps; ++i) {
    if (i == from * steps) start = block.downhill_position();
    block.pull = shaking.at(static_cast<double>(i) * dt);
    block.template step<Law>(dt);
  }
  return block.downhill_position() - start;
}

/// The same of a rigid body under Coulomb friction: it slips while it moves or is pulled above mu
/// N.
double rigid_drift(const Shaking& shaking, int cycles, double dt) {
  const double load = g * std::cos(std::atan(1.));
  double x = 0., v = 0.;
  const long steps = std::lround(1. / (shaking.frequency * dt));
  for (long i = 0; i < cycles * steps; ++i) {
    const double excess = shaking.at(static_cast<double>(i) * dt) - mu;
    if (v > 0. || excess > 0.) v = std::max(0., v + dt * excess * load);
    x += dt * v;
  }
  return x;
}

MaterialConstants<double> ground(double stiffness) {
  MaterialConstants<double> material;
  material.static_friction = material.kinetic_friction = mu;
  material.normal_stiffness = material.tangential_stiffness = stiffness;
  material.normal_damping = material.tangential_damping = 0.5 * std::sqrt(stiffness);
  return material;
}

TEST(ShakenBelowTheCone, HooksAndElastoplasticBristlesReturn) {
  const Shaking shaking{0.15, 0.15, 2.};  // up to 0.3 of a cone of 0.5, breakaway at 0.35
  const auto material = ground(1e4);
  EXPECT_LE(std::abs(drift<Hookpoint>(material, shaking, 3, 13, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<HookpointReset>(material, shaking, 3, 13, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<Nominal>(material, shaking, 3, 13, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<AzadFeatherstone>(material, shaking, 3, 13, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<Elastoplastic>(material, shaking, 3, 13, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<Exponential>(material, shaking, 3, 13, 1e-4)), 1e-12);
}

TEST(ShakenBelowTheCone, LugreDriftsByItsClosedForm) {
  const Shaking shaking{0.25, 0.1, 0.5};
  const double load = g * std::cos(std::atan(1.));
  for (const double stiffness : {1e4, 1e5}) {
    auto material = ground(stiffness);
    material.tangential_damping = 0.05 * std::sqrt(stiffness);
    // s from 0.3 to 0.7 of the cone, z_s = 0.5 N/k_t
    const double expected = 0.5 * load / stiffness * std::log((1. - 0.09) / (1. - 0.49));
    EXPECT_NEAR(Lugre::drift_per_cycle(0.15 * load, 0.35 * load, load, material), expected, 1e-12);
    EXPECT_NEAR(drift<Lugre>(material, shaking, 1, 5, 1e-4) / 4., expected, 0.01 * expected);
  }
  const Shaking about_zero{0., 0.2, 0.5};
  EXPECT_LE(std::abs(drift<Lugre>(ground(1e4), about_zero, 2, 4, 1e-4)), 1e-6);
}

TEST(ShakenAboveTheCone, TheReturnMapConvergesToRigidCoulombAndAThrownHookDoesNot) {
  const Shaking shaking{0.35, 0.25, 2.};  // from 0.1 to 0.6 of N, cone 0.5
  const double rigid = rigid_drift(shaking, 4, 1e-6) / 4.;
  EXPECT_GT(rigid, 1e-4);
  std::vector<double> errors;
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    const double dt = 2e-3 / std::sqrt(stiffness);
    const double own = drift<Hookpoint>(ground(stiffness), shaking, 2, 6, dt) / 4.;
    errors.push_back(std::abs(own - rigid) / rigid);
  }
  EXPECT_LE(errors[1], 0.5 * errors[0]);
  EXPECT_LE(errors[2], 0.5 * errors[1]);
  EXPECT_LE(errors[2], 0.005);
  auto material = ground(1e6);
  material.tangential_damping = 2.;  // a damper that slip feels would hide what the hook lost
  EXPECT_NEAR(drift<Hookpoint>(material, shaking, 2, 6, 2e-6) / 4., rigid, 0.01 * rigid);
  EXPECT_GT(drift<HookpointReset>(material, shaking, 2, 6, 2e-6) / 4., 1.5 * rigid);
}

/// A point on 20 deg pushed to both sides, so that the load along the slope is `peak` times the
/// cone's at both ends.
struct SidewaysShaking {
  double peak = 0.9, frequency = 1.;
  double cone = mu * g * std::cos(slope), down = g * std::sin(slope);
  double across(double time) const {
    return std::sqrt(peak * peak * cone * cone - down * down) *
           std::cos(2. * std::numbers::pi * frequency * time);
  }
  static constexpr double slope = std::numbers::pi / 9.;
};

/// Way down the slope in the cycle after the third.
template <class Law>
double drift(const MaterialConstants<double>& material, const SidewaysShaking& shaking, double dt) {
  PointMass point{.mass = 1., .slope = shaking.slope, .material = material};
  point.settle();
  double start = 0.;
  const long steps = std::lround(1. / (shaking.frequency * dt));
  for (long i = 0; i < 4 * steps; ++i) {
    if (i == 3 * steps) start = point.downhill_position();
    point.push.y = shaking.across(static_cast<double>(i) * dt);
    point.step<Law>(dt);
  }
  return point.downhill_position() - start;
}

/// The same of a rigid body. Friction is implicit: it points against the velocity that it leaves.
double rigid_drift(const SidewaysShaking& shaking, double dt) {
  double along = 0., across = 0., way = 0.;
  const long steps = std::lround(1. / (shaking.frequency * dt));
  for (long i = 0; i < 4 * steps; ++i) {
    along += dt * shaking.down;
    across += dt * shaking.across((static_cast<double>(i) + 0.5) * dt);
    const double speed = std::hypot(along, across);
    const double kept = speed > 0. ? std::max(0., 1. - dt * shaking.cone / speed) : 0.;
    along *= kept;
    across *= kept;
    if (i >= 3 * steps) way += dt * along;
  }
  return way;
}

/// Quasi-static LuGre, s the load over the cone's, z_s s the bristle: its speed w over z_s solves
/// w^2 = |s' + w s|^2, and the point goes w s_x down while s' comes back to where it was.
double lugre_drift(const SidewaysShaking& shaking, double stiffness) {
  constexpr int parts = 100000;
  double sum = 0.;
  const auto aside = [&](double part) {
    return shaking.across(part / parts / shaking.frequency) / shaking.cone;
  };
  for (int i = 0; i < parts; ++i) {
    const Vector3d load{shaking.down / shaking.cone, aside(i + 0.5), 0.};
    const Vector3d change{0., aside(i + 1.) - aside(i), 0.};
    const double part = dot(load, change), rest = 1. - dot(load, load);
    sum += load.x * (part + std::sqrt(part * part + rest * dot(change, change))) / rest;
  }
  return shaking.cone / stiffness * sum;
}

// Friction turns with the slip, so a law has to take the load's direction from both axes.
TEST(ShakenSideways, TheReturnMapConvergesToRigidCoulomb) {
  const SidewaysShaking shaking{.peak = 1.1};
  const double rigid = rigid_drift(shaking, 2e-6);
  EXPECT_GT(rigid, 0.01);
  std::vector<double> errors;
  for (const double stiffness : {2e4, 2e5, 2e6}) {
    auto material = ground(stiffness);
    material.tangential_damping = 0.04 * std::sqrt(stiffness);
    errors.push_back(std::abs(drift<Hookpoint>(material, shaking, 1e-4) - rigid) / rigid);
  }
  EXPECT_LE(errors[1], 0.5 * errors[0]);
  EXPECT_LE(errors[2], 0.5 * errors[1]);
  EXPECT_LE(errors[2], 0.001);
}

TEST(ShakenSideways, LugreDriftsAndElastoplasticBristlesDoNot) {
  const SidewaysShaking shaking{.peak = 0.9};
  auto material = ground(2e5);
  material.tangential_damping = 0.04 * std::sqrt(2e5);
  const double expected = lugre_drift(shaking, 2e5);
  EXPECT_NEAR(drift<Lugre>(material, shaking, 1e-4), expected, 0.01 * expected);
  material.breakaway = 0.95;
  EXPECT_LE(std::abs(drift<Elastoplastic>(material, shaking, 1e-4)), 1e-12);
  EXPECT_LE(std::abs(drift<Hookpoint>(material, shaking, 1e-4)), 1e-12);
}

}  // namespace
}  // namespace hookpoint::contact
