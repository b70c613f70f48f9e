// Which ports there are, what they show, and what wires from and to them take the place of.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "control/random.h"
#include "control/registry.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using namespace control;
using Values = std::vector<double>;

/// Reads a joint's angle and drives its torque unless wires say otherwise.
class Spring final : public Component {
 public:
  Input angle = Input{*this, "angle_in", "rad", "the joint's"}.attached("angle");
  Output torque = Output{*this, "torque", "N.m", "the joint's"}.attached("torque");
  void update(const Tick&) override { torque = 1. - 2. * angle; }
};
HOOKPOINT_REGISTER_COMPONENT(Spring, "Test.Spring", "a spring", Attachment::joint, "angle_in",
                             "torque")

/// Shows the first number of its own stream.
class Dice final : public Component {
 public:
  Output output{*this, "output", "", "a number of the component's own"};
  void start(double) override { first_ = RandomStream(stream()).gaussian(0); }
  void update(const Tick&) override { output = first_; }

 private:
  double first_ = 0.;
};
HOOKPOINT_REGISTER_COMPONENT(Dice, "Test.Dice", "chance")

const std::string arm =
    "World w { gravity = 0; Robot bot { Base.fixed; Chain leg { Link one { mass = 1; Shape.Sphere "
    "radius = 1; } Link two { mass = 1; Shape.Sphere radius = 1; } } } }\n";

TEST(Attachment, AWireThatListensLeavesTheDriveInPlace) {
  const Running run(arm +
                    "Test.Spring s { joint = w.bot.leg.one; Wire TO p.input; }\nProbe p;"
                    "Probe q { Wire FROM s.torque; }");
  EXPECT_EQ(run["w.bot.leg.one.torque"], 1.);
  EXPECT_EQ(run["p.value"], 1.);
  EXPECT_EQ(run["q.value"], 1.);
}

TEST(Attachment, AWireToTheJointTakesItsPlace) {
  Running run(arm +
              "Test.Spring s { joint = w.bot.leg.one; Wire TO w.bot.leg.one.torque { delay = 3 ms; "
              "} }");
  EXPECT_EQ(run.record("w.bot.leg.one.torque", 4), (Values{0., 0., 0., 1., 1.}));
}

TEST(Attachment, AWireToAnotherJointDrivesThatOneAsWell) {
  const Running run(arm + "Test.Spring s { joint = w.bot.leg.one; Wire TO w.bot.leg.two.torque; }");
  EXPECT_EQ(run["w.bot.leg.one.torque"], 1.);
  EXPECT_EQ(run["w.bot.leg.two.torque"], 1.);
}

TEST(Attachment, WithoutAJointAnyWireFromTheOutputWillDo) {
  const Running run(arm +
                    "Test.Spring s { Wire FROM w.bot.leg.one.angle; Wire TO g.input; }"
                    "Gain g { gain = 3; Wire TO w.bot.leg.one.torque; }");
  EXPECT_EQ(run["w.bot.leg.one.torque"], 3.);
}

double dice(const std::string& text, const std::string& name = "d") {
  return Running(text)[name + ".output"];
}

TEST(ComponentNoise, DependsOnSeedAndTrailAndNothingElse) {
  const std::string world = "World w { } ", seeded = "World w { seed = 2; } ";
  const double alone = dice(world + "Test.Dice d;");
  EXPECT_NE(alone, 0.);
  EXPECT_EQ(dice(world + "Test.Dice d;"), alone);
  EXPECT_NE(dice(seeded + "Test.Dice d;"), alone);
  EXPECT_NE(dice(world + "Test.Dice e;", "e"), alone);
  EXPECT_EQ(dice(world + "Test.Dice before; Test.Dice d; Probe p;"), alone);
  EXPECT_EQ(dice(world + "Test.Dice d; Test.Dice after { Wire TO p.input; } Probe p;"), alone);
}

TEST(Ports, AConservativePendulumKeepsItsEnergy) {
  // A point mass of 2 kg on a massless rod of 0.5 m, from 1 rad below the horizontal.
  Running run(
      "World w { deltat = 0.1 ms; integrator = rk4; Robot bot { Base.fixed; Chain leg { "
      "hip_orientation = 90 deg, 0, 0; Link one { mass = 2; center_of_mass = 0.5, 0, 0; inertia = "
      "1e-9,1e-9,1e-9,0,0,0; angle = -1; } } } }");
  const double start = -2. * 9.81 * 0.5 * std::sin(1.);
  EXPECT_NEAR(run["bot.potential_energy"], start, 1e-12);
  EXPECT_NEAR(run["bot.kinetic_energy"], 0., 1e-15);
  EXPECT_NEAR(run["bot.center_of_mass.x"], 0.5 * std::cos(1.), 1e-12);
  EXPECT_NEAR(run["bot.center_of_mass.z"], -0.5 * std::sin(1.), 1e-12);
  EXPECT_EQ(run.port("bot.kinetic_energy").unit, "J");
  run.step(1000);
  EXPECT_GT(run["bot.kinetic_energy"], 0.01);
  EXPECT_NEAR(run["bot.kinetic_energy"] + run["bot.potential_energy"], start, 1e-9);
  const double rate = run["bot.leg.one.rate"];
  EXPECT_NEAR(run["bot.kinetic_energy"], 0.5 * 2. * 0.25 * rate * rate, 1e-6);
}

TEST(Ports, BodiesShowTheirAcceleration) {
  // Free fall with a push: g and F/m at once.
  Running run(
      "World w { Robot b { Base.mobile { mass = 2; Shape.Sphere radius = 1; } } Force f { body = "
      "b.base; force = 3,0,0; torque = 0,0,0.4; } }");
  EXPECT_EQ(run["b.linear_acceleration.z"], 0.);
  run.step(3);
  EXPECT_NEAR(run["b.base.linear_acceleration.x"], 1.5, 1e-9);
  EXPECT_NEAR(run["b.linear_acceleration.z"], -9.81, 1e-9);
  EXPECT_NEAR(run["b.angular_acceleration.z"], 0.4 / (0.4 * 2.), 1e-9);
}

/// A ball of 1 kg with one ContactPoint at its lowest point, on the ground or above it.
std::string point(const std::string& base, const std::string& world = "") {
  return "World w { deltat = 0.5 ms; " + world +
         " Material clay { normal_stiffness = 10 kN/m; normal_damping = 100; tangential_stiffness "
         "= 10 kN/m; tangential_damping = 100; static_friction = 0.5; kinetic_friction = 0.5; } "
         "Terrain.Flat g { material = clay; } Robot b { Base.mobile { mass = 1; inertia = "
         "1,1,1,0,0,0; ContactPoint foot { } " +
         base + " } } }";
}

TEST(Ports, AContactPointShowsForceDepthAndHook) {
  Running run(point("location = 0.3, 0, 0;"));
  run.step(2000);
  EXPECT_NEAR(run["b.base.foot.contact.force.z"], 9.81, 1e-6);
  EXPECT_NEAR(run["b.base.foot.contact.depth"], 9.81 / 1e4, 1e-9);
  EXPECT_NEAR(run["b.base.foot.position.z"], -9.81 / 1e4, 1e-9);
  EXPECT_EQ(run["b.base.foot.contact.sliding"], 0.);
  EXPECT_NEAR(run["b.base.foot.contact.hook.x"], 0.3, 1e-12);
  EXPECT_EQ(run["b.base.contact.count"], 1.);
  EXPECT_EQ(run.port("b.base.foot.contact.hook.x").unit, "m");
}

TEST(Ports, ASlidingPointDragsItsHook) {
  Running run(point("location = 0, 0, -0.981 mm; velocity = 1, 0, 0;"));
  run.step(100);
  const double speed = run["b.velocity.x"];
  EXPECT_EQ(run["b.base.foot.contact.sliding"], 1.);
  EXPECT_NEAR(run["b.base.foot.contact.force.x"], -0.5 * 9.81, 1e-2);
  // The hook trails by mu N / k_t, less the damper's part, once the slip is steady.
  EXPECT_LT(run["b.base.foot.contact.hook.x"], run["b.base.foot.position.x"]);
  EXPECT_GT(run["b.base.foot.contact.hook.x"], run["b.base.foot.position.x"] - 1e-3);
  EXPECT_NEAR(speed, 1. - 0.5 * 9.81 * 0.05, 2e-3);
}

TEST(Ports, AFreePointHasNoContact) {
  Running run(point("location = 0, 0, 1;"));
  EXPECT_NEAR(run["b.base.foot.contact.depth"], -1., 1e-12);
  EXPECT_EQ(run["b.base.foot.contact.force.z"], 0.);
  EXPECT_EQ(run["b.base.foot.contact.hook.z"], run["b.base.foot.position.z"]);
  EXPECT_EQ(run["b.base.contact.count"], 0.);
}

TEST(Ports, AWireReadsADetailFromTheFirstRowOn) {
  Running run(point("location = 0, 0, -1 mm;") +
              "Probe p { Wire FROM w.b.base.foot.contact.depth; } Probe e { Wire FROM "
              "w.b.potential_energy; }");
  EXPECT_EQ(run["p.value"], 0.001);
  EXPECT_NEAR(run["e.value"], -9.81 * 0.001, 1e-15);
  run.step();
  EXPECT_EQ(run["p.value"], run["b.base.foot.contact.depth"]);
}

TEST(Ports, WhatIsReadAllocatesNothingInAStep) {
  Running run(point("location = 0, 0, -1 mm;"));
  for (const char* port : {"b.kinetic_energy", "b.linear_acceleration.x", "b.contact.count",
                           "b.base.foot.contact.depth"})
    run.port(port);
  run.step();
  const long before = hookpoint::testing::allocation_count();
  for (int i = 0; i < 100; ++i) run.world().step();
  EXPECT_EQ(hookpoint::testing::allocation_count() - before, 0);
}

TEST(Ports, AHangingArmPullsAtItsHip) {
  Running run(
      "World w { Robot bot { Base.fixed; Chain leg { hip_orientation = 90 deg, 0, 0; Link one { "
      "mass = 2; center_of_mass = 0.5, 0, 0; inertia = 1,1,1,0,0,0; stiffness = 1 kN.m/rad; "
      "damping = 50; } } } }");
  run.step(5000);
  EXPECT_NEAR(run["bot.leg.hip_force.z"], -2. * 9.81, 1e-6);
  EXPECT_NEAR(std::abs(run["bot.leg.hip_moment.y"]),
              2. * 9.81 * 0.5 * std::cos(run["bot.leg.one.angle"]), 1e-6);
  EXPECT_NEAR(run["bot.leg.one.total_torque"], 2. * 9.81 * 0.5 * std::cos(run["bot.leg.one.angle"]),
              1e-6);
  EXPECT_EQ(run["bot.leg.one.torque"], 0.);
}

// Two weights in a row, hanging still: each joint carries what is below it.
TEST(Ports, JointsTellWhatTheyTransmit) {
  Running run(
      "World w { Robot bot { Base.fixed; Chain leg { hip_orientation = 90 deg, 0, 0; Link one { "
      "mass = 2; center_of_mass = 0.5, 0, 0; inertia = 1,1,1,0,0,0; stiffness = 1 kN.m/rad; "
      "damping = 50; } Link two { dhlength = 1; mass = 3; center_of_mass = 0.25, 0, 0; inertia = "
      "1,1,1,0,0,0; stiffness = 1 kN.m/rad; damping = 50; } } } }");
  run.port("bot.leg.one.reaction_force.z");
  run.step(8000);
  EXPECT_NEAR(run["bot.leg.one.reaction_force.z"], 5. * 9.81, 1e-6);
  EXPECT_NEAR(run["bot.leg.two.reaction_force.z"], 3. * 9.81, 1e-6);
  EXPECT_NEAR(run["bot.leg.two.reaction_force.x"], 0., 1e-6);
  EXPECT_NEAR(std::abs(run["bot.leg.two.reaction_moment.y"]),
              std::abs(run["bot.leg.two.total_torque"]), 1e-6);
  EXPECT_NEAR(run["bot.leg.one.reaction_force.z"], -run["bot.leg.hip_force.z"], 1e-6);
  const long before = hookpoint::testing::allocation_count();
  for (int i = 0; i < 100; ++i) run.world().step();
  EXPECT_EQ(hookpoint::testing::allocation_count() - before, 0);
}

TEST(Ports, EveryPortOfEveryClassHasAValue) {
  const std::string text =
      point("Shape.Sphere ball { radius = 1; }",
            "Push p { body = b.base; to = 1; } Robot arm { Base.fixed; Chain c { Link l { mass = "
            "1; Shape.Sphere round { radius = 1; } } } }") +
      "Probe probe; Controller.PD pd; Signal.Sine wave;";
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "every_port.hook";
  std::ofstream(file) << text;
  language::Library library(experiment_schema(), {});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(file, {}, diagnostics);
  std::filesystem::remove(file);
  ASSERT_TRUE(root);
  Running run(text);
  int ports = 0;
  const auto visit = [&](const auto& self, const language::Object& object) -> void {
    for (const language::FieldSchema& field : object.schema->fields) {
      const bool computed = !field.setting && field.port != language::Direction::none;
      if (!computed && object.find(field.name) == nullptr) continue;
      if (field.port == language::Direction::none) continue;
      const bool vector = field.type == language::FieldType::numbers && field.max_count == 3;
      if (field.type != language::FieldType::number && field.type != language::FieldType::boolean &&
          !vector)
        continue;
      if (vector && !computed && object.find(field.name)->numbers.size() != 3) continue;
      ++ports;
      EXPECT_NO_THROW(run.port(object.trail() + "." + field.name + (vector ? ".z" : "")))
          << object.trail() << "." << field.name;
    }
    for (const auto& child : object.children) self(self, *child);
  };
  for (const auto& child : root->children) visit(visit, *child);
  EXPECT_GT(ports, 120);
}

}  // namespace
}  // namespace hookpoint
