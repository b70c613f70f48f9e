// What is particular to MuJoCo: creep by regularisation, a pyramid in place of the cone, warnings
// and refusals that it would print, and robots that stand and walk.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "reference/engines.h"
#include "reference/mujoco/engine.h"
#include "reference/mujoco_materials.h"
#include "tests/support/folders.h"
#include "tests/support/reference_scenes.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

/// Tests of an engine that this build may lack.
class Mujoco : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!reference::mujoco_peer.found()) GTEST_SKIP() << "this build has no MuJoCo";
  }
};

double creep(const simulation::Experiment& experiment, double angle, double azimuth) {
  const auto engine = reference::mujoco_peer.make(experiment);
  return creep_speed(*engine, slope_axes(angle, azimuth).downhill, experiment.deltat, 1., 2.);
}

/// The same as a vector, in one run.
simulation::CreepVelocity creep_velocity(const simulation::Experiment& experiment, double angle,
                                         double azimuth) {
  const auto engine = reference::mujoco_peer.make(experiment);
  const SlopeAxes axes = slope_axes(angle, azimuth);
  run_until(*engine, experiment.deltat, 1.);
  const Vector3d start = engine->state().bodies[0].position;
  run_until(*engine, experiment.deltat, 2.);
  const Vector3d way = engine->state().bodies[0].position - start;
  return {dot(way, axes.downhill), dot(way, cross(axes.normal, axes.downhill))};
}

simulation::Experiment block_with_corners(double angle, double azimuth, double mu,
                                          const char* settings) {
  simulation::Experiment experiment = sloped_block(angle, azimuth, mu, 1e-3, settings);
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1})
      for (const double z : {-0.05, 0.05})
        experiment.robots[0].base.boundary_points.push_back({x, y, z});
  experiment.robots[0].base.shapes[0].point_count = 8;
  return experiment;
}

TEST_F(Mujoco, CreepsAsItsRegularisationSays) {
  int predicted = 0;
  for (const char* settings : {"default", "recommended", "matched"})
    for (const double slope : {5., 15., 25.})
      for (const double azimuth : {0., 30., 45., 90.}) {
        const simulation::Experiment experiment =
            block_with_corners(slope * degree, azimuth * degree, 0.8, settings);
        const auto expected = reference::mujoco_peer.creep(experiment);
        if (!expected) continue;
        ++predicted;
        const auto found = creep_velocity(experiment, slope * degree, azimuth * degree);
        EXPECT_NEAR(found.downhill, expected->downhill, 0.01 * expected->downhill)
            << settings << " " << slope << " " << azimuth;
        EXPECT_NEAR(found.sideways, expected->sideways, 0.01 * expected->downhill)
            << settings << " " << slope << " " << azimuth;
      }
  // All but the default at 25 deg across its pyramid, where two of the corners have fewer rows.
  EXPECT_EQ(predicted, 34);
}

// Where the row against the pull along one tangent is lost, the speed along it grows faster than
// the load. The centre of mass is at the contacts, so that all carry alike.
TEST_F(Mujoco, CreepsAsideBetweenTheEdgesOfItsPyramid) {
  for (const double azimuth : {15. * degree, -15. * degree, 75. * degree}) {
    auto experiment = block_with_corners(30. * degree, azimuth, 0.8, "default");
    experiment.robots[0].base.mass.center_of_mass = {0., 0., -0.0499};
    const auto expected = reference::mujoco_peer.creep(experiment);
    ASSERT_TRUE(expected);
    EXPECT_GT(std::abs(expected->sideways), 0.05 * expected->downhill);
    const auto found = creep_velocity(experiment, 30. * degree, azimuth);
    EXPECT_NEAR(found.downhill, expected->downhill, 0.02 * expected->downhill) << azimuth;
    EXPECT_NEAR(found.sideways, expected->sideways, 0.05 * std::abs(expected->sideways)) << azimuth;
  }
}

