// The fields of a joint are in the units of its kind, whatever says first which kind it is.
#include <gtest/gtest.h>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

std::string link(const std::string& fields, const std::string& rest = "") {
  return "World w { gravity = 0; Robot r { Base.fixed; Chain c { Link l { mass = 2;\n" + fields +
         " Shape.Sphere radius = 1; } } } }\n" + rest;
}

const simulation::LinkSpec& link_of(const Loaded& loaded) {
  return loaded.experiment->robots[0].chains[0].links[0];
}

TEST(JointUnits, APrismaticJointIsGivenInItsOwn) {
  const Loaded loaded = load_text(
      link("angle = 10 mm; rate = 2 cm/s; torque = 3 kN; damping = 4 N.s/m; friction = 5 N; "
           "stiffness = 6 kN/m; rest_angle = 7 mm; lower_limit = -8 cm; upper_limit = 9 cm; "
           "joint = prismatic;"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::LinkSpec& joint = link_of(loaded);
  EXPECT_EQ(joint.angle, 0.01);
  EXPECT_EQ(joint.rate, 0.02);
  EXPECT_EQ(joint.torque, 3000.);
  EXPECT_EQ(joint.damping, 4.);
  EXPECT_EQ(joint.friction, 5.);
  EXPECT_EQ(joint.stiffness, 6000.);
  EXPECT_EQ(joint.rest_angle, 0.007);
  EXPECT_EQ(joint.lower_limit, -0.08);
  EXPECT_EQ(joint.upper_limit, 0.09);
}

TEST(JointUnits, StopsAndFrictionHaveTheirOwnForBothKinds) {
  const Loaded sliding =
      load_text(link("joint = prismatic; limit_stiffness = 2 kN/m; limit_damping = 3 N.s/m; "
                     "friction_deflection = 4 um; friction_speed = 5 mm/s;"));
  ASSERT_TRUE(sliding.experiment) << sliding.diagnostics;
  EXPECT_EQ(link_of(sliding).limit_stiffness, 2000.);
  EXPECT_EQ(link_of(sliding).limit_damping, 3.);
  EXPECT_EQ(link_of(sliding).friction_deflection, 4e-6);
  EXPECT_EQ(link_of(sliding).friction_speed, 0.005);
}

TEST(JointUnits, DefaultsAreThoseOfTheKind) {
  const simulation::LinkSpec turning = link_of(load_text(link("friction = 1;")));
  EXPECT_EQ(turning.limit_stiffness, 1000.);
  EXPECT_EQ(turning.limit_damping, 1.);
  EXPECT_EQ(turning.friction_deflection, 1e-3);
  EXPECT_EQ(turning.friction_speed, 0.05);
  const simulation::LinkSpec sliding = link_of(load_text(link("joint = prismatic;")));
  EXPECT_EQ(sliding.limit_stiffness, 1e5);
  EXPECT_EQ(sliding.limit_damping, 100.);
  EXPECT_EQ(sliding.friction_deflection, 1e-4);
  EXPECT_EQ(sliding.friction_speed, 0.005);
}

TEST(JointUnits, NumbersWithoutAUnitAreSIForBoth) {
  for (const char* kind : {"revolute", "prismatic"}) {
    const Loaded loaded =
        load_text(link(std::string("angle = .5; stiffness = 3; joint = ") + kind + ";"));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(link_of(loaded).angle, 0.5);
    EXPECT_EQ(link_of(loaded).stiffness, 3.);
  }
}

TEST(JointUnits, ThoseOfTheOtherKindAreRefusedAtTheValue) {
  struct Refusal {
    const char* fields;
    const char* said;
  };
  for (const auto& [fields, said] : {
           Refusal{"angle = 10 mm;",
                   "2:9 `angle` takes a value in rad where `joint` is revolute, not in m"},
           {"angle = 10 deg;\njoint = prismatic;",
            "2:9 `angle` takes a value in m where `joint` is prismatic, not in rad"},
           {"joint = prismatic; stiffness = 3 N.m/rad;",
            "2:32 `stiffness` takes a value in N/m where `joint` is prismatic, not in "
            "kg.m^2/rad/s^2"},
           {"joint = prismatic; friction_speed = 1 rad/s;",
            "2:37 `friction_speed` takes a value in m/s where `joint` is prismatic, not in rad/s"},
           {"torque = 3 kg;",
            "2:10 `torque` takes a value in N.m (in N where `joint` is prismatic), not in kg"},
           {"damping = -1;", "2:11 `damping` must be at least 0, not -1"},
           {"friction_deflection = 0;", "2:23 `friction_deflection` must be greater than 0, not 0"},
       })
    EXPECT_EQ(load_text(link(fields)).diagnostics, std::string("error ") + said + "\n");
}

TEST(JointUnits, WhatIsSetFromOutsideCountsToo) {
  language::EvaluateOptions sliding, turning;
  sliding.overrides = {{"w.r.c.l.joint", "prismatic"}, {"w.r.c.l.angle", "10 mm"}};
  turning.overrides = {{"w.r.c.l.joint", "prismatic"}};
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "joint_units.hook";
  std::ofstream(file) << link("angle = 10 deg;");
  EXPECT_TRUE(load_file(file, sliding).experiment);
  EXPECT_EQ(load_file(file, turning).diagnostics,
            "error 2:9 `angle` takes a value in m where `joint` is prismatic, not in rad\n");
  std::filesystem::remove(file);
}

TEST(JointUnits, WiresAndTheirNoiseFollow) {
  const std::string sliding = "joint = prismatic;";
  const std::string probe = "Probe p { Wire FROM w.r.c.l.angle { noise = 1 mm; } }\n";
  const Loaded good = load_text(link(sliding, probe));
  EXPECT_TRUE(good.experiment) << good.diagnostics;
  EXPECT_EQ(load_text(link("", probe)).diagnostics,
            "error 3:45 `noise` takes the unit of `angle`, rad, not m\n");
  EXPECT_EQ(load_text(link(sliding, "Wire FROM w.r.c.l.rate TO w.r.c.l.torque;")).diagnostics,
            "error 3:1 `rate` is in m/s, `torque` in N\n");
  EXPECT_TRUE(load_text(link(sliding,
                             "Wire FROM w.r.position.x TO s.angle_in; Sensor.Joint s { "
                             "joint = w.r.c.l; }"))
                  .diagnostics.starts_with("error 3:1 `position.x` is in m, `angle_in` in rad"));
}

TEST(JointUnits, PortsAndConstantsCarryThem) {
  const Running run(link("joint = prismatic; stiffness = 3; upper_limit = 1;"));
  EXPECT_EQ(run.port("r.c.l.angle").unit, "m");
  EXPECT_EQ(run.port("r.c.l.rate").unit, "m/s");
  EXPECT_EQ(run.port("r.c.l.acceleration").unit, "m/s^2");
  EXPECT_EQ(run.port("r.c.l.torque").unit, "N");
  EXPECT_EQ(run.port("r.c.l.total_torque").unit, "N");
  EXPECT_EQ(run.port("r.c.l.stiffness").unit, "N/m");
  EXPECT_EQ(run.port("r.c.l.upper_limit").unit, "m");
  const Loaded recorded =
      load_text(link("joint = prismatic;", "Record x trails = w.r.c.l.angle, w.r.c.l.rate;"));
  ASSERT_TRUE(recorded.experiment) << recorded.diagnostics;
  EXPECT_EQ(recorded.experiment->records[0].channels[0].unit, "m");
  EXPECT_EQ(recorded.experiment->records[0].channels[1].unit, "m/s");
}

TEST(JointUnits, APrintedFileReadsBack) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "joint_units_print.hook";
  std::ofstream(file) << link("stiffness = 2 N/mm; angle = 10 mm; joint = prismatic;");
  language::Library library(experiment_schema(), {});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(file, {}, diagnostics);
  ASSERT_TRUE(root);
  const Loaded again = load_text(language::print(*root));
  ASSERT_TRUE(again.experiment) << again.diagnostics;
  EXPECT_EQ(link_of(again).angle, 0.01);
  EXPECT_EQ(link_of(again).stiffness, 2000.);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace hookpoint
