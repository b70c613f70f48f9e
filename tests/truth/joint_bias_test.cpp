// What gravity and velocities take of joints, as ports: a two-link arm's closed form, and the
// terms for controllers, which are checked against the mass matrix written out.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/engines.h"
#include "simulation/analysis/controller_terms.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81;

TEST(JointBias, IsThatOfTheTwoLinkArm) {
  const double m1 = 1.3, m2 = 0.7, l1 = 0.4, c1 = 0.15, c2 = 0.2;
  const double q1 = 0.3, q2 = -0.8, w1 = 1.1, w2 = -2.3;
  Running run(
      "World w { gravity = 9.81; Robot arm { Base.fixed; Chain c { Link upper { dhtwist = 90 deg; "
      "angle = 0.3; rate = 1.1; mass = 1.3; center_of_mass = 0.15, 0, 0; inertia = 0.01, 0.02, "
      "0.03, 0, 0, 0; } Link fore { dhlength = 0.4; angle = -0.8; rate = -2.3; mass = 0.7; "
      "center_of_mass = 0.2, 0, 0; inertia = 0.01, 0.02, 0.03, 0, 0, 0; } } } }");
  const double gravity2 = m2 * c2 * g * std::cos(q1 + q2);
  const double gravity1 = (m1 * c1 + m2 * l1) * g * std::cos(q1) + gravity2;
  const double coupling = m2 * l1 * c2 * std::sin(q2);
  EXPECT_NEAR(run["w.arm.c.upper.gravity_torque"], gravity1, 1e-12);
  EXPECT_NEAR(run["w.arm.c.fore.gravity_torque"], gravity2, 1e-12);
  EXPECT_NEAR(run["w.arm.c.upper.bias_torque"], gravity1 - coupling * (2. * w1 * w2 + w2 * w2),
              1e-12);
  EXPECT_NEAR(run["w.arm.c.fore.bias_torque"], gravity2 + coupling * w1 * w1, 1e-12);
}

/// Two robots that tumble: revolute and prismatic joints, skew, on a fixed and a mobile base.
const std::string tumbling = R"(
World w {
  gravity = 1, 2, -9; deltat = 0.5 ms;
  Robot held {
    Base.fixed { location = 1, 0, 0; orientation = 0.2, 0.1, 0.3; }
    Chain a {
      hip_distance = 0.1, 0.2, 0.05; hip_orientation = 0.3, 0.5, -0.2;
      Link one { dhtwist = 0.4; angle = 0.3; rate = 1.5; mass = 0.8; center_of_mass = 0.1, 0.02, 0.03; inertia = 0.01, 0.02, 0.015, 0.001, 0, 0.002; }
      Link two { joint = prismatic; dhlength = 0.3; dhtwist = 1.1; angle = 0.1; rate = 0.7; mass = 0.5; center_of_mass = 0.05, 0, 0.1; inertia = 0.01, 0.012, 0.015, 0, 0.001, 0; }
      Link three { dhlength = 0.2; dhtwist = -0.7; angle = -0.4; rate = -2; mass = 0.4; center_of_mass = 0.1, 0.1, 0; inertia = 0.004, 0.005, 0.006, 0, 0, 0; }
    }
  }
  Robot free {
    Base.mobile { location = 0, 0, 3; velocity = 1, 2, 3; angular_velocity = 0.5, -1, 2; mass = 2; center_of_mass = 0.02, 0.01, 0; inertia = 0.1, 0.2, 0.15, 0, 0, 0; }
    Chain b { hip_distance = 0.2, 0, 0; Link one { angle = 0.5; rate = 2; mass = 0.6; center_of_mass = 0.1, 0, 0; inertia = 0.01, 0.02, 0.02, 0, 0, 0; } Link two { joint = prismatic; dhtwist = 1; rate = -1; mass = 0.3; center_of_mass = 0, 0, 0.1; inertia = 0.01, 0.01, 0.01, 0, 0, 0; } }
    Chain c { hip_distance = -0.2, 0, 0; hip_orientation = 0, 1, 0; Link one { angle = 0.5; rate = -3; mass = 0.6; center_of_mass = 0.1, 0, 0; inertia = 0.01, 0.02, 0.02, 0, 0, 0; } }
  }
}
)";

TEST(JointBias, IsTheJointsPartOfTheTermsForControllers) {
  std::vector<simulation::EngineFactory> engines{simulation::make_dts};
  for (const reference::Peer& peer : reference::peers())
    if (peer.name == std::string_view("bullet")) engines.push_back(peer.make);
  for (const simulation::EngineFactory& make : engines) {
    const Loaded loaded = load_text(tumbling);
    Running run(loaded, make);
    const simulation::Experiment& experiment = *loaded.experiment;
    for (int i = 0; i < 3; ++i) {
      run.step(100);
      for (std::size_t robot = 0; robot < experiment.robots.size(); ++robot) {
        const simulation::ControllerTerms terms(experiment, robot, run.world().state());
        const std::vector<double> h = terms.bias_forces(), rest = terms.gravity_forces();
        const auto& names = terms.coordinates();
        for (std::size_t k = 0; k < names.size(); ++k) {
          const std::string& trail = names[k].trail;
          if (!trail.ends_with(".rate") || trail.find("base") != std::string::npos) continue;
          const std::string link = "w." + trail.substr(0, trail.size() - 5);
          EXPECT_NEAR(run[link + ".bias_torque"], h[k], 1e-10 * (1. + std::abs(h[k]))) << link;
          EXPECT_NEAR(run[link + ".gravity_torque"], rest[k], 1e-10) << link;
        }
        const dts::CenterOfMass& center = terms.center_of_mass();
        const std::string name = "w." + experiment.robots[robot].name;
        EXPECT_NEAR(run[name + ".total_mass"], center.mass, 1e-12);
        Vector3d velocity;
        for (std::size_t k = 0; k < names.size(); ++k) {
          const double rate = run["w." + names[k].trail];
          const std::size_t n = names.size();
          velocity += rate * Vector3d{center.jacobian[k], center.jacobian[n + k],
                                      center.jacobian[2 * n + k]};
        }
        EXPECT_NEAR(run[name + ".center_of_mass_velocity.x"], velocity.x, 1e-10);
        EXPECT_NEAR(run[name + ".center_of_mass_velocity.y"], velocity.y, 1e-10);
        EXPECT_NEAR(run[name + ".center_of_mass_velocity.z"], velocity.z, 1e-10);
      }
    }
  }
}

TEST(JointBias, AStepWithItAllocatesNothing) {
  Running run(tumbling);
  const double* torque = run.port("w.free.b.two.bias_torque").value;
  run.step();
  const double before = *torque;
  const long allocated = testing::allocation_count();
  run.world().step();
  EXPECT_EQ(testing::allocation_count(), allocated);
  EXPECT_NE(*torque, before);
}

}  // namespace
}  // namespace hookpoint
