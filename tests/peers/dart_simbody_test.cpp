// DART and Simbody: their creep beside its closed form, and their traps.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/creep.h"
#include "reference/engines.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

constexpr double angle = 15. * degree;
const double f_t = g * std::sin(angle) / 4.;  // of each of the four corners, 1 kg

bool found(const simulation::EngineDescription& description) { return description.found; }

struct Creep {
  double measured = 0., expected = 0.;
};
Creep creep(simulation::EngineFactory make,
            std::optional<double> (*mixing)(const simulation::Experiment&), double deltat,
            const char* settings) {
  const auto experiment = sloped_block(angle, 0., 0.5, deltat, settings);
  const auto engine = make(experiment);
  return {
      creep_speed(*engine, slope_axes(angle, 0.).downhill, deltat, 500. * deltat, 1000. * deltat),
      mixing(experiment).value() * f_t};
}

// CFM 1e-5 of each row's own diagonal, as impulses: J M^-1 J^T along the fall at a corner is
// 1/m + (h/2)^2/I_yy + (w/2)^2/I_zz = 3.1 per kg.
TEST(DartBlock, CreepsByItsRelativeMixing) {
  if (!found(reference::describe_dart())) GTEST_SKIP() << "engine dart is not found";
  for (const double deltat : {1e-3, 1e-2}) {
    const auto experiment = sloped_block(angle, 0., 0.5, deltat);
    EXPECT_NEAR(reference::dart_friction_mixing(experiment).value(), 1e-5 * 3.1 * deltat,
                1e-9 * deltat);
    for (const char* settings : {"default", "matched"}) {
      const Creep block =
          creep(reference::make_dart, reference::dart_friction_mixing, deltat, settings);
      EXPECT_NEAR(block.measured, block.expected, 0.01 * block.expected) << settings << deltat;
    }
  }
}

TEST(SimbodyBlock, CreepsWhereItsStictionCarriesTheLoad) {
  if (!found(reference::describe_simbody())) GTEST_SKIP() << "engine simbody is not found";
  for (const char* settings : {"default", "recommended", "matched"}) {
    const Creep block =
        creep(reference::make_simbody, reference::simbody_friction_mixing, 1e-3, settings);
    EXPECT_NEAR(block.measured, block.expected, 0.01 * block.expected) << settings;
  }
}

/// Acceleration, once friction is full, of a block on level ground, mu 0.2, under a push of 0.268 m
/// g at `direction`.
double pushed(simulation::EngineFactory make, double direction) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.2, 1e-3);
  const double push = g * std::tan(angle);
  simulation::ForceSpec force;
  force.point = {0., 0., -0.05};
  force.force = push * Vector3d{std::cos(direction), std::sin(direction), 0.};
  experiment.forces.push_back(force);
  const auto engine = make(experiment);
  EXPECT_TRUE(run_until(*engine, 1e-3, 0.2));
  const double before = norm(engine->state().bodies[0].velocity);
  EXPECT_TRUE(run_until(*engine, 1e-3, 0.4));
  return (norm(engine->state().bodies[0].velocity) - before) / 0.2;
}

// DART's friction is a box whose first axis is the world's z in the ground: along the fall of any
// slope, so that a block released there slides as on a cone. On level ground it is along x and y,
// and holds up to mu sqrt(2) = 0.283 between them.
TEST(DartBlock, SticksAcrossItsFrictionBoxOnLevelGroundOnly) {
  if (!found(reference::describe_dart())) GTEST_SKIP() << "engine dart is not found";
  const double coulomb = g * (std::tan(angle) - 0.2);
  EXPECT_NEAR(pushed(reference::make_dart, 0.), coulomb, 1e-3 * coulomb);
  EXPECT_LT(pushed(reference::make_dart, 45. * degree), 1e-5);
  const double downhill = g * (std::sin(angle) - 0.2 * std::cos(angle));
  for (const double azimuth : {0., 45. * degree}) {
    const auto engine = reference::make_dart(sloped_block(angle, azimuth, 0.2, 1e-3));
    ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
    EXPECT_NEAR(dot(engine->state().bodies[0].velocity, slope_axes(angle, azimuth).downhill),
                downhill, 1e-3 * downhill);
  }
}

// Its constants belong to the process: a world at `matched` leaves one at `default` as it is.
TEST(DartBlock, KeepsTheConstantsOfEachWorld) {
  if (!found(reference::describe_dart())) GTEST_SKIP() << "engine dart is not found";
  const auto alone = reference::make_dart(sloped_block(angle, 0., 0.5, 1e-3));
  const auto one = reference::make_dart(sloped_block(angle, 0., 0.5, 1e-3));
  const auto other = reference::make_dart(sloped_block(angle, 0., 0.5, 1e-3, "matched"));
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(alone->step().ok());
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(one->step().ok() && other->step().ok());
  EXPECT_EQ(one->state().bodies[0].position, alone->state().bodies[0].position);
}

TEST(SimbodyBlock, SlidesWhereAConeSlides) {
  if (!found(reference::describe_simbody())) GTEST_SKIP() << "engine simbody is not found";
  const double coulomb = g * (std::tan(angle) - 0.2);
  for (const double direction : {0., 45. * degree})
    EXPECT_NEAR(pushed(reference::make_simbody, direction), coulomb, 0.01 * coulomb);
}

}  // namespace
}  // namespace hookpoint
