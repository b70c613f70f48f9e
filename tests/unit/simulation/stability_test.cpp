// The largest stable step against closed forms, what is said about controllers, and the watch over
// energy.
#include "simulation/analysis/stability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "reference/bullet/engine.h"
#include "reference/engines.h"
#include "reference/ode/engine.h"
#include "simulation/analysis/convex_hull.h"
#include "simulation/analysis/unstable_stretches.h"
#include "simulation/run/energy_watch.h"
#include "tests/support/malloc_counter.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

simulation::StabilityBound bound_of(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return simulation::stability_bound(*loaded.experiment);
}

/// Of m x'' + c x' + k x = 0 under semi-implicit Euler.
double semi_implicit(double k, double c, double m) {
  return (std::sqrt(c * c + 4. * k * m) - c) / k;
}

std::string dropped_box(const std::string& place) {
  return "World w { Material m { normal_stiffness = 20 kN/m; normal_damping = 40; "
         "tangential_stiffness = 20 kN/m; tangential_damping = 40; } Terrain.Flat f { material = "
         "m; "
         "} Robot b { Base.mobile { " +
         place + " Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1; } } } }";
}

TEST(StabilityBound, OfABoxHasItsFourCornersWhereverItStartsAboveTheGround) {
  const double resting = bound_of(dropped_box("rest_on = f;")).step;
  for (const char* height : {"0.05", "0.1", "0.6"})
    EXPECT_NEAR(bound_of(dropped_box(fmt::format("location = 0, 0, {};", height))).step, resting,
                1e-3 * resting)
        << height;
}

// Those of a pair with the least effective mass, which the lightest two are where shapes are alike.
TEST(StabilityBound, OfBodiesThatMeetIsThatOfTheLightestPairInAnyOrder) {
  const auto bound_of_boxes = [](const std::vector<double>& masses) {
    std::string robots;
    for (std::size_t i = 0; i < masses.size(); ++i)
      robots += fmt::format(
          "Robot b{} {{ Base.mobile {{ location = {}, 0, 0; Shape.Box {{ dimensions = 0.1, 0.1, 0.1; "
          "mass = {}; }} }} }} ",
          i, i, masses[i]);
    return bound_of("World w { touch = shapes; gravity = 0; " + robots + "}").step;
  };
  const double lightest = bound_of_boxes({0.1, 0.2});
  EXPECT_LT(lightest, 0.9 * bound_of_boxes({0.1, 1.}));
  std::vector<double> masses{0.1, 0.2, 1., 5.};
  do {
    EXPECT_NEAR(bound_of_boxes(masses), lightest, 1e-9 * lightest);
  } while (std::ranges::next_permutation(masses).found);
}

// A slide of 2 kg over the base that carries it, with a link between that joins no shape to either: along
// the parallel axes of both joints a force moves the tip alone, k = 1e5 N/m.
TEST(StabilityBound, OfALinkThatMeetsItsOwnFixedBaseIsThatOfItsMass) {
  const simulation::StabilityBound bound = bound_of(
      "World w { gravity = 0; Material m { normal_stiffness = 1e5; normal_damping = 0; "
      "tangential_stiffness = 1e5; tangential_damping = 0; } Robot r { self_contact = true; Base.fixed "
      "{ material = m; Shape.Sphere { radius = 0.02; } } Chain c { Link a { joint = prismatic; mass = "
      "5; } Link b { joint = prismatic; angle = 0.3; mass = 2; material = m; Shape.Sphere { radius = "
      "0.02; } } } } }");
  EXPECT_EQ(bound.contacts, simulation::StabilityBound::Contacts::meeting);
  // Both sides state 1e5 N/m: in series half of it.
  EXPECT_NEAR(bound.step, semi_implicit(0.5e5, 0., 2.), 1e-9);
}

/// A slide of 2 kg on `base`, with a Loop's spring to it.
std::string sprung(const std::string& base, const std::string& loop) {
  return "World w { gravity = 0; Robot m { " + base +
         " Chain b { Link slide { joint = prismatic; mass = 2; } } Loop sp { a = b.slide; b = base; " +
         loop + " } } }";
}

