// The port and the metric of numerical energy against what integrators are known to add, and against
// nothing where they are exact: forces, drives, contacts and ground in motion that do work are no part
// of it.
// ctest: long
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "reference/engines.h"
#include "reference/simbody/engine.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// The numerical energy of `robot` after `steps`.
double numerical(const std::string& text, const std::string& robot, int steps) {
  Running run(text);
  const double* energy = run.port(robot + ".numerical_energy").value;
  run.step(steps);
  return *energy;
}

/// Its greatest size on the way, from step `from` on.
double greatest(const std::string& text, const std::string& robot, int steps, int from = 0) {
  Running run(text);
  const double* energy = run.port(robot + ".numerical_energy").value;
  double most = 0.;
  for (int i = 1; i <= steps; ++i) {
    run.step();
    if (i >= from) most = std::max(most, std::abs(*energy));
  }
  return most;
}

// Free bodies.

/// Explicit Euler of a free body with the principal moments of inertia I about its centre of mass, in
/// world axes: w1 = w0 - dt I^-1 (w0 x I w0), R1 = exp([dt w0]x) R0. Twice its energy at the end.
double spun_explicitly(const Vector3d& I, Vector3d w, double dt, int steps) {
  Quaterniond R;
  const auto in_body = [&](const Vector3d& a) { return rotate(conjugate(R), a); };
  const auto momentum = [&] {
    const Vector3d own = in_body(w);
    return rotate(R, Vector3d{I.x * own.x, I.y * own.y, I.z * own.z});
  };
  for (int i = 0; i < steps; ++i) {
    const Vector3d moment = in_body(cross(w, momentum()));
    const Vector3d change = rotate(R, Vector3d{moment.x / I.x, moment.y / I.y, moment.z / I.z});
    const double angle = dt * norm(w);
    const Vector3d axis = (std::sin(0.5 * angle) / norm(w)) * w;
    R = normalized(Quaterniond{std::cos(0.5 * angle), axis.x, axis.y, axis.z} * R);
    w = w - dt * change;
  }
  return dot(w, momentum());
}

// What explicit gyroscopic forces give a body in free flight, and what a fall has of each method:
// m g^2 dt^2/2 are gained a step where z1 = z0 + dt v0, and lost where z1 = z0 + dt v1.
TEST(NumericalEnergy, IsWhatExplicitGyroscopicForcesGiveAFreeBody) {
  const Vector3d I{2e-3, 5e-3, 6e-3}, w{1., 10., 3.};
  const double dt = 1e-3;
  const int steps = 1000;
  const auto with = [&](const char* integrator) {
    return fmt::format(
        "World w {{ deltat = 1 ms; integrator = {}; gravity = 9.81; Robot top {{ Base.mobile {{ "
        "location = 0, 0, 9; angular_velocity = {}, {}, {}; mass = 1 kg; inertia = {}, {}, {}, 0, 0, 0; "
        "}} }} }}",
        integrator, w.x, w.y, w.z, I.x, I.y, I.z);
  };
  const double start = I.x * w.x * w.x + I.y * w.y * w.y + I.z * w.z * w.z;
  const double turning = 0.5 * (spun_explicitly(I, w, dt, steps) - start);
  const double falling = 0.5 * 9.81 * 9.81 * dt * dt * steps;
  EXPECT_GT(std::abs(turning), 1e-3);
  EXPECT_NEAR(numerical(with("explicit_euler"), "top", steps), turning + falling, 1e-10);
  // Gyroscopic forces of the mean velocity add nothing.
  EXPECT_NEAR(numerical(with("semi_implicit_euler"), "top", steps), -falling, 1e-8);
  EXPECT_NEAR(numerical(with("rk4"), "top", steps), 0., 1e-9);
}

