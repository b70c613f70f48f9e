// Predictions against numbers worked out by hand from docs/contact.md.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

using simulation::Experiment;

constexpr double degree = 3.14159265358979323846 / 180.;

/// 1 kg, 0.2 x 0.2 x 0.1 m, k = k_t = 1e5 N/m, on a slope or, single, a point.
Experiment body(double slope, double mu, const std::string& law, bool point = false) {
  Experiment experiment;
  experiment.contact = law;
  experiment.materials.resize(1);
  auto& constants = experiment.materials[0].constants;
  constants.static_friction = constants.kinetic_friction = mu;
  constants.rebound_speed = 2e-3;
  constants.regularisation_speed = 1e-3;
  simulation::TerrainSpec terrain;
  terrain.surface = contact::SlopeSurface{slope * degree, 0.};
  experiment.terrain = terrain;
  simulation::RobotSpec robot;
  robot.mobile = true;
  robot.base.mass.mass = 1.;
  robot.orientation = exponential(Vector3d{0., slope * degree, 0.});
  if (point) {
    robot.base.boundary_points = {{}};
  } else {
    for (const double x : {-0.1, 0.1})
      for (const double y : {-0.1, 0.1})
        for (const double z : {-0.05, 0.05}) robot.base.boundary_points.push_back({x, y, z});
  }
  experiment.robots.push_back(robot);
  return experiment;
}

std::optional<double> prediction(const Experiment& experiment, std::string_view metric,
                                 std::optional<double> peer_creep = std::nullopt) {
  return predict(metric, make_context(experiment, 5., 20.), {peer_creep, {}});
}

TEST(CreepPrediction, HooksHold) {
  EXPECT_EQ(prediction(body(20., 0.8, "hookpoint"), "creep_speed"), 0.);
}

TEST(CreepPrediction, RegularisedFrictionCreepsAtTheSpeedThatCarriesTheLoad) {
  // phi(s) = s/sqrt(1 + s^2) = tan 20 deg/0.8 = 0.454963: s = 0.510911.
  EXPECT_NEAR(*prediction(body(20., 0.8, "hunt_crossley"), "creep_speed"), 0.510911e-3, 1e-8);
}

TEST(CreepPrediction, AMicrocollidingPointCreepsAtReboundSpeedTimesTangent) {
  EXPECT_NEAR(*prediction(body(15., 0.5, "impulse", true), "creep_speed"), 2e-3 * 0.2679491924,
              1e-12);
  EXPECT_NEAR(*prediction(body(15., 0.9, "impulse", true), "creep_speed"), 2e-3 * 0.2679491924,
              1e-12);
  EXPECT_FALSE(prediction(body(15., 0.5, "impulse"), "creep_speed"));
  EXPECT_EQ(prediction(body(15., 0.5, "impulse_reversal", true), "creep_speed"), 0.);
}

// Below the cone what the peer's own closed form says, above it Coulomb's slide as for all.
TEST(CreepPrediction, APeersIsItsOwnWhereFrictionHolds) {
  Experiment experiment = body(15., 0.5, "hookpoint");
  experiment.engine = "ode";
  EXPECT_EQ(prediction(experiment, "creep_speed", 6e-11), 6e-11);
  EXPECT_FALSE(prediction(experiment, "creep_speed"));
  experiment = body(30., 0.2, "hookpoint");
  experiment.engine = "ode";
  EXPECT_NEAR(*prediction(experiment, "creep_speed", 6e-11), 12.5 * 3.2058582, 1e-5);
}

// Friction that knows no direction holds or pulls along the fall; a peer's closed form may go
// aside.
TEST(CreepPrediction, GoesAsideOnlyWhereAPeersFormSaysSo) {
  EXPECT_EQ(prediction(body(20., 0.8, "hookpoint"), "creep_sideways"), 0.);
  EXPECT_EQ(prediction(body(20., 0.8, "hunt_crossley"), "creep_sideways"), 0.);
  EXPECT_EQ(prediction(body(30., 0.2, "hookpoint"), "creep_sideways"), 0.);
  Experiment peer = body(15., 0.5, "hookpoint");
  peer.engine = "mujoco";
  const RunContext context = make_context(peer, 5., 20.);
  PeerContact contact;
  EXPECT_FALSE(predict("creep_sideways", context, contact));
  contact.creep = 6e-11;
  contact.creep_sideways = -2e-11;
  EXPECT_EQ(predict("creep_sideways", context, contact), -2e-11);
}

TEST(CreepPrediction, AboveTheConeTheLineThroughTheParabola) {
  // a = 9.81 (sin 30 - 0.2 cos 30) = 3.205858 m/s^2; over 5..20 s the best line has slope 12.5 a.
  EXPECT_NEAR(*prediction(body(30., 0.2, "hookpoint"), "creep_speed"), 12.5 * 3.2058582, 1e-5);
  EXPECT_NEAR(*prediction(body(30., 0.2, "hookpoint"), "slip_acceleration"), 3.2058582, 1e-6);
  EXPECT_EQ(prediction(body(30., 0.2, "hookpoint"), "direction_error"), 0.);
}

TEST(PenetrationPrediction, MeanIsTheSharedWeightAndMaxTheDownhillEdge) {
  // m g cos/(4 k) = 2.3045e-5; the friction m g sin at 0.05 m tilts: +- m g sin h/(4 k * 0.1) = 0.5
  // * 8.3880e-6.
  const Experiment experiment = body(20., 0.8, "hookpoint");
  EXPECT_NEAR(*prediction(experiment, "penetration_mean"), 2.304599e-5, 1e-10);
  EXPECT_NEAR(*prediction(experiment, "penetration_max"), 2.304599e-5 + 0.419403e-5, 1e-10);
  EXPECT_NEAR(*prediction(experiment, "penetration_rms"), std::hypot(2.304599e-5, 0.419403e-5),
              1e-10);
}

TEST(PenetrationPrediction, OfAPeerIsItsSoftnessOnTheLevel) {
  Experiment experiment = body(0., 0.8, "hookpoint");
  experiment.engine = "ode";
  const auto depth = [&] {
    return predict("penetration_mean", make_context(experiment, 5., 20.), {{}, 1e-4});
  };
  EXPECT_NEAR(*depth(), 2.4525e-4, 1e-12);
  EXPECT_FALSE(prediction(experiment, "penetration_mean"));
  experiment = body(20., 0.8, "hookpoint");
  experiment.engine = "ode";
  EXPECT_FALSE(depth());
}

/// 3 kg more on a joint over the block, its centre of mass `aside` of the block's.
Experiment loaded(double aside, simulation::JointKind joint = simulation::JointKind::revolute) {
  Experiment experiment = body(0., 0.8, "hookpoint");
  simulation::LinkSpec link;
  link.joint = joint;
  link.body.mass.mass = 3.;
  link.body.mass.center_of_mass = {aside, 0., 0.2};
  experiment.robots[0].chains.resize(1);
  experiment.robots[0].chains[0].hip_distance = {0., 0., 0.05};
  experiment.robots[0].chains[0].links = {link};
  return experiment;
}

TEST(PenetrationPrediction, ARobotWhoseJointsBearNothingStandsAsOneBody) {
  // 4 kg on 4 x 1e5 N/m; 3 kg at 20 mm tilt it by 3 g 0.02/(4 k 0.1^2) = 1.4715e-4 rad over 0.1 m.
  EXPECT_NEAR(*prediction(loaded(0.), "penetration_mean"), 9.81e-5, 1e-12);
  EXPECT_NEAR(*prediction(loaded(0.02), "penetration_max"), 9.81e-5 + 1.4715e-5, 1e-12);
  EXPECT_FALSE(prediction(loaded(0., simulation::JointKind::prismatic), "penetration_mean"));
  Experiment fallen = loaded(0.02);  // the axis lies level: gravity turns the joint
  fallen.robots[0].chains[0].links[0].alpha = 90. * degree;
  fallen.robots[0].chains[0].links[0].body.mass.center_of_mass = {0.02, 0., 0.};
  EXPECT_FALSE(prediction(fallen, "penetration_mean"));
  EXPECT_FALSE(prediction(loaded(0.), "creep_speed")) << "its joints may move when it slips";
}