TEST(StabilityBound, OfALoopsSpringIsThatOfItsStiffnessAndDamping) {
  const std::string fixed = "Base.fixed;";
  EXPECT_NEAR(bound_of(sprung(fixed, "stiffness = 8e7;")).step, 2. * std::sqrt(2. / 8e7), 1e-9);
  EXPECT_NEAR(bound_of(sprung(fixed, "stiffness = 8e7; damping = 5e3;")).step,
              semi_implicit(8e7, 5e3, 2.), 1e-9);
  // Two masses m and M swing against each other with the mass m M/(m + M).
  const std::string free = "Base.mobile { mass = 6; inertia = 1, 1, 1, 0, 0, 0; }";
  EXPECT_NEAR(bound_of(sprung(free, "stiffness = 8e7;")).step, 2. * std::sqrt(1.5 / 8e7), 1e-9);
}

// A rod of l = 0.2 m from its pivot, its end pulled by k = 1e4 N/m to a place d = 0.5 m from the pivot. At
// an angle q between the two the spring holds k (l^2 + d^2 - 2 l d cos q)/2: its stiffness is k l d, of
// which its stretch has k l (d - l).
TEST(StabilityBound, OfALoopsSpringCountsItsStretch) {
  const simulation::StabilityBound bound = bound_of(
      "World w { gravity = 0; Robot m { Base.fixed; Chain c { Link rod { mass = 1; inertia = 0.01, "
      "0.01, 0.01, 0, 0, 0; } } Loop sp { a = c.rod; b = base; point_a = 0.2, 0, 0; point_b = 0.5, 0, "
      "0; stiffness = 1e4; } } }");
  EXPECT_NEAR(bound.step, 2. * std::sqrt(0.01 / (1e4 * 0.2 * 0.5)), 1e-9);
}

// Tilted by 10 deg from 10 cm: it trembled for ever at 1 ms, with a bound of 1.034 ms printed.
TEST(StabilityBound, OfTheDefaultBoxDroppedOnAnEdgeIsBelowTheDefaultStep) {
  const simulation::StabilityBound bound = bound_of(
      "World w { Terrain.Flat f { } Robot b { Base.mobile { location = 0, 0, 0.16; orientation = "
      "10 deg, 0, 0; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; } } } }");
  EXPECT_LT(bound.step, 0.5e-3);
  EXPECT_EQ(bound.contacts, simulation::StabilityBound::Contacts::landing);
}

/// A slide of 2 kg pressed on the ground below it with 100 N.
std::string ram(const std::string& law) {
  return "World w { contact = " + law +
         "; Material m { exponential_rate = 1150; exponential_force = 0.5; hysteresis_damping = "
         "0.3; exponent = 1.5; normal_stiffness = 1e6; normal_damping = 3000; tangential_stiffness "
         "= 1; tangential_damping = 0; static_friction = 0; } Terrain.Flat f { material = m; } "
         "Robot b { Base.fixed { location = 0, 0, 0.5; orientation = 180 deg, 0, 0; } Chain c { "
         "Link l { joint = prismatic; mass = 2; inertia = 1, 1, 1, 0, 0, 0; torque = 100; "
         "ContactPoint tip { location = 0, 0, 0.5; } } } } }";
}

TEST(StabilityBound, IsThatOfTheLoadWhichAJointPresses) {
  const double N = 100. + 2. * g;
  EXPECT_NEAR(bound_of(ram("exponential")).step, semi_implicit(1150. * N, 0.3 * N, 2.), 1e-8);
  const double depth = std::pow(N / 1e6, 2. / 3.);
  EXPECT_NEAR(bound_of(ram("hunt_crossley")).step,
              semi_implicit(1.5e6 * std::sqrt(depth), 0.3 * N, 2.), 1e-8);
  EXPECT_NEAR(bound_of(ram("azad_featherstone")).step,
              semi_implicit(1.5e6 * std::sqrt(depth), 3000. * std::sqrt(depth), 2.), 1e-8);
}