// Of a free body and of springs it is the change of their energy, whatever the integrator.
TEST(NumericalEnergy, IsTheDriftOfAConservativeSystem) {
  for (const char* integrator :
       {"explicit_euler", "semi_implicit_euler", "implicit_joints", "rk4", "arkode", "cvode_bdf"}) {
    SCOPED_TRACE(integrator);
    Running run(fmt::format(
        "World w {{ gravity = 9.81; deltat = 1 ms; integrator = {}; Robot r {{ Base.fixed {{ location "
        "= 0, 0, 2; orientation = 0, 1.5708, 0; }} Chain c {{ Link a {{ dhlength = 0.4; angle = 0.8; "
        "stiffness = 3; mass = 1 kg; center_of_mass = -0.2, 0, 0; inertia = 1e-3, 0.02, 0.02, 0, 0, 0; "
        "}} Link b {{ dhlength = 0.3; angle = -0.5; rate = 2; stiffness = 2; rest_angle = 0.3; "
        "rotor_inertia = 0.01; mass = 0.7 kg; center_of_mass = -0.1, 0, 0; inertia = 1e-3, 0.01, 0.01, "
        "0, 0, 0; }} }} }} }}",
        integrator));
    const auto energy = [&] {
      const double a = run["r.c.a.angle"], b = run["r.c.b.angle"] - 0.3;
      return run["r.kinetic_energy"] + run["r.potential_energy"] + 0.5 * (3. * a * a + 2. * b * b);
    };
    const double start = energy();
    EXPECT_EQ(run["r.numerical_energy"], 0.);
    double most = 0.;
    for (int i = 0; i < 2000; ++i) {
      run.step();
      ASSERT_NEAR(run["r.numerical_energy"], energy() - start, 1e-12 * start);
      most = std::max(most, std::abs(energy() - start));
    }
    EXPECT_GT(most, 0.);
  }
}

// Forces and drives.

// m x'' = F - k x, F held: (1 - cos(w t)) F/k. Semi-implicit Euler with a force of the step's start keeps
// its books but for -dt P/2, P the power of all forces at the instant: (f0 + f1) dt v1/2 of work against
// (v0 + v1) dt f0/2 of kinetic energy.
TEST(NumericalEnergy, OfSemiImplicitEulerIsMinusHalfTheStepTimesThePower) {
  const double m = 2., k = 50., c = 3., F = 4., dt = 1e-3;
  const auto slide = [&](double damping) {
    return fmt::format(
        "World w {{ gravity = 0; deltat = 1 ms; Robot r {{ Base.fixed {{ }} Chain c {{ Link l {{ joint = "
        "prismatic; torque = {}; stiffness = {}; damping = {}; mass = {}; }} }} }} }}",
        F, k, damping, m);
  };
  for (const double damping : {0., c}) {
    Running run(slide(damping));
    for (int i = 0; i < 3000; ++i) {
      const double numerical = run["r.numerical_energy"];
      const double x = run["r.c.l.angle"], v = run["r.c.l.rate"];
      ASSERT_NEAR(numerical, -0.5 * dt * (F - k * x - damping * v) * v, 1e-12) << i;
      run.step();
    }
  }
}

