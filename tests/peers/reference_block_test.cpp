// The sloped block under ODE and Bullet: closed forms, and the figures measured elsewhere for the
// same block.
#include <gtest/gtest.h>

#include "reference/bullet/engine.h"
#include "reference/engines.h"
#include "reference/ode/engine.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

constexpr double angle = 15. * degree;
const double f_t = g * std::sin(angle) / 4.;  // of each of the four corners, 1 kg

double creep(simulation::EngineFactory make, double azimuth, double mu, double deltat,
             const char* settings, double from, double to) {
  const auto engine = make(sloped_block(angle, azimuth, mu, deltat, settings));
  return creep_speed(*engine, slope_axes(angle, azimuth).downhill, deltat, from, to);
}

TEST(OdeBlock, CreepsAtMixingTimesTangentialForce) {
  for (const double deltat : {1e-3, 1e-2}) {
    const double expected = 1e-10 * f_t;  // ODE's documented double precision CFM
    EXPECT_NEAR(creep(reference::ode_peer.make, 0., 0.5, deltat, "default", 1., 3.), expected,
                0.01 * expected);
    const auto experiment = sloped_block(angle, 0., 0.5, deltat);
    EXPECT_EQ(reference::ode_peer.constraint_constants(experiment).tangential_mixing, 1e-10);
  }
}

TEST(OdeBlock, CreepsAtTheMixingThatTheExperimentAsksFor) {
  auto experiment = sloped_block(angle, 0., 0.5, 1e-3);
  experiment.constraint_mixing = 1e-6;
  EXPECT_EQ(reference::ode_peer.constraint_constants(experiment).tangential_mixing, 1e-6);
  const auto engine = reference::ode_peer.make(experiment);
  const double speed = creep_speed(*engine, slope_axes(angle, 0.).downhill, 1e-3, 1., 3.);
  EXPECT_NEAR(speed, 1e-6 * f_t, 1e-8 * f_t);
}

TEST(OdeBlock, CreepsAtTheMatchedDampersSpeed) {
  for (const auto make : {reference::ode_peer.make, reference::ode_quickstep_peer.make})
    for (const double deltat : {1e-4, 1e-3, 1e-2}) {
      const double expected = f_t / (deltat * 1e5 + 300.);  // k_t, c_t of the material
      EXPECT_NEAR(creep(make, 0., 0.5, deltat, "matched", 0.5, 1.), expected, 0.01 * expected);
    }
}

// Inside the surface layer nothing pushes out what the normal rows let in, so the lower edge sinks
// faster: the contacts creep at CFM f_t and the origin, h/2 above them, at CFM f_t (1 + (h/l)^2).
TEST(OdeBlock, TiltsIntoTheSurfaceLayerAtTheRecommendedSetting) {
  const double expected = 1e-10 * f_t * (1. + 0.25);
  EXPECT_NEAR(creep(reference::ode_peer.make, 0., 0.5, 1e-3, "recommended", 1., 3.), expected,
              0.01 * expected);
}

// The closed form shares the pull among the points that carry, and there is none where shapes leave
// them to the engine.
TEST(OdeBlock, IsPredictedFromThePointsThatCarryIt) {
  const double pull = g * std::sin(angle);
  const auto box = sloped_block(angle, 0.3, 0.5, 1e-3);
  EXPECT_NEAR(reference::ode_peer.creep(box)->downhill, 1e-10 * pull / 4., 1e-9 * 1e-10 * pull);

  auto six = box;
  six.robots[0].base.shapes.clear();
  for (const double x : {-0.1, 0., 0.1})
    for (const double y : {-0.1, 0.1})
      for (const double z : {-0.05, 0.05}) six.robots[0].base.boundary_points.push_back({x, y, z});
  const double expected = 1e-10 * pull / 6.;
  EXPECT_NEAR(reference::ode_peer.creep(six)->downhill, expected, 1e-9 * expected);
  const auto engine = reference::ode_peer.make(six);
  EXPECT_NEAR(creep_speed(*engine, slope_axes(angle, 0.3).downhill, 1e-3, 1., 2.), expected,
              0.01 * expected);

  auto cylinder = box, two = box;
  cylinder.robots[0].base.shapes[0].geometry = simulation::Cylinder{0.1, 0.1};
  two.robots[0].base.shapes.push_back(box.robots[0].base.shapes[0]);
  for (const auto& shapes : {cylinder, two}) EXPECT_FALSE(reference::ode_peer.creep(shapes));
}

// The tilt too: (h/l)^2 = 1/4.
TEST(OdeBlock, IsPredictedWithItsTiltIntoTheSurfaceLayer) {
  const double expected = 1e-10 * f_t * 1.25;
  EXPECT_NEAR(
      reference::ode_peer.creep(sloped_block(angle, 0., 0.5, 1e-3, "recommended"))->downhill,
      expected, 1e-6 * expected);
}

TEST(OdeBlock, SticksAltogetherAcrossItsFrictionBox) {
  // tan 15 deg = 0.268 > mu: a cone slides, a box of half width mu holds up to mu sqrt(2) = 0.283.
  EXPECT_LT(std::abs(creep(reference::ode_peer.make, 45. * degree, 0.2, 1e-3, "default", 1., 2.)),
            1e-9);
  EXPECT_GT(creep(reference::ode_peer.make, 0., 0.2, 1e-3, "default", 1., 2.), 0.1);
}