TEST(StabilityBound, OfAPressedPointIsThatOfAForceAndOfAPush) {
  const std::string point =
      "World w { contact = exponential; Material m { exponential_rate = 1150; exponential_force = "
      "0.5; hysteresis_damping = 0.3; tangential_stiffness = 1; tangential_damping = 0; } "
      "Terrain.Flat f { material = m; } Robot b { Base.mobile { rest_on = f; mass = 1; inertia = "
      "1, "
      "1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } } ";
  const auto pressed = [](double N) { return semi_implicit(1150. * N, 0.3 * N, 1.); };
  EXPECT_NEAR(bound_of(point + "}").step, pressed(g), 1e-6);
  EXPECT_NEAR(bound_of(point + "Force p { body = b.base; force = 0, 0, -50; } }").step,
              pressed(g + 50.), 1e-6);
  EXPECT_NEAR(
      bound_of(point + "Push p { body = b.base; force = 0, 0, -50; from = 1; to = 2; } }").step,
      pressed(g + 50.), 1e-6);
}

// A joint that is wired has not its Link's torque, whatever the wire comes from: it is held where
// it is, where the tip only touches. What other components the file has plays no part.
TEST(StabilityBound, OfAJointWiredToAnotherPortIsThatOfADrivenJoint) {
  const std::string wired =
      ram("exponential") + "Wire FROM w.b.c.l.total_torque TO w.b.c.l.torque; ";
  const double touching = semi_implicit(1150. * 0.5, 0.3 * 0.5, 2.);
  for (const char* other : {"", "Signal.Ramp unrelated { }"}) {
    const simulation::StabilityBound bound = bound_of(wired + other);
    EXPECT_NEAR(bound.step, touching, 1e-4 * touching) << other;
    ASSERT_EQ(bound.left_out.size(), 1u);
    EXPECT_EQ(bound.left_out[0],
              "w.b.c.l.torque: it follows w.b.c.l.total_torque by a wire alone, without a "
              "controller");
  }
}

