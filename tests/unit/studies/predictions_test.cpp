// Predictions against numbers worked out by hand from docs/contact.md.
#include "studies/predictions/predictions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

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
  PeerContact peer;
  if (peer_creep) peer.creep = simulation::CreepVelocity{*peer_creep, 0.};
  return predict(metric, make_context(experiment, 5., 20.), peer).value();
}

/// Why there is none.
std::string why_none(const Experiment& experiment, std::string_view metric) {
  return predict(metric, make_context(experiment, 5., 20.)).why();
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
  contact.creep = simulation::CreepVelocity{6e-11, -2e-11};
  EXPECT_EQ(*predict("creep_sideways", context, contact), -2e-11);
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
    PeerContact soft;
    soft.softness = 1e-4;
    return predict("penetration_mean", make_context(experiment, 5., 20.), soft);
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
    // The class's parameters: legs, pconstant, dconstant.
    pd.values.emplace_back(1 + joint, 10.);
    pd.values.emplace_back(4 + joint, 0.);
  }
  experiment.components.push_back(pd);
  experiment.wires.push_back({"leg.coxa.angle", "pd.angle[0]", {}, samples * period, 0.});
  experiment.wires.push_back({"pd.torque[0]", "leg.coxa.torque", {}, 0., 0.});
  return experiment;
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
  damped.components[0].values.emplace_back(4, 0.1);
  EXPECT_FALSE(prediction(damped, "fell"));
  Experiment light = late_joints(0.01, 2.);
  light.robots[0].chains[0].links[1].damping = 0.;
  EXPECT_FALSE(prediction(light, "fell"));
  Experiment late = late_joints(0.01, 2.);
  late.wires[1].delay = 0.01;
  EXPECT_FALSE(prediction(late, "fell"));
  EXPECT_FALSE(prediction(body(20., 0.8, "hookpoint"), "fell"));
}

/// A full ball of 1 kg and 50 mm: 2/5 m r^2 = 1e-3 kg m^2.
Experiment ball(double slope, double mu) {
  Experiment experiment = body(slope, mu, "hookpoint", true);
  experiment.robots[0].base.boundary_radii = {0.05};
  experiment.robots[0].base.mass.inertia = {1e-3, 1e-3, 1e-3, 0., 0., 0.};
  return experiment;
}

TEST(BallPrediction, RollsAtFiveSeventhsUpToItsThresholdAndSkidsAbove) {
  // 2/7 tan 20 deg = 0.10399 is what friction must be.
  EXPECT_NEAR(*prediction(ball(20., 0.1041), "slip_acceleration"), 2.396584, 1e-6);
  EXPECT_NEAR(*prediction(ball(20., 0.1038), "slip_acceleration"),
              9.81 * (0.3420201 - 0.1038 * 0.9396926), 1e-6);
}

TEST(BallPrediction, RollsByItsOwnInertiaAndTheFrictionOfItsEngine) {
  // A hollow ball, 2/3 m r^2: 3/5 g sin 20 deg.
  Experiment hollow = ball(20., 0.5);
  hollow.robots[0].base.mass.inertia = {1. / 600., 1. / 600., 1. / 600., 0., 0., 0.};
  EXPECT_NEAR(*prediction(hollow, "slip_acceleration"), 2.013130, 1e-6);
  Experiment aside = ball(20., 0.5);
  aside.robots[0].base.mass.center_of_mass = {0.01, 0., 0.};
  EXPECT_EQ(why_none(aside, "slip_acceleration"), "the ball's centre of mass is not at its centre");
  // Kinetic friction of 0.05 does not carry 2/7 of the pull; static friction of 0.5 does.
  Experiment skids = ball(20., 0.5);
  skids.materials[0].constants.kinetic_friction = 0.05;
  RunContext context = make_context(skids, 5., 20.);
  EXPECT_NEAR(*predict("slip_acceleration", context), 2.396584, 1e-6);
  context.one_friction = true;
  EXPECT_NEAR(*predict("slip_acceleration", context), 9.81 * (0.3420201 - 0.05 * 0.9396926), 1e-6);
}

