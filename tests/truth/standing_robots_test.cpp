// Quadruped and biped stand: they sag by little, stay upright, come to rest, and the ground bears
// their weight.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/folders.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

struct Robot {
  const char* scene;
  const char* name;
  double mass;
  std::vector<std::string> feet;  ///< trails from the robot
};

void expect_standing(const Robot& robot) {
  Running run(
      load_file(std::filesystem::path(testing::source_folder()) / "configs/scenes" / robot.scene));
  const std::string name = robot.name;
  const double height = run[name + ".position.z"];
  run.step(24000);  // 6 s
  EXPECT_NEAR(run[name + ".position.z"], height, 0.02);
  const double w = run[name + ".orientation.w"];
  EXPECT_GT(w, std::cos(1. / 57.3)) << "leans by more than 2 deg";
  for (const char* part : {"x", "y", "z"}) {
    EXPECT_NEAR(run[name + ".velocity." + part], 0., 1e-3);
    EXPECT_NEAR(run[name + ".angular_velocity." + part], 0., 2e-3);
  }
  double borne = 0.;
  for (const std::string& foot : robot.feet) {
    const double force = run[name + "." + foot + ".contact.force.z"];
    EXPECT_GT(force, 0.1 * robot.mass * 9.81) << foot;
    EXPECT_GE(run[name + "." + foot + ".contact.count"], 1.) << foot;
    borne += force;
  }
  EXPECT_NEAR(borne, robot.mass * 9.81, 1e-3 * robot.mass * 9.81);
}

TEST(Standing, TheQuadruped) {
  expect_standing({"standing_quadruped.hook",
                   "quadruped",
                   6. + 4 * 1.5,
                   {"leg[0].shank", "leg[1].shank", "leg[2].shank", "leg[3].shank"}});
}

TEST(Standing, TheBiped) {
  expect_standing({"standing_biped.hook", "biped", 15. + 2 * 9.0, {"leg[0].foot", "leg[1].foot"}});
}

}  // namespace
}  // namespace hookpoint