// 9602 points, of which a face has 1681. A posture in which it cannot stay was tried to its end,
// and each equilibrium worked out each point's lever anew.
TEST(StabilityBound, OfATiltedBoxOfManyPointsLooksAtEachAFewTimes) {
  const Loaded loaded = load_text(
      "World w { Terrain.Flat f { } Robot b { Base.mobile { location = 0, 0, 0.16; orientation = "
      "10 deg, 20 deg, 0; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; boundary_points = 40; "
      "} } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const long before = testing::mallocs;
  const simulation::StabilityBound bound = simulation::stability_bound(*loaded.experiment);
  EXPECT_EQ(bound.contacts, simulation::StabilityBound::Contacts::landing);
  constexpr long points = 6 * 40 * 40 + 2;
  EXPECT_LT(bound.evaluations, 100 * points);
  EXPECT_LT(testing::mallocs - before, 25 * points);
}

/// A rod of 0.2 kg on a hinge, let go at `angle` [deg] from straight down.
std::string rod(const std::string& integrator, double angle) {
  return fmt::format(
      "World w {{ gravity = 0, 9.81, 0; deltat = 1 ms; integrator = {}; Robot b {{ Base.fixed {{ "
      "orientation = 0, 0, 90 deg; }} Chain c {{ Link l {{ angle = {} deg; mass = 0.2; "
      "center_of_mass = 0.25, 0, 0; "
      "inertia = 1e-3, 4e-3, 4e-3, 0, 0, 0; damping = 1e-4; }} }} }} }}",
      integrator, angle);
}

TEST(StabilityBound, HasThePendulumsOwnStiffnessWhereverItIsLetGo) {
  const double m = 0.2, l = 0.25, J = 4e-3 + m * l * l, k = m * g * l, c = 1e-4;
  for (const double angle : {0., 30., 90., 120.}) {
    EXPECT_NEAR(bound_of(rod("semi_implicit_euler", angle)).step, semi_implicit(k, c, J), 1e-6)
        << angle;
    EXPECT_NEAR(bound_of(rod("explicit_euler", angle)).step, c / k, 1e-9) << angle;
  }
}

// Undamped, and one mode a hundred thousand times as slow as the other: its eigenvalue is less
// exact, and what rounding adds to it is no growth.
TEST(StabilityBound, OfAnUndampedRobotTakesRoundingForNoGrowth) {
  for (const double k : {1e10, 3e10, 1e11, 3e11}) {
    const double bound =
        bound_of(
            fmt::format("World w {{ gravity = 0; integrator = rk4; Robot b {{ Base.fixed {{ }} "
                        "Chain c {{ Link l {{ joint = prismatic; stiffness = 2.5; mass = 1; "
                        "inertia = 1, 1, 1, 0, 0, 0; }} Link m {{ joint = prismatic; stiffness "
                        "= {}; mass = 1; inertia = 1, 1, 1, 0, 0, 0; }} }} }} }}",
                        k))
            .step;
    // Of two masses on one line, held together by k: w^2 = 2 k, but for 2.5/k of it.
    EXPECT_NEAR(bound * std::sqrt(2. * k), 2. * std::sqrt(2.), 1e-2) << k;
  }
}

TEST(HullFaces, OfAPrismAreItsSidesAndItsEnds) {
  std::vector<Vector3d> points;
  constexpr int sides = 12;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2. * M_PI * i / sides + 0.1;
    for (const double z : {-0.2, 0.2}) points.push_back({std::cos(angle), std::sin(angle), z});
  }
  const auto faces = simulation::hull_faces(points, 1e-9);
  EXPECT_EQ(faces.size(), sides + 2u);
  std::size_t ends = 0;
  for (const simulation::HullFace& face : faces) {
    EXPECT_NEAR(norm(face.normal), 1., 1e-12);
    ends += face.points.size() == sides;
    EXPECT_TRUE(face.points.size() == 4 || face.points.size() == sides);
    for (const Vector3d& p : points) EXPECT_LE(dot(p - points[face.points[0]], face.normal), 1e-9);
  }
  EXPECT_EQ(ends, 2u);
}

TEST(HullFaces, OfPointsWithoutVolumeAreTheirTwoSidesOrAllAtOnce) {
  const std::vector<Vector3d> square{{0., 0., 0.}, {1., 0., 0.}, {1., 1., 0.}, {0., 1., 0.}};
  EXPECT_EQ(simulation::hull_faces(square, 0.).size(), 2u);
  const auto line = simulation::hull_faces(std::vector{square[0], square[1]}, 0.);
  ASSERT_EQ(line.size(), 1u);
  EXPECT_EQ(line[0].points.size(), 2u);
  EXPECT_EQ(simulation::hull_faces(std::vector{square[0]}, 0.).size(), 1u);
}

std::string held_slide(const std::string& controller) {
  return "World w { gravity = 0; duration = 5 s; Robot b { Base.fixed { } Chain c { Link l { joint "
         "= "
         "prismatic; angle = 1; mass = 1; } } } } " +
         controller;
}

TEST(Stability, NamesAControllerWhoseGainIsTooHighForItsRate) {
  const std::string text = held_slide(
      "Controller.PD squat { rate = 250 Hz; pconstant = 10000; dconstant = 1000; rate_in = 0; Wire "
      "FROM w.b.c.l.angle TO current; Wire FROM w.b.c.l.rate TO rate_in; Wire TO w.b.c.l.torque; "
      "}");
  const simulation::StabilityBound bound = bound_of(text);
  EXPECT_EQ(bound.step, 0.);
  const std::string advice = simulation::controller_advice(bound);
  EXPECT_NE(advice.find("squat (at 250 Hz)"), std::string::npos) << advice;
  EXPECT_NE(advice.find("raise the rate"), std::string::npos) << advice;
  EXPECT_EQ(advice.find("step smaller"), std::string::npos) << advice;
  Running running(text);
  simulation::StepStatus status;
  while ((status = running.world().step()).ok()) {
  }
  EXPECT_NE(status.advice.find("squat (at 250 Hz)"), std::string::npos) << status.advice;
  EXPECT_EQ(status.advice.find("make the step smaller"), std::string::npos) << status.advice;
}