// Four corners are 12 rows for 6 degrees of freedom, and at azimuth 0 they load each other in
// pairs: Dantzig's method meets a step of length 0 and says so, to the user of the run and not to
// stderr.
TEST(OdeBlock, TellsOfTheSolversTroubleOnceAndPrintsNothing) {
  const auto engine =
      reference::ode_peer.make(sloped_block(10. * degree, 0., 0.2, 1e-3, "default"));
  ::testing::internal::CaptureStderr();
  for (int step = 0; step < 500; ++step) ASSERT_TRUE(engine->step().ok());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(engine->state().notices.size(), 1u);
  EXPECT_NE(engine->state().notices[0].find("LCP internal error"), std::string::npos);
}

// The figures were taken with ODE's own first seed, 0; another seed changes them by up to 7 % at 1
// ms and 25 % at 10 ms.
TEST(QuickStepBlock, CreepsAsMeasuredElsewhere) {
  const auto creep_of_seed_0 = [](double deltat) {
    simulation::Experiment experiment = sloped_block(angle, 0., 0.5, deltat);
    experiment.seed = 0;
    const auto engine = reference::ode_quickstep_peer.make(experiment);
    return creep_speed(*engine, slope_axes(angle, 0.).downhill, deltat, 5., 20.);
  };
  EXPECT_NEAR(creep_of_seed_0(1e-3), 3.1e-5, 0.05 * 3.1e-5);
  EXPECT_NEAR(creep_of_seed_0(1e-2), 3.5e-4, 0.05 * 3.5e-4);
}

TEST(QuickStepBlock, ConvergesAtOneHundredIterations) {
  EXPECT_LT(creep(reference::ode_quickstep_peer.make, 0., 0.5, 1e-3, "recommended", 1., 2.), 1e-9);
}

TEST(BulletBlock, CreepsNoFasterThanMeasuredElsewhere) {
  for (const char* settings : {"default", "matched"})
    EXPECT_LT(std::abs(creep(reference::bullet_peer.make, 0., 0.5, 1e-3, settings, 5., 10.)), 5e-8)
        << settings;
}

// `recommended` is credited to PyBullet's server, whose bodies are multibodies. As one the block
// creeps at -4.8e-6 m/s downhill and 1.45e-5 m/s to the side, measured elsewhere.
TEST(BulletBlock, CreepsAsideAsAMultibodyAtTheRecommendedSetting) {
  const auto axes = slope_axes(angle, 0.);
  const auto speed = [&](const Vector3d& direction) {
    const auto engine =
        reference::bullet_peer.make(sloped_block(angle, 0., 0.5, 1e-3, "recommended"));
    return creep_speed(*engine, direction, 1e-3, 5., 10.);
  };
  EXPECT_NEAR(speed(axes.downhill), -4.8e-6, 0.2e-6);
  EXPECT_NEAR(std::abs(speed(cross(axes.normal, axes.downhill))), 1.45e-5, 0.05e-5);
}

TEST(BulletBlock, SlidesWhereAConeSlides) {
  const double a = g * (std::sin(angle) - 0.2 * std::cos(angle));
  for (const char* settings : {"default", "recommended", "matched"})
    EXPECT_NEAR(creep(reference::bullet_peer.make, 45. * degree, 0.2, 1e-3, settings, 1., 2.),
                1.5 * a, 0.02 * 1.5 * a)
        << settings;
}

TEST(PeerBlock, SlidesAtCoulombsAcceleration) {
  const double a = g * (std::sin(angle) - 0.2 * std::cos(angle));
  for (const auto& peer : reference::peers()) {
    const double deltat = 1e-3;
    const auto engine = peer.make(sloped_block(angle, 0., 0.2, deltat));
    ASSERT_TRUE(run_until(*engine, deltat, 2.));
    const double speed = dot(engine->state().bodies[0].velocity, slope_axes(angle, 0.).downhill);
    const double tolerance = peer.name == "ode" ? 1e-3 : 1e-2;  // of the iterative solvers
    EXPECT_NEAR(speed, 2. * a, tolerance * 2. * a) << peer.name;
  }
}

TEST(PeerBlock, RestsAtTheMatchedSpringsDepth) {
  const double expected = g * std::cos(angle) / (4. * 1e5);
  for (const auto& peer : reference::peers()) {
    const auto engine = peer.make(sloped_block(angle, 0., 0.5, 1e-3, "matched"));
    ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
    const double height = dot(engine->state().bodies[0].position, slope_axes(angle, 0.).normal);
    EXPECT_NEAR(0.05 - height, expected, 0.01 * expected) << peer.name;
  }
}

TEST(PeerBlock, ReportsTheForcesThatHoldIt) {
  for (const auto& peer : reference::peers())
    for (const char* settings : {"default", "recommended", "matched"}) {
      const auto engine = peer.make(sloped_block(angle, 30. * degree, 0.6, 1e-3, settings));
      ASSERT_TRUE(run_until(*engine, 1e-3, 2.));
      const auto& body = engine->state().bodies[0];
      EXPECT_NEAR(body.contact_force.x, 0., 0.02) << peer.name << " " << settings;
      EXPECT_NEAR(body.contact_force.y, 0., 0.02) << peer.name << " " << settings;
      EXPECT_NEAR(body.contact_force.z, g, 0.02 * g) << peer.name << " " << settings;
      EXPECT_GE(body.contacts, 3) << peer.name << " " << settings;
    }
}

}  // namespace
}  // namespace hookpoint