// The manual's last resort: elliptic cones creep at 6.6e-6 m/s here.
TEST_F(Mujoco, CreepsLessAfterNoSlipIterations) {
  const auto experiment = sloped_block(15. * degree, 0., 0.8, 1e-3, "noslip");
  EXPECT_LT(std::abs(creep(experiment, 15. * degree, 0.)), 1e-6);
  EXPECT_FALSE(reference::mujoco_peer.creep(experiment));
}

TEST_F(Mujoco, CreepsAtTheMatchedDampersSpeed) {
  for (const double deltat : {1e-4, 1e-3, 1e-2}) {
    const double expected = g * std::sin(15. * degree) / 4. / (deltat * 1e5 + 300.);
    EXPECT_NEAR(creep(sloped_block(15. * degree, 0.3, 0.5, deltat, "matched"), 15. * degree, 0.3),
                expected, 1e-6 * expected);
  }
}

// tan 15 deg = 0.268 > mu = 0.2. The pyramid's corners are on the cone, its faces mu/sqrt(2) away,
// and at 45 deg a block slides across a face, at g (sin - mu/sqrt(2) cos): 86 % too fast. (The
// tangents of a tilted contact are not quite at 45 deg to the fall.)
TEST_F(Mujoco, PyramidLetsABlockSlideTooFastAcrossItsFacesAndTheConeDoesNot) {
  const double s = std::sin(15. * degree), c = std::cos(15. * degree);
  const double cone = 1.5 * g * (s - 0.2 * c), face = 1.5 * g * (s - 0.2 * c / std::sqrt(2.));
  EXPECT_NEAR(face / cone, 1.86, 0.005);
  const auto speed = [](double azimuth, const char* settings) {
    const double turn = azimuth * degree;
    return creep(sloped_block(15. * degree, turn, 0.2, 1e-3, settings), 15. * degree, turn);
  };
  EXPECT_NEAR(speed(45., "default"), face, 0.005 * face);
  EXPECT_NEAR(speed(0., "default"), cone, 0.001 * cone);
  for (const char* settings : {"recommended", "matched"})
    EXPECT_NEAR(speed(45., settings), cone, 0.001 * cone) << settings;
}

// The engine's own colliders and our points make the same contacts, down to the directions of the
// pyramid: at 45 deg of slope and 60 deg of azimuth MuJoCo takes them from z in place of y.
TEST_F(Mujoco, SlidesOnFourPointsAsOnABox) {
  for (const double slope : {20., 45.})
    for (const double azimuth : {20., 60.}) {
      simulation::Experiment experiment =
          block_with_corners(slope * degree, azimuth * degree, 0.2, "default");
      // In the ground by 10 um: on it, rounding would say which corners touch.
      experiment.robots[0].location -= 1e-5 * slope_axes(slope * degree, azimuth * degree).normal;
      const auto box = reference::mujoco_peer.make(experiment);
      experiment.robots[0].base.shapes.clear();
      const auto points = reference::mujoco_peer.make(experiment);
      // Not for long: what slides hops, and then rounding grows.
      ASSERT_TRUE(run_until(*box, 1e-3, 0.05) && run_until(*points, 1e-3, 0.05));
      EXPECT_NEAR(norm(box->state().bodies[0].position - points->state().bodies[0].position), 0.,
                  1e-7)
          << slope << " " << azimuth;
    }
}

// In its convex contact problem a sliding contact pushes with mu B v beside its spring, so it
// leaves the ground and falls back; the impulses still are those of the weight.
TEST_F(Mujoco, HopsWhileItSlidesAndCarriesItsWeightInTheMean) {
  for (const char* settings : {"default", "recommended", "matched"}) {
    const auto engine =
        reference::mujoco_peer.make(sloped_block(15. * degree, 0., 0.2, 1e-3, settings));
    ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
    int airborne = 0;
    double load = 0.;
    for (int i = 0; i < 1000; ++i) {
      ASSERT_TRUE(engine->step().ok());
      const simulation::BodyState& body = engine->state().bodies[0];
      if (body.contacts == 0) ++airborne;
      load += dot(body.contact_force, slope_axes(15. * degree, 0.).normal) / 1000.;
    }
    EXPECT_GT(airborne, 200) << settings;
    EXPECT_NEAR(load, g * std::cos(15. * degree), 0.01 * g) << settings;
  }
}