TEST(Stability, SaysPlainlyWhyFeedbackIsLeftOut) {
  const simulation::StabilityBound bound = bound_of(
      held_slide("Controller.PD squat { pconstant = 10; Wire FROM w.b.c.l.rate TO current; Wire TO "
                 "w.b.c.l.torque; }"));
  ASSERT_EQ(bound.left_out.size(), 1u);
  EXPECT_EQ(bound.left_out[0], "squat: it reads w.b.c.l.rate, not straight the angle of a joint");
}

/// A chain of `links` from a fixed base.
std::string hanging_chain(int links) {
  return fmt::format(
      "World w {{ Robot r {{ Base.fixed {{ }} Chain c {{ For i in 1..{} {{ Link l[i] {{ dhlength = "
      "0.01; dhtwist = 0.3; mass = 0.1; inertia = 1e-4, 1e-4, 1e-4, 0, 0, 0; }} }} }} }} }}",
      links);
}

// A pendulum of many links has a bound, 3000 links have a reason.
TEST(StabilityBound, IsComputedWhereThatTakesSecondsAndElseSaysWhy) {
  for (const int count : {60, 480}) EXPECT_EQ(bound_of(hanging_chain(count)).not_computed, "");
  const simulation::StabilityBound bound = bound_of(hanging_chain(3000));
  EXPECT_TRUE(std::isinf(bound.step));
  EXPECT_NE(bound.not_computed.find("robot 'r' has 3000 joints"), std::string::npos)
      << bound.not_computed;
}

/// `read`: a port that somebody reads during the run.
std::string finding(const std::string& text, int steps,
                    simulation::EngineFactory make = simulation::make_dts,
                    const std::string& read = "") {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  Running running(loaded, make);
  if (!read.empty()) running.port(read);
  simulation::EnergyWatch watch(*loaded.experiment, running.world(), steps);
  for (int i = 0; i < steps; ++i) {
    running.step();
    watch.observe();
  }
  return watch.finding();
}

TEST(EnergyWatch, FindsWhatExplicitEulerGivesAPendulum) {
  const std::string found = finding(rod("explicit_euler", 40.), 20000);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  EXPECT_EQ(finding(rod("rk4", 40.), 20000), "");
  EXPECT_EQ(finding(rod("semi_implicit_euler", 40.), 20000), "");
}

TEST(EnergyWatch, LeavesARestingBouncingOrDrivenWorldAlone) {
  EXPECT_EQ(finding(dropped_box("location = 0, 0, 0.3;"), 5000), "");
  EXPECT_EQ(finding(dropped_box("rest_on = f; velocity = 1, 0, 0;"), 5000), "");
  // Each drive and force, constant or wired, puts in ten times what there is at the start.
  const auto pushed = [](const char* robot, const char* drive) {
    return fmt::format(
        "World w {{ gravity = 9.81; deltat = 1 ms; Robot b {{ Base.fixed {{ }} Chain c {{ Link l {{ joint = "
        "prismatic; stiffness = 5; angle = 0.1; mass = 1; {} }} }} }} {} }} ",
        robot, drive);
  };
  for (const std::string& text :
       {pushed("torque = 2;", ""), pushed("", "Force f { body = b.c.l; force = 0, 0, 12; }"),
        pushed("", "Push f { body = b.c.l; force = 0, 0, 15; from = 0.5 s; duration = 1 s; }"),
        pushed("", "") + "Signal.Sine s { amplitude = 3; Wire TO w.b.c.l.torque; }",
        pushed("", "Force f { body = b.c.l; }") +
            "Signal.Sine s { amplitude = 5; frequency = 0.4; Wire TO w.f.force.z; }",
        pushed("", "") +
            "Signal.Ramp s { initial = -9.81; final = -20; duration = 3; Wire TO w.gravity.z; }"})
    EXPECT_EQ(finding(text, 5000), "") << text;
}

