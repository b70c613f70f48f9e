// Figure 7 of the paper, as its experiment; and what wires may reach.
#include <gtest/gtest.h>

#include <numbers>

#include "simulation/experiment/names.h"
#include "simulation/run/loop.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using namespace simulation;

class Figure7 : public ::testing::Test {
 protected:
  void SetUp() override {
    loaded_ = load_file(std::filesystem::path(testing::source_folder()) /
                        "configs/paper/fig7_two_joint_arm.hook");
    ASSERT_TRUE(loaded_.experiment) << loaded_.diagnostics;
  }
  const Experiment& experiment() const { return *loaded_.experiment; }
  Loaded loaded_;
};

TEST_F(Figure7, StatesItsWorld) {
  EXPECT_EQ(experiment().world, "SimpleWorld");
  EXPECT_EQ(experiment().gravity, (Vector3d{0., 0., -9.81}));
  EXPECT_EQ(experiment().deltat, 0.001);
  EXPECT_EQ(experiment().engine, "dts");
  EXPECT_EQ(experiment().contact, "hookpoint");
  EXPECT_EQ(experiment().integrator, "semi_implicit_euler");
  EXPECT_FALSE(experiment().terrain);
  EXPECT_EQ(
      body_trails(experiment()),
      (std::vector<std::string>{"simplebot.base", "simplebot.leg1.link1", "simplebot.leg1.link2"}));
}

// dconstant of joint 1 by its slider: at 900 the arm is calm and from 1200 on it is not, with a step of 1 ms.
TEST_F(Figure7, NamesTheGainsWithWhichItFails) {
  Running run(loaded_);
  *run.port("controllers.dconstant.value").writable = 30000.;
  *run.port("controllers.goal_angle.value").writable = 1.;
  simulation::StepStatus status;
  for (int step = 0; step < 10000 && status.ok(); ++step) status = run.world().step();
  ASSERT_FALSE(status.ok());
  const std::string said = simulation::failure_text(status);
  EXPECT_NE(said.find("above the largest stable step"), std::string::npos) << said;
  EXPECT_NE(said.find("pd1"), std::string::npos) << said;
  EXPECT_EQ(said.find("ground"), std::string::npos) << said;
}

TEST_F(Figure7, StatesItsArm) {
  const RobotSpec& robot = experiment().robots.at(0);
  EXPECT_FALSE(robot.mobile);
  EXPECT_EQ(std::get<Box>(robot.base.shapes.at(0).geometry).dimensions, (Vector3d{1., 1., 0.3}));
  const ChainSpec& leg = robot.chains.at(0);
  EXPECT_EQ(leg.hip_distance, Vector3d{});
  EXPECT_EQ(leg.hip_orientation, Quaterniond{});
  const LinkSpec& link1 = leg.links.at(0);
  EXPECT_EQ(link1.a, 0.);
  EXPECT_EQ(link1.alpha, 1.57);  // literally, not pi/2
  EXPECT_EQ(link1.d, 0.15);
  const LinkSpec& link2 = leg.links.at(1);
  EXPECT_EQ(link2.a, 0.1);
  EXPECT_EQ(link2.alpha, -1.57);
  EXPECT_EQ(link2.d, 0.4);
  EXPECT_EQ(link2.joint, JointKind::revolute);
  EXPECT_EQ(link2.angle, 0.);
}

// A truncated cone of radii R, r and length L: centre of mass L (R^2 + 2 R r + 3 r^2) / (4 (R^2 + R
// r + r^2)) from the face R; axial moment 3 m (R^5 - r^5) / (10 (R^3 - r^3)).
TEST_F(Figure7, HasTheMassOfItsCones) {
  const MassSpec& mass = experiment().robots[0].chains[0].links[0].body.mass;
  const double R = 0.15, r = 0.1, L = 1.;
  EXPECT_EQ(mass.mass, 1.);
  EXPECT_NEAR(mass.center_of_mass.x,
              L * (R * R + 2 * R * r + 3 * r * r) / (4 * (R * R + R * r + r * r)), 1e-14);
  EXPECT_NEAR(mass.center_of_mass.y, 0., 1e-15);
  EXPECT_NEAR(mass.inertia.xx,
              0.3 * (std::pow(R, 5) - std::pow(r, 5)) / (std::pow(R, 3) - std::pow(r, 3)), 1e-14);
}

// A port whose own name holds a dot is reached like any other.
TEST(LoadPorts, AWireMayReadAContactForce) {
  const Loaded loaded = load_text(
      "World w { Robot b { Base.mobile { mass = 1; Shape.Sphere radius = 1; } } }"
      "Controller.PD p { Wire FROM w.b.base.contact.force.z TO current; Wire FROM w.b.position.x "
      "TO rate_in; }");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint
