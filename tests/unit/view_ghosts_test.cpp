// What a file steps beside its run.
#include <gtest/gtest.h>

#include "tests/support/shown_text.h"
#include "view/ghosts.h"

namespace hookpoint {
namespace {

using Settings = std::vector<std::string>;

TEST(Ghosts, AreWhatTheFileNames) {
  Shown shown(std::filesystem::path(HOOKPOINT_SOURCE_DIR) /
              "configs/views/creep_side_by_side.hook");
  const auto ghosts = view::load_ghosts(shown.root());
  ASSERT_EQ(ghosts.size(), 4u);
  EXPECT_EQ(ghosts[0].name, "mujoco");
  EXPECT_EQ(ghosts[0].label, "MuJoCo");
  EXPECT_EQ(ghosts[0].settings, (Settings{"world.engine=mujoco", "world.settings=recommended"}));
  EXPECT_EQ(ghosts[2].settings, (Settings{"world.engine=ode_quickstep", "world.settings=default"}));
  EXPECT_EQ(ghosts[3].settings, Settings{"world.contact=impulse"});
}

// The settings are such as the file takes: the ghost's experiment is what it says.
TEST(Ghosts, VaryTheirWorld) {
  ShownText shown("World w { } Ghost other { contact = nominal; integrator = rk4; }");
  const auto ghosts = view::load_ghosts(shown->root());
  ASSERT_EQ(ghosts.size(), 1u);
  EXPECT_EQ(ghosts[0].label, "other");
  EXPECT_EQ(ghosts[0].settings, (Settings{"w.contact=nominal", "w.integrator=rk4"}));
}

}  // namespace
}  // namespace hookpoint