/// The block on balls of `radii` about its lower corners, whose centres are so much higher.
Experiment on_balls(double slope, const std::vector<double>& radii, bool in_line = false) {
  Experiment experiment = body(slope, 0.8, "hookpoint");
  simulation::BodySpec& base = experiment.robots[0].base;
  base.boundary_points.clear();
  const Vector3d corners[] = {
      {0.1, 0.1, -0.05}, {-0.1, 0.1, -0.05}, {0.1, -0.1, -0.05}, {-0.1, -0.1, -0.05}};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    Vector3d corner = corners[i];
    if (in_line) corner.y = 0.;
    base.boundary_points.push_back(corner + Vector3d{0., 0., radii[i]});
  }
  base.boundary_radii = radii;
  return experiment;
}

TEST(BallFeet, ThreeThatAreNotInALineCannotRoll) {
  for (const std::vector<double>& radii :
       {std::vector{0.01, 0.01, 0.01, 0.01}, {0., 0., 0., 1e-3}, {0.02, 1e-3, 0., 0.}}) {
    EXPECT_EQ(prediction(on_balls(20., radii), "creep_speed"), 0.);
    EXPECT_NEAR(*prediction(on_balls(20., radii), "penetration_max"), 2.304599e-5 + 0.419403e-5,
                1e-10);
    EXPECT_NEAR(*prediction(on_balls(20., radii), "stick_displacement"), 8.388044e-6, 1e-11);
    EXPECT_NEAR(*prediction(on_balls(40., radii), "slip_acceleration"),
                9.81 * (0.6427876 - 0.8 * 0.7660444), 1e-5);
  }
}

TEST(BallFeet, RollAboutALineAndAreSaidTo) {
  for (const std::vector<double>& radii : {std::vector{0.01, 0.01}, {0.02, 0.}})
    EXPECT_EQ(why_none(on_balls(20., radii), "creep_speed"),
              "the body rolls: a boundary point is a ball, and all contacts lie on one line");
  EXPECT_NE(why_none(on_balls(20., {0.01, 0.02, 0.01, 0.01}, true), "creep_speed").find("rolls"),
            std::string::npos);
  Experiment single = ball(20., 0.5);
  simulation::PointSpec named;
  named.trail = "world.r.base.d";
  single.points.push_back(named);
  EXPECT_EQ(why_none(single, "creep_speed"), "the body rolls: contact point d is a ball");
  EXPECT_NEAR(*prediction(ball(0., 0.5), "penetration_mean"), 9.81e-5, 1e-12)
      << "on the level it rests";
}

// A foot a millimetre longer than the others, which the body comes to stand on with two of them.
TEST(BallFeet, ThatAreNotLevelCarryWithThoseBesideThem) {
  Experiment experiment = on_balls(20., {0., 0., 0., 1e-3});
  simulation::BodySpec& base = experiment.robots[0].base;
  base.boundary_points[3].z -= 1e-3;
  EXPECT_EQ(prediction(experiment, "creep_speed"), 0.);
  EXPECT_EQ(why_none(experiment, "penetration_mean"),
            "the contacts are not level: how they share the load is unknown");
  EXPECT_NEAR(*prediction(body(40., 0.8, "hookpoint"), "slip_acceleration"),
              9.81 * (0.6427876 - 0.8 * 0.7660444), 1e-5);
  base.boundary_points.resize(2);
  base.boundary_radii = {0., 1e-3};  // two feet, whatever their heights: it rolls about their line
  EXPECT_NE(why_none(experiment, "creep_speed").find("rolls"), std::string::npos);
}