// A drive that is wired, a sinusoid over a wire: what it puts in is hundreds of times what the integrator
// adds, which falls with the method's order as the step is halved.
std::string driven_slide(const char* integrator, double deltat) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {}; integrator = {}; Robot r {{ Base.fixed {{ }} Chain c {{ Link l "
      "{{ joint = prismatic; angle = 0.2; stiffness = 50; damping = 3; mass = 2; }} }} }} }} "
      "Signal.Sine s {{ rate = 100 Hz; amplitude = 8; frequency = 0.7 Hz; Wire TO w.r.c.l.torque; }}",
      deltat, integrator);
}

TEST(NumericalEnergy, OfADrivenSlideFallsWithTheOrderOfTheMethod) {
  const auto order = [](const char* integrator, double deltat) {
    const auto most = [&](double dt) {
      return greatest(driven_slide(integrator, dt), "r", static_cast<int>(std::round(2. / dt)));
    };
    const double coarse = most(deltat), fine = most(0.5 * deltat);
    EXPECT_LT(coarse, 0.1);
    return std::log2(coarse / fine);
  };
  EXPECT_NEAR(order("semi_implicit_euler", 1e-3), 1., 0.1);
  EXPECT_NEAR(order("explicit_euler", 1e-3), 1., 0.1);
  EXPECT_NEAR(order("rk4", 1e-2), 4., 0.5);
}

TEST(NumericalEnergy, OfAdaptiveMethodsFollowsTheirTolerances) {
  const auto most = [](const char* integrator, double tolerance) {
    std::string text = driven_slide(integrator, 1e-2);
    text.insert(
        text.find("integrator"),
        fmt::format("relative_tolerance = {}; absolute_tolerance = {}; ", tolerance, tolerance));
    return greatest(text, "r", 200);
  };
  for (const char* integrator : {"cvode_bdf", "cvode_adams", "arkode", "arkode_imex"}) {
    SCOPED_TRACE(integrator);
    EXPECT_LT(most(integrator, 1e-6), 1e-3);
    EXPECT_LT(most(integrator, 1e-9), 1e-5);
  }
}

// A pendulum that a motor swings up, its controller at 200 Hz: more than 4 J go through its drive.
TEST(NumericalEnergy, OfAPendulumUnderAMotorIsSmallBesideTheMotorsWork) {
  const auto pendulum = [](const char* integrator, double deltat) {
    return fmt::format(
        "World w {{ gravity = 9.81; deltat = {}; integrator = {}; Robot r {{ Base.fixed {{ location = 0, 0, "
        "2; orientation = 0, 1.5708, 0; }} Chain c {{ Link l {{ dhtwist = 90 deg; dhlength = 0; mass = 1 kg; "
        "center_of_mass = 0.4, 0, 0; inertia = 1e-3, 0.17, 0.17, 0, 0, 0; friction = 0.05; damping = 0.02; }} }} "
        "}} }} Controller.PD pd {{ rate = 200 Hz; goal = 2.5; pconstant = 20; dconstant = 3; Wire FROM "
        "w.r.c.l.angle TO current; Wire TO w.r.c.l.torque; }}",
        deltat, integrator);
  };
  Running run(pendulum("rk4", 1e-3));
  const double *angle = run.port("r.c.l.angle").value, *torque = run.port("r.c.l.torque").value;
  double through = 0., before = *angle;
  for (int i = 0; i < 2000; ++i) {
    const double held = *torque;
    run.step();
    through += std::abs(held * (*angle - before));
    before = *angle;
  }
  ASSERT_GT(through, 4.);
  const double first_order = greatest(pendulum("semi_implicit_euler", 1e-3), "r", 2000);
  EXPECT_LT(first_order, 0.02 * through);
  EXPECT_NEAR(greatest(pendulum("semi_implicit_euler", 5e-4), "r", 4000), 0.5 * first_order,
              0.06 * first_order);
  // Dry friction has a corner where the joint turns back.
  EXPECT_LT(greatest(pendulum("rk4", 1e-3), "r", 2000), 1e-4 * through);
}

// A lift whose drive is at its velocity_limit: it holds 103.8 N of 300 N back, 52 J in the second, which is
// no work. Its weight of 196.2 N takes 98 J.
TEST(NumericalEnergy, KnowsWhatADriveHoldsBackAtItsVelocityLimit) {
  const auto lift = [](const std::string& settings, simulation::EngineFactory make) {
    Running run(
        "World w { gravity = 9.81; deltat = 1 ms; " + settings +
            " Robot r { Base.fixed; Chain c { Link l { joint = prismatic; mass = 20 kg; inertia = "
            "1, 1, 1, 0, 0, 0; torque = 300 N; velocity_limit = 0.5 m/s; } } } }",
        make);
    const double* energy = run.port("r.numerical_energy").value;
    run.step(1000);
    EXPECT_NEAR(run["r.c.l.rate"], 0.5, 1e-3);
    EXPECT_NEAR(*energy, 0., 0.05);
  };
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    SCOPED_TRACE(stepper.name);
    lift("integrator = " + std::string(stepper.name) + ";", simulation::make_dts);
  }
  lift("contact = impulse;", simulation::make_dts);
  for (const auto& peer : reference::peers()) {
    SCOPED_TRACE(peer.name);
    lift("", peer.make);
  }
}

// Ground.

/// A box that slides over flat ground; `more` stands in the World.
std::string sliding_box(const std::string& world, const std::string& base,
                        const std::string& more = "") {
  return fmt::format(
      "World w {{ gravity = 9.81; {} Material m {{ static_friction = 0.5; kinetic_friction = 0.4; "
      "normal_stiffness = 20 kN/m; normal_damping = 200; tangential_stiffness = 20 kN/m; "
      "tangential_damping = 200; }} Terrain.Flat f {{ material = m; {} }} Robot b {{ Base.mobile {{ {} "
      "Shape.Box {{ dimensions = 0.4, 0.3, 0.1; mass = 2 kg; }} }} }} }}",
      world, more, base);
}

TEST(NumericalEnergy, OfABoxThatSlidesToRestIsSmallBesideItsHeat) {
  const double heat = 0.5 * 2. * 4.;  // m v^2/2, all of it
  for (const char* law : {"hookpoint", "nominal", "hunt_crossley", "azad_featherstone"}) {
    for (const char* touch : {"points", "shapes"}) {
      SCOPED_TRACE(fmt::format("{}, {}", law, touch));
      const auto box = [&](const char* integrator, double deltat) {
        return sliding_box(fmt::format("contact = {}; touch = {}; integrator = {}; deltat = {};",
                                       law, touch, integrator, deltat),
                           "rest_on = f; velocity = 2, 0, 0;");
      };
      const double coarse = greatest(box("semi_implicit_euler", 2e-4), "b", 5000);
      EXPECT_LT(coarse, 2e-3 * heat);
      EXPECT_NEAR(greatest(box("semi_implicit_euler", 1e-4), "b", 10000), 0.5 * coarse,
                  0.1 * coarse);
    }
  }
  EXPECT_LT(greatest(sliding_box("integrator = arkode; deltat = 1 ms; relative_tolerance = 1e-8; "
                                 "absolute_tolerance = 1e-10;",
                                 "rest_on = f; velocity = 2, 0, 0;"),
                     "b", 1000),
            1e-5 * heat);
}

// A belt takes a box along and gives it m v^2/2, and as much heat; a floor lifts it.
TEST(NumericalEnergy, LeavesTheWorkOfGroundInMotionOut) {
  Running belt(
      sliding_box("deltat = 0.1 ms; touch = shapes;", "rest_on = f;", "velocity = 1, 0, 0;"));
  const double* energy = belt.port("b.numerical_energy").value;
  belt.step(10000);
  EXPECT_NEAR(belt["b.kinetic_energy"], 1., 1e-3);
  EXPECT_NEAR(*energy, 0., 1e-3);
  Running lift(sliding_box("deltat = 0.1 ms; touch = shapes;", "rest_on = f;",
                           "frame_velocity = 0, 0, 0.5;"));
  energy = lift.port("b.numerical_energy").value;
  const double start = lift["b.potential_energy"];
  lift.step(10000);
  EXPECT_GT(lift["b.potential_energy"] - start, 9.);
  EXPECT_NEAR(*energy, 0., 0.01);
}

// Impacts that lose half of the energy, a push, and a leg that folds on impact: impulses do the work of
// their point's mean velocity.
TEST(NumericalEnergy, LeavesTheWorkOfImpulsesOut) {
  for (const char* law : {"impulse", "impulse_reversal"}) {
    SCOPED_TRACE(law);
    Running ball(fmt::format(
        "World w {{ gravity = 9.81; contact = {}; deltat = 1 ms; Material m {{ restitution = 0.7; }} "
        "Terrain.Flat f {{ material = m; }} Robot b {{ Base.mobile {{ location = 0, 0, 0.6; Shape.Sphere {{ "
        "radius = 0.1; mass = 1 kg; }} }} }} Force push {{ body = b.base; force = 0.5, 0, 0; point = 0, 0, "
        "0.02; }} }}",
        law));
    const double* energy = ball.port("b.numerical_energy").value;
    const double start = ball["b.kinetic_energy"] + ball["b.potential_energy"];
    ball.step(1000);
    EXPECT_LT(ball["b.kinetic_energy"] + ball["b.potential_energy"], start - 1.);
    EXPECT_NEAR(*energy, 0., 1e-5 * start);
    Running leg(fmt::format(
        "World w {{ gravity = 9.81; contact = {}; deltat = 1 ms; Terrain.Flat f {{ }} Robot b {{ Base.mobile "
        "{{ location = 0, 0, 0.5; Shape.Box {{ dimensions = 0.3, 0.2, 0.1; mass = 3 kg; }} }} Chain c {{ "
        "hip_orientation = 1.5708, 0, 0; Link l {{ dhlength = 0.3; angle = -1.2; rest_angle = -1.2; stiffness = "
        "40; damping = 0.4; mass = 1 kg; center_of_mass = -0.15, 0, 0; inertia = 1e-3, 0.01, 0.01, 0, 0, 0; "
        "ContactPoint tip {{ location = 0, 0, 0; }} }} }} }} }}",
        law));
    energy = leg.port("b.numerical_energy").value;
    leg.step(600);
    EXPECT_NEAR(*energy, 0., 0.01);
  }
}

// What is summed.

// A field that grows does work on what hangs in it.
TEST(NumericalEnergy, LeavesTheWorkOfAFieldThatChangesOut) {
  const auto hanging = [](double deltat) {
    return fmt::format(
        "World w {{ gravity = 9.81; deltat = {}; Robot r {{ Base.fixed {{ }} Chain c {{ Link l {{ joint = "
        "prismatic; stiffness = 50; mass = 1; }} }} }} }} Signal.Sine s {{ rate = 200 Hz; amplitude = 5; offset = "
        "-9.81; Wire TO w.gravity.z; }}",
        deltat);
  };
  const double coarse = greatest(hanging(1e-3), "r", 2000);
  EXPECT_LT(coarse, 0.05);
  EXPECT_NEAR(greatest(hanging(5e-4), "r", 4000), 0.5 * coarse, 0.1 * coarse);
}

// A world that takes the state of another has its numerical energy, whoever reads it, and goes on bit for
// bit.
TEST(NumericalEnergy, BelongsToTheSavedState) {
  const std::string text =
      sliding_box("deltat = 0.5 ms;", "location = 0, 0, 0.08; velocity = 1, 0, 0;") +
      "Signal.Sine s { amplitude = 3; offset = -9.81; Wire TO w.gravity.z; }";
  Running whole(text), other(text), unread(text);
  const double* energy = whole.port("b.numerical_energy").value;
  const double* same = other.port("b.numerical_energy").value;
  whole.step(500);
  std::vector<double> numbers(whole.world().state_size());
  whole.world().save(numbers);
  other.step(17);
  other.world().restore(numbers);
  unread.world().restore(numbers);
  EXPECT_NE(*energy, 0.);
  EXPECT_EQ(*same, *energy);
  for (Running* run : {&whole, &other, &unread}) run->step(300);
  EXPECT_EQ(*same, *energy);
  EXPECT_EQ(unread["b.numerical_energy"], *energy);
  // Of a state that nobody measured it begins there.
  Running plain(text);
  plain.step(500);
  plain.world().save(numbers);
  other.world().restore(numbers);
  EXPECT_EQ(*same, 0.);
}

// Every engine.

// A box that is thrown on the ground, tumbles, slides and is pushed loses some 6 J. What engines that we
// do not know the inside of publish accounts for it.
TEST(NumericalEnergy, IsAMetricOfEveryEngine) {
  const testing::Workplace work;
  work.file(
      "box.hook",
      "World w { gravity = 9.81; deltat = 0.2 ms; duration = 1 s; touch = shapes; Material m { "
      "static_friction = 0.4; kinetic_friction = 0.4; } Terrain.Flat f { material = m; } Robot b { "
      "Base.mobile { location = 0, 0, 0.3; orientation = 0.2, 0.3, 0; velocity = 2, 0, 0; "
      "angular_velocity = 1, 2, 0; Shape.Box { dimensions = 0.3, 0.2, 0.1; mass = 1 kg; } } } Force push "
      "{ body = b.base; force = 1, 0, 0; } }");
  work.file(
      "study.hook",
      "Study s { scene = \"box.hook\"; duration = 1 s; Measure numerical_energy; "
      "Measure numerical_energy_part; Subject ours { engine = dts; } Subject ode { engine = ode; } "
      "Subject bullet { engine = bullet; } Subject mujoco { engine = mujoco; } Subject dart { engine = "
      "dart; } Truth none { metric = numerical_energy; equals = "
      "predicted; within = 0.1 J; } Truth part { metric = numerical_energy_part; equals = predicted; "
      "within = 0.02; } }");
  const auto result = work.hookpoint("study study.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err << work.read("here/results.csv");
}

// Simbody takes steps of its own between the instants whose forces it tells.
TEST(NumericalEnergy, IsNotToldWhereItDoesNotFollowFromWhatIsPublished) {
  const auto simbody = [](const std::string& ground) {
    return Running(
        "World w { gravity = 9.81; deltat = 1 ms; engine = simbody; " + ground +
            " Robot b { Base.mobile { location = 0, 0, 1; angular_velocity = 1, 2, 3; mass = 1; "
            "inertia = 0.01, 0.02, 0.03, 0, 0, 0; } } }",
        reference::simbody_peer.make);
  };
  EXPECT_THROW(simbody("Terrain.Flat f { }")["b.numerical_energy"], simulation::ExperimentError);
  const Loaded wired = load_text(
      "World w { engine = simbody; Terrain.Flat f { } Robot b { Base.mobile { mass = 1; inertia = 1, 1, 1, "
      "0, 0, 0; } } Gain g { Wire FROM b.numerical_energy TO input; } }");
  EXPECT_NE(wired.diagnostics.find("`numerical_energy` is not known: choose another engine"),
            std::string::npos)
      << wired.diagnostics;
  Running free = simbody("");
  const double* energy = free.port("b.numerical_energy").value;
  free.step(1000);
  EXPECT_NEAR(*energy, 0., 1e-6);
}

}  // namespace
}  // namespace hookpoint