TEST_F(Mujoco, SlidesOnEachTileByItsOwnFriction) {
  simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.8, 1e-3, "recommended");
  experiment.materials.push_back(experiment.materials[0]);
  experiment.materials[1].constants.static_friction = 0.;
  experiment.materials[1].constants.kinetic_friction = 0.;
  experiment.terrain->patches.push_back({-100., 1., 100., 3., 1});
  simulation::RobotSpec other = experiment.robots[0];
  other.name = "other";
  other.location.y = 2.;
  experiment.robots.push_back(other);
  const auto engine = reference::mujoco_peer.make(experiment);
  ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
  EXPECT_LT(norm(engine->state().bodies[0].velocity), 1e-4);
  // Without friction at all: MuJoCo's least coefficient, 1e-5, would cost 4e-5 of it.
  const double expected = g * std::sin(15. * degree);
  EXPECT_NEAR(norm(engine->state().bodies[1].velocity), expected, 1e-6 * expected);
}

TEST_F(Mujoco, SaysThatItHasNoRestitution) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  experiment.materials[0].constants.restitution = 0.5;
  const auto notices = reference::mujoco_peer.make(experiment)->state().notices;
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_NE(notices[0].find("restitution"), std::string::npos);
}

// Beyond its room for contacts MuJoCo drops some: it warns once on the terminal and in a file of
// the current folder, which must stay as they are.
TEST_F(Mujoco, TurnsAWarningIntoANotice) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  simulation::BodySpec& base = experiment.robots[0].base;
  base.shapes.clear();
  for (int i = 0; i < 300; ++i) base.boundary_points.push_back({1e-4 * i, 0., -0.0501});
  const auto engine = reference::mujoco_peer.make(experiment);
  std::filesystem::remove("MUJOCO_LOG.TXT");
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(engine->step().ok());
  EXPECT_EQ(::testing::internal::GetCapturedStderr() + ::testing::internal::GetCapturedStdout(),
            "");
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
  ASSERT_EQ(engine->state().notices.size(), 1u);
  EXPECT_NE(engine->state().notices[0].find("MuJoCo has room for 250 contacts"), std::string::npos);
}

TEST_F(Mujoco, PassesOnWhatItsCompilerRefuses) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  // No body has that: I_zz <= I_xx + I_yy.
  experiment.robots[0].base.mass.inertia = {1., 1., 5., 0., 0., 0.};
  try {
    reference::mujoco_peer.make(experiment);
    FAIL() << "an impossible inertia was taken";
  } catch (const simulation::ExperimentError& error) {
    EXPECT_NE(std::string(error.what()).find("engine mujoco: "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("inertia"), std::string::npos) << error.what();
  }
}

Loaded hexapod(const std::string& scene, const std::string& settings) {
  Loaded loaded = load_file(std::filesystem::path(testing::source_folder()) / "configs/scenes" /
                            (scene + ".hook"));
  if (loaded.experiment) loaded.experiment->settings = settings;
  return loaded;
}

TEST_F(Mujoco, CarriesAStandingHexapod) {
  for (const char* settings : {"default", "recommended", "matched"}) {
    Running run(hexapod("standing_hexapod", settings), reference::mujoco_peer.make);
    run.step(8000);  // 4 s
    double load = 0.;
    for (int i = 0; i < 200; ++i) {
      run.step();
      for (const simulation::BodyState& body : run.world().state().bodies)
        load += body.contact_force.z / 200.;
    }
    EXPECT_NEAR(load, 41.398, 1e-3 * 41.398) << settings;
    EXPECT_GT(run["hexapod.base.location.z"], 0.05) << settings;
  }
}

