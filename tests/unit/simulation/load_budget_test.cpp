// What an experiment may ask for beyond the language's own account: points and samples in memory.
#include <gtest/gtest.h>

#include "studies/blocks/written_values.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

std::string block(const std::string& name, const std::string& points) {
  return "  Robot " + name + " { Base.mobile { mass = 1; Shape.Box { dimensions = 1,1,1; " +
         points + " } } }\n";
}

TEST(LoadBudget, BoundaryPointsOfAllBodiesAreCounted) {
  // A box has 6 n^2 + 2 of them.
  const Loaded one = load_text("World w {\n" + block("a", "boundary_points = 500;") + "}");
  ASSERT_TRUE(one.experiment) << one.diagnostics;
  EXPECT_EQ(one.experiment->robots[0].base.boundary_points.size(), 1'500'002U);
  std::string text = "World w {\n";
  for (const std::string name : {"a", "b", "c", "d"}) text += block(name, "boundary_points = 500;");
  const Loaded many = load_text(text + "}");
  EXPECT_FALSE(many.experiment);
  EXPECT_EQ(many.diagnostics,
            "error 3:87 with this shape the bodies require 3e+06 boundary points, more than the "
            "2000000 allowed: make `boundary_points` smaller\n");
}

TEST(LoadBudget, SamplesUnderWayInAllWiresAreCounted) {
  std::string text = "World w {\n  deltat = 1 ms;\n" + block("a", "") + "}\n";
  for (int i = 0; i < 4; ++i)
    text += "Gain g" + std::to_string(i) +
            " { Wire FROM w.a.base.location.x TO input { delay = 9999 s; } }\n";
  const Loaded loaded = load_text(text);
  EXPECT_FALSE(loaded.experiment);
  EXPECT_EQ(
      loaded.diagnostics,
      "error 7:11 with this one the wires require 2.9997e+07 samples under way, more than the "
      "20000000 allowed: shorten the delays or lower the rates\n");
}

TEST(LoadBudget, ValuesOfASweepAreCountedBeforeTheyAreMade) {
  EXPECT_EQ(studies::stepped_count(0., 1., 0.25), 5.);
  EXPECT_EQ(studies::stepped(0., 1., 0.25), (std::vector<double>{0., 0.25, 0.5, 0.75, 1.}));
  EXPECT_NEAR(studies::stepped_count(0., 1., 1e-12), 1e12, 2.);
  EXPECT_GT(studies::stepped_count(-1e308, 1e308, 1e-308), 1e300);
}

}  // namespace
}  // namespace hookpoint