// A ball that bounces on springs without dampers, and an arm that meets a stop: in the contact T + V of a
// step that moves with its new velocities wavers by half of omega dt = 0.22, and comes back.
TEST(EnergyWatch, LeavesAContactWithoutDampersAlone) {
  EXPECT_EQ(
      finding(
          "World w { gravity = 9.81; deltat = 1 ms; Material s { normal_stiffness = 50 kN/m; "
          "normal_damping = 0; static_friction = 0; } Terrain.Flat g { material = s; } Robot b "
          "{ Base.mobile { location = 0, 0, 0.6; Shape.Sphere { radius = 0.1; mass = 1; } } } }",
          10000),
      "");
  for (const int steps : {200, 260, 400})
    EXPECT_EQ(
        finding(
            "World w { gravity = 0; deltat = 1 ms; Robot m { Base.fixed; Chain a { Link c { mass "
            "= 1; inertia = 0.02, 0.02, 0.02, 0, 0, 0; rate = 10; upper_limit = 0.5; "
            "limit_stiffness = 1000; limit_damping = 0; } } } }",
            steps),
        "")
        << steps;
}

// Above its largest stable step, 2 sqrt(m/k) = 0.316 ms, the spring of a Loop gains energy: there is no
// ground to be softened.
TEST(EnergyWatch, NamesNoGroundWhereThereIsNone) {
  const std::string found = finding(
      "World w { gravity = 0; deltat = 0.32 ms; Robot m { Base.fixed; Chain b { Link slide { joint "
      "= prismatic; angle = 1e-9; mass = 2; } } Loop sp { a = b.slide; b = base; stiffness = 8e7; "
      "} } }",
      400);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  EXPECT_EQ(found.find("ground"), std::string::npos) << found;
}

// Sensors, sums, formulas and controllers that drive nothing do not silence it, wherever they stand.
TEST(EnergyWatch, IsNotSilencedByWhatOnlyListens) {
  const auto spinning = [](const std::string& inside, const std::string& outside) {
    return finding(
        "World orbit { gravity = 0; deltat = 1 ms; integrator = explicit_euler; Robot handle { "
        "Base.mobile { angular_velocity = 10, 0.1, 0; mass = 1 kg; inertia = 3e-3, 5e-3, 7e-3, 0, 0, "
        "0; } Chain c { Link wheel { rate = 20; stiffness = 0.3; mass = 0.1; inertia = 1e-3, 1e-3, "
        "1e-3, 0, 0, 0; } } } " +
            inside + " } " + outside,
        5000);
  };
  ASSERT_TRUE(spinning("", "").starts_with(simulation::energy_finding));
  const std::string sum = "Sum energy { Wire FROM orbit.handle.kinetic_energy TO in[0]; }";
  for (const std::string& onlooker :
       {std::string("Sensor.IMU imu { body = handle.base; }"), sum,
        std::string(
            "Expression e { formula = \"a * 2\"; Input a { Wire FROM handle.c.wheel.rate; } }"),
        std::string(
            "Controller.PD p { pconstant = 1; Wire FROM handle.c.wheel.angle TO current; }")})
    EXPECT_TRUE(spinning(onlooker, "").starts_with(simulation::energy_finding)) << onlooker;
  EXPECT_TRUE(spinning("", sum).starts_with(simulation::energy_finding));
}

// Nor does what drives: its work is counted.
TEST(EnergyWatch, FindsWhatExplicitEulerGivesBesideADrive) {
  const std::string driven =
      rod("explicit_euler", 40.) +
      "Signal.Sine s { amplitude = 0.1; frequency = 0.4; Wire TO w.b.c.l.torque; }";
  const std::string found = finding(driven, 20000);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  std::string exact = driven;
  EXPECT_EQ(finding(exact.replace(exact.find("explicit_euler"), 14, "rk4"), 20000), "");
}