TEST_F(Mujoco, LetsAHexapodWalk) {
  for (const char* settings : {"default", "recommended", "matched"}) {
    Running run(hexapod("walking_hexapod", settings), reference::mujoco_peer.make);
    run.step(12000);  // 6 s
    EXPECT_GT(run["hexapod.base.location.z"], 0.08) << settings;
    EXPECT_NEAR(run["hexapod.base.location.x"], 0.09 * 6., 0.1) << settings;
    EXPECT_NEAR(run["hexapod.base.location.y"], 0., 0.02) << settings;
  }
}

/// Of friction 0.1 on ground of 0.9, as a shape and as points: a = g (sin - 0.1 cos).
TEST_F(Mujoco, HasWhatFootAndGroundMakeTogether) {
  const auto slides = [](const std::string& body) {
    const std::string text =
        "World w { deltat = 0.1 ms; engine = mujoco; Material floor { static_friction = 0.9; } "
        "Material steel { static_friction = 0.1; } Terrain.Slope ground { angle = 30 deg; material "
        "= floor; } Robot box { Base.mobile { rest_on = ground; " +
        body + " } } }";
    Running run(text, reference::mujoco_peer.make);
    run.step(5000);
    const double before = run["box.velocity.x"];
    run.step(5000);
    return (run["box.velocity.x"] - before) / 0.5 / std::sqrt(0.75);
  };
  const double expected = 9.81 * (0.5 - 0.1 * std::sqrt(0.75));
  EXPECT_NEAR(slides("Shape.Box { dimensions = 0.2, 0.2, 0.05; mass = 2; material = steel; }"),
              expected, 0.01 * expected);
  EXPECT_NEAR(
      slides("mass = 2; inertia = 0.02, 0.02, 0.02, 0, 0, 0; material = steel; For x in "
             "-0.1, 0.1 { For y in -0.1, 0.1 { ContactPoint { location = x, y, -0.05; } } }"),
      expected, 0.01 * expected);
}

/// One of two Materials, foot 0 and ground 1.
simulation::Experiment with_contacts(std::optional<contact::MujocoContact> foot,
                                     std::optional<contact::MujocoContact> ground) {
  simulation::Experiment experiment;
  experiment.materials = {{"foot", {}, {}, {}, foot}, {"ground", {}, {}, {}, ground}};
  return experiment;
}

// XML reference, geom, solmix: means, and the lesser of direct references; ours: one side alone counts.
TEST(MujocoMaterials, OfTwoSidesBothOrTheOneThatStates) {
  const contact::MujocoContact a{{{0.02, 1.}, {0.9, 0.95, 1e-3, 0.5, 2.}}, {}};
  const contact::MujocoContact b{{{0.04, 0.5}, {0.8, 0.85, 3e-3, 0.5, 2.}}, {}};
  EXPECT_EQ(reference::mujoco_row_of(with_contacts(a, {}), 0, 1), a.row);
  EXPECT_EQ(reference::mujoco_row_of(with_contacts({}, b), 0, 1), b.row);
  EXPECT_EQ(reference::mujoco_row_of(with_contacts({}, {}), 0, 1), contact::MujocoRow{});
  EXPECT_DOUBLE_EQ(reference::mujoco_row_of(with_contacts(a, b), 0, 1).reference[0], 0.03);
  simulation::Experiment paired = with_contacts(a, b);
  paired.pairs.push_back({1, 0, 1});
  EXPECT_EQ(reference::mujoco_row_of(paired, 0, 1), b.row);
}

TEST(MujocoMaterials, ConesAndRatiosOfAWorldAreOne) {
  const contact::MujocoContact cone{{}, {true, 10.}}, pyramid{{}, {false, 1.}};
  EXPECT_EQ(reference::mujoco_friction_of(with_contacts({}, cone)), cone.friction);
  try {
    reference::mujoco_friction_of(with_contacts(cone, pyramid));
    ADD_FAILURE();
  } catch (const simulation::ExperimentError& error) {
    EXPECT_NE(std::string(error.what()).find("foot and ground state different ones"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace hookpoint
