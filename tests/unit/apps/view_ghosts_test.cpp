// What a file steps beside its run.
#include <gtest/gtest.h>

#include "apps/view/widgets/ghosts.h"
#include "tests/support/folders.h"
#include "tests/support/shown_text.h"

namespace hookpoint {
namespace {

using Settings = std::vector<std::string>;

TEST(Ghosts, AreWhatTheFileNames) {
  Shown shown(std::filesystem::path(testing::source_folder()) /
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

// Params of its own, as --set takes them: numbers with a unit of their dimension.
TEST(Ghosts, FixParams) {
  ShownText shown(
      R"(Param mu = 0.8; Param stiffness = 20 kN/m; Param ground = "clay.hook"; World w { }
      Ghost slippery { engine = ode; Fix mu { value = 0.1; } Fix stiffness { value = 5 kN/m; } }
      Ghost sandy { Fix ground { value = "sand.hook"; } })");
  const auto ghosts = view::load_ghosts(shown->root());
  ASSERT_EQ(ghosts.size(), 2u);
  EXPECT_EQ(ghosts[0].settings, (Settings{"w.engine=ode", "mu=0.1", "stiffness=5000 kg/s^2"}));
  EXPECT_EQ(ghosts[1].settings, Settings{"ground=\"sand.hook\""});
}

TEST(Ghosts, FixParamsThatThereAre) {
  ShownText shown(R"(Param mu = 0.8; Param ground = "clay.hook"; World w { }
Ghost a { Fix nu { value = 0.1; } }
Ghost b { Fix mu { value = 0.1; } Fix ground { value = "sand.hook"; } })");
  view::check_ghosts(shown->root(), shown->diagnostics());
  EXPECT_EQ(shown->told(),
            "2:11 the file has no Param `nu` that is a number; did you mean `mu`?\n");
}

TEST(Ghosts, HaveColoursOfTheirOwn) {
  ShownText shown(
      "World w { } Ghost red { engine = ode; colour = 1, 0, 0.2; } Ghost any { engine = ode; }");
  const auto ghosts = view::load_ghosts(shown->root());
  ASSERT_EQ(ghosts.size(), 2u);
  EXPECT_EQ(ghosts[0].colour, "#FF0033");
  EXPECT_EQ(ghosts[0].settings, Settings{"w.engine=ode"});
  EXPECT_EQ(ghosts[1].colour, "");
}

// One that changes nothing is the run itself.
TEST(Ghosts, MayNameTheRun) {
  ShownText shown("World w { } Ghost run { label = \"measured\"; colour = 0, 0, 0; }");
  const auto ghosts = view::load_ghosts(shown->root());
  ASSERT_EQ(ghosts.size(), 1u);
  EXPECT_EQ(ghosts[0].label, "measured");
  EXPECT_EQ(ghosts[0].colour, "#000000");
  EXPECT_TRUE(ghosts[0].settings.empty());
}

}  // namespace
}  // namespace hookpoint