TEST(PenetrationPrediction, GreatestOfAFallIsWhereSpringAndDamperStopIt) {
  Experiment experiment = body(0., 0.8, "hookpoint");
  auto& constants = experiment.materials[0].constants;
  constants.normal_damping = 0.;
  const auto greatest = [&](double height) {
    experiment.robots[0].location.z = 0.05 + height;
    return predict("penetration_max", make_context(experiment, 0., 1.));
  };
  const double rest = 9.81 / 4e5;
  EXPECT_NEAR(*greatest(0.), 2. * rest, 1e-12);
  // Energy: m g (h + d) = 4 k d^2/2.
  EXPECT_NEAR(*greatest(0.05), rest + std::sqrt(rest * rest + 2. * rest * 0.05), 1e-12);
  // Set down, a damping ratio of 0.5 overshoots by exp(-pi/sqrt 3).
  constants.normal_damping = std::sqrt(4e5) / 4.;
  EXPECT_NEAR(*greatest(0.), rest * 1.1630335, 1e-11);
  constants.normal_damping *= 4.;
  EXPECT_FALSE(greatest(0.)) << "it creeps down";
}

TEST(PenetrationPrediction, HuntCrossleyOnlyForAPoint) {
  // (N/k)^(2/3), N = 9.81 cos 20 deg = 9.218385 N.
  EXPECT_NEAR(*prediction(body(20., 0.8, "hunt_crossley", true), "penetration_max"),
              std::pow(9.218385e-5, 2. / 3.), 1e-9);
  EXPECT_FALSE(prediction(body(20., 0.8, "hunt_crossley"), "penetration_max"));
}

TEST(StickPrediction, IsTheStretchOfTheHooks) {
  EXPECT_NEAR(*prediction(body(20., 0.8, "hookpoint"), "stick_displacement"), 8.388044e-6, 1e-11);
  EXPECT_FALSE(prediction(body(20., 0.2, "hookpoint"), "stick_displacement"));
  EXPECT_FALSE(prediction(body(20., 0.8, "hunt_crossley"), "stick_displacement"));
}

TEST(ImpactPrediction, FlightsOfTheReboundSpeed) {
  // g cos/(2 u0) = 9.81 cos 15 deg/0.004.
  EXPECT_NEAR(*prediction(body(15., 0.5, "impulse", true), "impacts"), 2368.933, 1e-2);
  EXPECT_FALSE(prediction(body(15., 0.5, "hookpoint", true), "impacts"));
}

TEST(StoppingPrediction, CoulombLessTheElasticOffset) {
  Experiment experiment = body(0., 0.5, "hookpoint");
  experiment.robots[0].velocity = {2., 0., 0.};
  // v0^2/(2 mu g) = 0.40774720; e0 = mu m g/(4 k_t) = 1.22625e-5.
  EXPECT_NEAR(*prediction(experiment, "stopping_distance"), 0.407747197 - 1.22625e-5, 1e-8);
  experiment.materials[0].constants.tangential_damping = 0.;
  EXPECT_NEAR(*prediction(experiment, "stopping_distance"), 0.407747197 - 0.613125e-5, 1e-8);
  EXPECT_FALSE(prediction(body(10., 0.5, "hookpoint"), "stopping_distance"));
}

TEST(Regime, IsDecidedByTheConeNotByTheEngine) {
  const auto regime = [](const Experiment& experiment) {
    return regime_of(make_context(experiment, 5., 20.));
  };
  // tan 11 deg = 0.1944, tan 12 deg = 0.2126.
  for (const char* law : {"hookpoint", "hunt_crossley", "impulse"}) {
    EXPECT_EQ(regime(body(11., 0.2, law)), Regime::holds);
    EXPECT_EQ(regime(body(12., 0.2, law)), Regime::slides);
  }
  Experiment thrown = body(0., 0.5, "hookpoint");
  thrown.robots[0].velocity = {1., 0., 0.};
  EXPECT_EQ(regime(thrown), Regime::none);
  Experiment pair = body(11., 0.2, "hookpoint");
  pair.robots.push_back(pair.robots[0]);
  EXPECT_EQ(regime(pair), Regime::none);
}