// A damper takes more than the integrator gives: only who has numerical energy measured is warned.
TEST(EnergyWatch, FindsAGainThatADamperHidesWhereItIsMeasured) {
  const auto damped = [](const std::string& integrator) {
    std::string text = rod(integrator, 40.);
    return text.replace(text.find("damping = 1e-4"), 14, "damping = 3e-3");
  };
  const auto measured = [&](const std::string& integrator) {
    return finding(damped(integrator), 20000, simulation::make_dts, "b.numerical_energy");
  };
  EXPECT_EQ(finding(damped("explicit_euler"), 20000), "");
  EXPECT_TRUE(measured("explicit_euler").starts_with(simulation::energy_finding));
  for (const char* integrator : {"semi_implicit_euler", "rk4"}) EXPECT_EQ(measured(integrator), "");
}

// A gain is held against what takes part in the motion: a mass that swings on a spring, not a wheel beside
// it that has 100,000 times its energy.
TEST(EnergyWatch, DoesNotHoldAGainAgainstAWheel) {
  const auto beside_a_wheel = [](const char* integrator) {
    return fmt::format(
        "World w {{ gravity = 0; deltat = 1 ms; integrator = {}; Robot r {{ Base.fixed {{ }} Chain a {{ Link "
        "wheel {{ rate = 500; mass = 0.5; inertia = 1e-3, 1e-3, 2e-3, 0, 0, 0; }} }} Chain b {{ Link l {{ "
        "joint = prismatic; angle = 0.01; stiffness = 50; mass = 2; }} }} }} }}",
        integrator);
  };
  const std::string found = finding(beside_a_wheel("explicit_euler"), 10000);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  EXPECT_EQ(finding(beside_a_wheel("semi_implicit_euler"), 10000), "");
}

// A lift raises what stands on it; its work is no energy from nothing. A box that a wall hits too fast
// for its step is.
TEST(EnergyWatch, CountsTheWorkOfGroundThatMoves) {
  const auto lifted = [](const char* step, const char* speed) {
    return fmt::format(
        "World w {{ touch = shapes; deltat = {}; Material m {{ normal_stiffness = 20 kN/m; normal_damping "
        "= 2; }} Terrain.Flat f {{ material = m; frame_velocity = 0, 0, {}; }} Robot b {{ Base.mobile {{ "
        "location = 0, 0, 0.05; Shape.Box {{ dimensions = 0.1, 0.1, 0.1; mass = 1; }} }} }} }}",
        step, speed);
  };
  EXPECT_EQ(finding(lifted("0.1 ms", "0.5"), 20000), "");
  const std::string found = finding(lifted("8 ms", "0.5"), 500);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  EXPECT_NE(found.find("than was put in"), std::string::npos) << found;
}

// A peer does not tell what its soft ground holds and gives back to a falling box; and a box that
// lies still under an impulse law is thrown up again and again.
TEST(EnergyWatch, SaysNothingWhereTheGroundDoesNotTell) {
  const std::string soft =
      "World w { deltat = 0.2 ms; engine = ode; settings = matched; Material m { normal_stiffness "
      "= 2 kN/m; "
      "normal_damping = 1; tangential_stiffness = 2 kN/m; tangential_damping = 1; } Terrain.Flat f "
      "{ material = m; } Robot b { Base.mobile { location = 0, 0, 0.051; velocity = 0, 0, -1; "
      "Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; } } } }";
  EXPECT_EQ(finding(soft, 400), "");
  EXPECT_EQ(finding(soft, 400, reference::ode_peer.make), "");
  EXPECT_EQ(finding(soft, 400, reference::bullet_peer.make), "");
  EXPECT_EQ(
      finding("World w { contact = impulse; Terrain.Flat f { } Robot b { Base.mobile { "
              "location = 0, 0, 0.3; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1; } } } }",
              5000),
      "");
}

