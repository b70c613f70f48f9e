// What a drive does beside its torque: its rotor turns with the joint, and it gives no more than
// its effort_limit. Closed forms, and MuJoCo, under every engine alike.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "reference/engines.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

/// One link about (along) the vertical z, without gravity: `fields` are the Link's.
simulation::Experiment joint_with(const std::string& fields) {
  const Loaded loaded = load_text(
      "World w { gravity = 0; deltat = 1 ms; Robot r { Base.fixed; Chain c { Link l { mass = 2 kg; "
      "inertia = .1,.1,.2,0,0,0; " +
      fields + " } } } }");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return loaded.experiment.value_or(simulation::Experiment{});
}

/// The joint after a step, from rest.
simulation::JointState first_step(simulation::EngineFactory make,
                                  const simulation::Experiment& experiment) {
  const auto engine = make(experiment);
  EXPECT_TRUE(engine->step().ok());
  return engine->state().joints.at(0);
}

void expect_acceleration(const simulation::Experiment& experiment, double acceleration,
                         double torque) {
  const auto check = [&](std::string_view name, simulation::EngineFactory make, double within) {
    const simulation::JointState joint = first_step(make, experiment);
    EXPECT_NEAR(joint.acceleration, acceleration, within * std::abs(acceleration)) << name;
    EXPECT_DOUBLE_EQ(joint.torque, torque) << name;
  };
  check("dts", simulation::make_dts, 1e-12);
  // Constraints of engines with free bodies give way a little.
  for (const auto& peer : reference::peers()) {
    check(peer.name, peer.make, 1e-3);
  }
}

TEST(EffortLimit, BoundsWhatTheDriveGivesEitherWay) {
  for (const double sign : {1., -1.}) {
    const std::string asked = "torque = " + std::to_string(sign * 5.) + " N.m; ";
    expect_acceleration(joint_with(asked + "effort_limit = 2 N.m;"), sign * 2. / 0.2, sign * 2.);
    expect_acceleration(joint_with(asked + "effort_limit = 5.5 N.m;"), sign * 5. / 0.2, sign * 5.);
  }
  expect_acceleration(joint_with("joint = prismatic; torque = 7 N; effort_limit = 3 N;"), 1.5, 3.);
}

TEST(EffortLimit, DoesNotBoundTheJointsOwnSpring) {
  expect_acceleration(
      joint_with("torque = 5 N.m; effort_limit = 2 N.m; stiffness = 10 N.m/rad; rest_angle = 1;"),
      12. / 0.2, 12.);
}

TEST(EffortLimit, IsToldOnceWhereItIsMet) {
  simulation::Experiment experiment = joint_with("torque = 1 N.m; effort_limit = 2 N.m;");
  const auto look = [&](simulation::EngineFactory make) {
    const auto engine = make(experiment);
    const std::size_t before = engine->state().notices.size();
    EXPECT_TRUE(engine->step().ok());
    EXPECT_EQ(engine->state().notices.size(), before);
    engine->inputs().joint_torques[0] = -5.;
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(engine->step().ok());
    ASSERT_EQ(engine->state().notices.size(), before + 1);
    EXPECT_EQ(engine->state().notices.back(),
              "0.001 s: the drive of r.c.l has to give -5 N.m and gives its effort_limit, 2 N.m "
              "(reported once)");
    EXPECT_EQ(engine->state().joints[0].torque, -2.);
  };
  look(simulation::make_dts);
  for (const auto& peer : reference::peers()) {
    look(peer.make);
  }
}

/// 0.2 kg m^2 of the link and 0.3 of the rotor; 2 kg and 3 kg.
TEST(RotorInertia, AddsToWhatTheJointMoves) {
  const auto turning = joint_with("torque = 5 N.m; rotor_inertia = 0.3 kg.m^2;");
  EXPECT_NEAR(first_step(simulation::make_dts, turning).acceleration, 10., 1e-12);
  const auto sliding = joint_with("joint = prismatic; torque = 5 N; rotor_inertia = 3 kg;");
  EXPECT_NEAR(first_step(simulation::make_dts, sliding).acceleration, 1., 1e-12);
  for (const auto& peer : reference::peers()) {
    if (peer.name == "mujoco") {
      EXPECT_NEAR(first_step(peer.make, turning).acceleration, 10., 1e-9);
      EXPECT_NEAR(first_step(peer.make, sliding).acceleration, 1., 1e-9);
      continue;
    }
    EXPECT_THROW(peer.make(turning), simulation::ExperimentError) << peer.name;
  }
}

/// 1 kg at 0.5 m with a rotor of 0.15 kg m^2: T = 2 pi sqrt((m l^2 + I_r)/(m g l)), 2.534 s; a
/// swing of 1 mrad is isochronous to 1e-7.
TEST(RotorInertia, LengthensThePeriodOfAPendulum) {
  const Loaded loaded = load_text(
      "World w { deltat = 1 ms; integrator = rk4; Robot r { Base.fixed; Chain c { Link l { dhtwist "
      "= "
      "90 deg; mass = 1 kg; center_of_mass = .5,0,0; inertia = 1e-9,1e-9,1e-9,0,0,0; rotor_inertia "
      "= 0.15; dhangle = -90 deg; angle = 1e-3; } } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto engine = simulation::make_dts(*loaded.experiment);
  double before = engine->state().joints[0].angle, first = -1., last = 0.;
  int downwards = 0;
  while (downwards < 3) {
    ASSERT_TRUE(engine->step().ok());
    const double now = engine->state().joints[0].angle;
    if (before > 0. && now <= 0.) {
      last = engine->state().time - 1e-3 * now / (now - before);
      if (first < 0.) first = last;
      ++downwards;
    }
    before = now;
  }
  const double period = 2. * std::numbers::pi * std::sqrt((0.25 + 1e-9 + 0.15) / (9.81 * 0.5));
  EXPECT_NEAR(0.5 * (last - first), period, 1e-6 * period);
}

TEST(JointDrive, IsGivenInTheJointsOwnUnits) {
  const auto errors = [](const std::string& fields) {
    return load_text(
               "World w { Robot r { Base.fixed; Chain c { Link l { mass = 1; inertia = "
               "1,1,1,0,0,0; " +
               fields + " } } } }")
        .diagnostics;
  };
  EXPECT_EQ(errors("rotor_inertia = 1 g.m^2; effort_limit = 1 kN.m;"), "");
  EXPECT_EQ(errors("joint = prismatic; rotor_inertia = 1 g; effort_limit = 1 N;"), "");
  for (const char* wrong : {"rotor_inertia = 1 kg;", "effort_limit = 1 N;", "effort_limit = 0;",
                            "rotor_inertia = -1;", "joint = prismatic; rotor_inertia = 1 kg.m^2;"})
    EXPECT_NE(errors(wrong), "") << wrong;
}

}  // namespace
}  // namespace hookpoint