TEST(Predictions, AreSilentWhereNoClosedFormHolds) {
  Experiment pushed = body(20., 0.8, "hookpoint");
  pushed.forces.resize(1);
  EXPECT_FALSE(prediction(pushed, "creep_speed"));
  EXPECT_FALSE(prediction(body(20., 0.8, "hookpoint"), "slip_distance"));
}

/// A leg whose joints follow as q' = K (goal - q), K = 20 1/s, seen every `period` and `samples`
/// periods late.
Experiment late_joints(double period, double samples) {
  Experiment experiment;
  experiment.deltat = 1e-4;
  simulation::RobotSpec robot;
  robot.mobile = true;
  robot.base.mass.mass = 1.;
  robot.chains.resize(1);
  robot.chains[0].links.resize(3);
  for (auto& link : robot.chains[0].links) link.damping = 0.5;
  experiment.robots.push_back(robot);
  simulation::ComponentSpec pd;
  pd.trail = "pd";
  pd.type = "Controller.JointPD";
  pd.rate = 1. / period;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    pd.values.emplace_back(joint, 10.);     // pconstant, the first of the class's parameters
    pd.values.emplace_back(3 + joint, 0.);  // dconstant
  }
  experiment.components.push_back(pd);
  experiment.wires.push_back({"leg.coxa.angle", "pd.angle[0]", {}, samples * period, 0.});
  experiment.wires.push_back({"pd.torque[0]", "leg.coxa.torque", {}, 0., 0.});
  return experiment;
}

TEST(ThresholdPrediction, IsCoulombsAngleWhereALawHolds) {
  for (const std::string law : {"hookpoint", "lugre", "exponential", "nominal"})
    EXPECT_NEAR(*prediction(body(0., 0.8, law, true), "slip_onset"), 0.674740942223553, 1e-14);
  EXPECT_EQ(prediction(body(0., 0.8, "hookpoint", true), "threshold_error"), 0.);
  Experiment peer = body(0., 0.8, "hookpoint", true);
  peer.engine = "bullet";
  EXPECT_NEAR(*prediction(peer, "slip_onset"), 0.674740942223553, 1e-14);
}

TEST(ThresholdPrediction, RegularisedFrictionGivesWayBefore) {
  // phi(1 mm/s/v_s) mu = 0.8/sqrt(2) with v_s = 1 mm/s.
  EXPECT_NEAR(*prediction(body(0., 0.8, "hunt_crossley", true), "slip_onset"),
              std::atan(0.8 / std::sqrt(2.)), 1e-9);
  EXPECT_NEAR(*prediction(body(0., 0.8, "hunt_crossley", true), "threshold_error"),
              std::atan(0.8 / std::sqrt(2.)) - std::atan(0.8), 1e-9);
}

TEST(ThresholdPrediction, SaysNothingOfHopsAsFastAsSlip) {
  Experiment hopping = body(0., 0.8, "impulse", true);
  EXPECT_FALSE(prediction(hopping, "slip_onset"));  // 2 u0 mu = 3.2 mm/s
  hopping.materials[0].constants.rebound_speed = 0.5e-3;
  EXPECT_TRUE(prediction(hopping, "slip_onset"));
}

TEST(RestlessPrediction, IsWhetherTheStepIsAboveTheBound) {
  // A point on k = 1e5 N/m, c = 300 N s/m, m = 1 kg: explicit Euler is stable up to c/k = 3 ms.
  Experiment point = body(0., 0.8, "hookpoint", true);
  point.engine = "dts";
  point.integrator = "explicit_euler";
  point.gravity = {0., 0., -9.81};
  point.robots[0].location = {0., 0., -1e-5};
  point.robots[0].base.mass.inertia = {1., 1., 1., 0., 0., 0.};
  point.deltat = 2.99e-3;
  EXPECT_EQ(prediction(point, "restless"), 0.);
  point.deltat = 3.01e-3;
  EXPECT_EQ(prediction(point, "restless"), 1.);
  point.integrator = "arkode";
  EXPECT_FALSE(prediction(point, "restless"));
}

TEST(JointLoopPrediction, IsTheLimitOfDelayedIntegration) {
  // K T is bounded by 2, 1, 0.618034, 0.284630 for 0, 1, 2, 5 samples of delay.
  for (const auto& [samples, bound] :
       {std::pair{0., 2.}, {1., 1.}, {2., 0.618034}, {5., 0.284630}}) {
    EXPECT_EQ(prediction(late_joints(0.999 * bound / 20., samples), "fell"), 0.) << samples;
    EXPECT_EQ(prediction(late_joints(1.001 * bound / 20., samples), "fell"), 1.) << samples;
  }
  // A part of a sample waits for the next update.
  EXPECT_EQ(prediction(late_joints(0.999 * 0.618034 / 20., 1.2), "fell"), 0.);
  EXPECT_EQ(prediction(late_joints(1.001 * 0.618034 / 20., 1.2), "fell"), 1.);
}

TEST(JointLoopPrediction, SaysNothingOfOtherLoops) {
  Experiment damped = late_joints(0.01, 2.);
  damped.components[0].values.emplace_back(3, 0.1);
  EXPECT_FALSE(prediction(damped, "fell"));
  Experiment light = late_joints(0.01, 2.);
  light.robots[0].chains[0].links[1].damping = 0.;
  EXPECT_FALSE(prediction(light, "fell"));
  Experiment late = late_joints(0.01, 2.);
  late.wires[1].delay = 0.01;
  EXPECT_FALSE(prediction(late, "fell"));
  EXPECT_FALSE(prediction(body(20., 0.8, "hookpoint"), "fell"));
}

Experiment ball(double slope, double mu) {
  Experiment experiment = body(slope, mu, "hookpoint", true);
  experiment.robots[0].base.boundary_radii = {0.05};
  return experiment;
}

TEST(BallPrediction, RollsAtFiveSeventhsUpToItsThresholdAndSkidsAbove) {
  // 2/7 tan 20 deg = 0.10399 is what friction must be.
  EXPECT_NEAR(*prediction(ball(20., 0.1041), "slip_acceleration"), 2.396584, 1e-6);
  EXPECT_NEAR(*prediction(ball(20., 0.1038), "slip_acceleration"),
              9.81 * (0.3420201 - 0.1038 * 0.9396926), 1e-6);
}

TEST(BallPrediction, ReboundsByWhatItsEngineKnows) {
  Experiment experiment = ball(0., 0.5);
  experiment.gravity = {};
  experiment.robots[0].velocity = {0., 0., -1.};
  auto& constants = experiment.materials[0].constants;
  constants.restitution = 0.7;
  constants.normal_stiffness = 1e4;
  constants.normal_damping = 100.;  // zeta = 0.5: e = exp(-2 pi/(3 sqrt 3)) = 0.298436
  EXPECT_NEAR(*prediction(experiment, "rebound"), 0.298436, 1e-6);
  experiment.contact = "impulse";
  EXPECT_EQ(prediction(experiment, "rebound"), 0.7);
  experiment.engine = "ode";
  EXPECT_EQ(prediction(experiment, "rebound"), 0.7);
  experiment.settings = "matched";
  EXPECT_NEAR(*prediction(experiment, "rebound"), 0.298436, 1e-6);
  experiment.gravity = {0., 0., -9.81};
  EXPECT_FALSE(prediction(experiment, "rebound"));
}

TEST(SupportPrediction, IsTheWeightAlongTheNormal) {
  EXPECT_NEAR(*prediction(body(60., 2., "hookpoint"), "support_force"), 9.81 / 2., 1e-12);
}

TEST(RigidSlide, BrakesUntilItRests) {
  Experiment experiment = body(0., 0.5, "hookpoint");
  experiment.robots[0].velocity = {1., 0., 0.};
  const auto slide = rigid_slide(make_context(experiment, 0., 1.));
  ASSERT_TRUE(slide.has_value());
  EXPECT_NEAR(slide->displacement(0.1), 0.1 - 0.5 * 4.905 * 0.01, 1e-12);
  EXPECT_NEAR(slide->displacement(9.), 1. / (2. * 4.905), 1e-12);
}

}  // namespace
}  // namespace hookpoint::studies