// A ball of 20 mm slides into a riser: it is in the ground by its radius as soon as its centre
// crosses the edge, and 1/2 k r^2 = 40 J come from nothing.
TEST(EnergyWatch, BlamesTheGroundWhereItsEdgesGiveEnergy) {
  const std::string found = finding(
      "World w { touch = points; gravity = 9.81; deltat = 0.05 ms; Material m { static_friction = "
      "0; kinetic_friction = 0; normal_stiffness = 200 kN/m; normal_damping = 10; } Terrain.Steps "
      "stairs { height = 0.1; run = 2; from = 0.5; count = 1; spacing = 0.005; size = 3, 0.5; "
      "material = m; } Robot ball { Base.planar { plane = xz; location = 0.4, 0, 0.02; velocity = "
      "0.5, 0, 0; mass = 1 kg; inertia = 1,1,1,0,0,0; Shape.Sphere { radius = 0.02; } } } }",
      20000);
  EXPECT_TRUE(found.starts_with(simulation::energy_finding)) << found;
  EXPECT_NE(found.find("edges of the ground"), std::string::npos) << found;
  EXPECT_EQ(found.find("deltat"), std::string::npos) << found;
}

// A slide that comes to rest swings on the spring of its dry friction, which holds 1/2 tau_f z_f at
// most and gives it back.
TEST(EnergyWatch, AllowsForWhatDryFrictionHolds) {
  EXPECT_EQ(finding("World w { gravity = 0; deltat = 0.1 ms; Robot r { Base.fixed { } Chain c { "
                    "Link l { joint = prismatic; mass = 20 kg; inertia = 1, 1, 1, 0, 0, 0; "
                    "friction = 5; rate = 0.0175; } } } }",
                    1000),
            "");
}

/// A link of moment of inertia J = 0.25 kg m^2 held by a PD controller that takes differences, at a
/// step h: stable up to c = 2 J / h - h k / 2.
TEST(UnstableStretches, OfAPdControllerBeginWhereItsClosedFormSays) {
  constexpr double J = 0.25, h = 1e-3;
  const auto arm = [](double k, double c) {
    const Loaded loaded = load_text(fmt::format(
        "World w {{ gravity = 0; deltat = 1 ms; Robot a {{ Base.fixed {{}} Chain c {{ Link l {{ mass "
        "= 1; center_of_mass = 0.5, 0, 0; inertia = 0, 0, 0, 0, 0, 0; }} }} }} }} Controller.PD pd "
        "{{ pconstant = {}; dconstant = {}; Wire FROM w.a.c.l.angle TO current; Wire FROM output TO "
        "w.a.c.l.torque; }}",
        k, c));
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    return *loaded.experiment;
  };
  const std::atomic<bool> stop = false;
  const auto stretches = [&](const std::string& trail, double least, double greatest,
                             bool logarithmic = false) {
    return simulation::unstable_stretches(arm(100., 10.), {trail, {least, greatest}, logarithmic},
                                          stop);
  };
  const double most = 2. * J / h - h * 100. / 2.;
  const auto linear = stretches("pd.dconstant", 0., 1000.);
  ASSERT_EQ(linear.size(), 1u);
  EXPECT_NEAR(linear[0].least, most, 1000. / 2048.);
  EXPECT_EQ(linear[0].greatest, 1000.);
  const auto decades = stretches("pd.dconstant", 0.1, 1000., true);
  ASSERT_EQ(decades.size(), 1u);
  EXPECT_NEAR(std::log10(decades[0].least / most), 0., 4. / 2048.);
  // Of a spring without damping enough both ends count: c = 10 bears k up to (2 J / h - c) 2 / h.
  const auto springs = stretches("pd.pconstant", 0., 2e6);
  ASSERT_EQ(springs.size(), 1u);
  EXPECT_NEAR(springs[0].least, (2. * J / h - 10.) * 2. / h, 2e6 / 2048.);

  EXPECT_TRUE(stretches("pd.dconstant", 0., 400.).empty());
  EXPECT_TRUE(stretches("pd.goal", -1., 1.).empty());
  EXPECT_TRUE(stretches("pd.output", 0., 1.).empty());
  EXPECT_TRUE(stretches("w.a.c.l.torque", 0., 1.).empty());
}

}  // namespace
}  // namespace hookpoint