TEST(Predictions, SayWhyThereIsNone) {
  Experiment pushed = body(20., 0.8, "hookpoint");
  pushed.forces.resize(1);
  pushed.forces[0].name = "pull";
  EXPECT_EQ(why_none(pushed, "creep_speed"), "the Force pull acts");
  Experiment fixed = body(20., 0.8, "hookpoint");
  fixed.robots[0].mobile = false;
  EXPECT_EQ(why_none(body(20., 0.8, "hookpoint"), "slip_distance"),
            "none is known of slip_distance");
  for (const char* metric :
       {"creep_speed", "creep_sideways", "slip_acceleration", "friction", "anisotropy",
        "stick_displacement", "stopping_distance", "impacts", "direction_error", "slip_onset",
        "threshold_error", "penetration_max", "penetration_mean", "penetration_rms", "rebound",
        "support_force", "restless", "fell"}) {
    EXPECT_NE(find_metric(metric)->predict, nullptr) << metric;
    // Whatever the scene, a number or a reason.
    for (const Experiment& experiment :
         {body(20., 0.8, "hookpoint"), body(0., 0.8, "lugre"), body(20., 0.2, "hunt_crossley"),
          body(10., 0.5, "impulse"), ball(10., 0.3), pushed}) {
      const Prediction said = predict(metric, make_context(experiment, 5., 20.));
      EXPECT_NE(said.value().has_value(), !said.why().empty()) << metric;
    }
  }
}

TEST(OneCoefficient, IsTheKineticOneInEveryClosedForm) {
  Experiment peer = body(20., 0.8, "hookpoint");  // tan 20 deg = 0.364
  peer.engine = "ode";
  peer.materials[0].constants.kinetic_friction = 0.2;
  RunContext context = make_context(peer, 5., 20.);
  EXPECT_EQ(regime_of(context), Regime::holds) << "of an engine with two";
  context.one_friction = true;
  EXPECT_EQ(regime_of(context), Regime::slides);
  const double a = 9.81 * (0.3420201 - 0.2 * 0.9396926);
  EXPECT_NEAR(*predict("slip_acceleration", context), a, 1e-6);
  EXPECT_NEAR(*predict("creep_speed", context), 12.5 * a, 1e-5);
  EXPECT_EQ(*predict("friction", context), 0.2);
}

// Between mu_k and mu_s a point that breaks away at the start takes the body with it.
TEST(FallingFriction, IsNotSaidToHoldWhereTheStartMayBreakIt) {
  Experiment experiment = body(20., 0.4, "hookpoint");  // tan 20 deg = 0.364, of mu_s 0.91
  experiment.materials[0].constants.kinetic_friction = 0.2;
  for (const char* metric : {"creep_speed", "slip_acceleration", "friction"})
    EXPECT_NE(why_none(experiment, metric).find("between kinetic and static"), std::string::npos)
        << metric;
  experiment.materials[0].constants.static_friction = 1.5;
  EXPECT_EQ(prediction(experiment, "creep_speed"), 0.) << "twice the pull is within the cone";
}

TEST(StickPrediction, NeedsAStartThatStaysWithinTheCone) {
  // tan 20 deg over 0.38 is 0.96: a swing past the rest by 15 % or more slips.
  EXPECT_NE(why_none(body(20., 0.38, "hookpoint"), "stick_displacement").find("swings"),
            std::string::npos);
}

TEST(RestlessPrediction, SaysNothingOfWhatSomethingElseMoves) {
  Experiment sliding = body(30., 0.2, "hookpoint");
  sliding.deltat = 1e-5;
  sliding.engine = "dts";
  sliding.integrator = "explicit_euler";
  sliding.robots[0].base.mass.inertia = {1., 1., 1., 0., 0., 0.};
  EXPECT_EQ(why_none(sliding, "restless"), "the body slides");
}

TEST(SupportPrediction, WaitsForALanding) {
  Experiment dropped = body(0., 0.5, "hookpoint");
  dropped.robots[0].location.z = 0.05 + 1.;  // falls for 0.45 s
  EXPECT_TRUE(predict("support_force", make_context(dropped, 0.5, 2.)));
  EXPECT_EQ(predict("support_force", make_context(dropped, 0.4, 2.)).why(),
            "the robot is in the air at `settle`");
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
