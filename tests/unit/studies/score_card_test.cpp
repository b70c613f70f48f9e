// A Wall that compares: the card's cells, and where our laws lose.
#include "studies/compare/score_card.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace hookpoint {
namespace {

using studies::WallCell;
using studies::WallLine;
using studies::WallResult;

WallCell cell(std::optional<double> decades, bool ok, const std::string& status = "ok") {
  WallCell made;
  made.status = status;
  made.ok = ok;
  made.decades = decades;
  if (decades) made.measured = 1.;
  return made;
}

/// Two laws of ours and two other engines, in two scenes.
WallResult wall() {
  WallResult made;
  made.score_card = true;
  made.subjects = {{"lugre", "dts", "lugre", "rk4", "", true},
                   {"impulse", "dts", "impulse", "rk4", "", true},
                   {"bullet_default", "bullet", "", "", "default", true},
                   {"mujoco_default", "mujoco", "", "", "default", true}};
  made.scenes = {{"creep", "creeps", "creep.hook", 0.1, "Newton's tests"},
                 {"rebound", "rebounds", "rebound.hook"}};
  WallLine creep;
  creep.name = "creep";
  creep.scale = 10.;
  creep.cells = {cell(-9., true), cell(-1.04, false), cell(-4., false), cell(-2.2, false)};
  WallLine rebound;
  rebound.scene = 1;
  rebound.name = "height";
  rebound.scale = 1.;
  rebound.cells = {cell(-0.6, false), cell({}, false, "not_finite at 0.1 s"), cell(-1.5, false),
                   cell({}, false, "refused: no restitution")};
  made.lines = {creep, rebound};
  return made;
}

TEST(ScoreCard, HasARowATruthAndAColumnASubject) {
  const output::HeatMap card = score_card(wall());
  EXPECT_EQ(card.y.names, (std::vector<std::string>{"rebound height", "creep"})) << "from below";
  EXPECT_EQ(card.x.names, (std::vector<std::string>{"Newton's tests", "lugre", "impulse",
                                                    "bullet_default", "mujoco_default"}));
  ASSERT_EQ(card.panels.size(), 1u);
  const auto& cells = card.panels[0].cells;
  ASSERT_EQ(cells.size(), 10u);
  EXPECT_NEAR(*cells[5].value, -2., 1e-12) << "0.1 of 10";
  EXPECT_NEAR(*cells[7].value, -1., 1e-12) << "tenths of a decade";
  EXPECT_FALSE(cells[0].run) << "nobody accepts anything of the rebound";
  EXPECT_TRUE(cells[2].run) << "a run that ended early is a cross";
  EXPECT_FALSE(cells[2].value);
  EXPECT_FALSE(cells[4].run) << "a scene that an engine does not take";
}

// A law loses where it does not meet the truth and another engine is more than a decade nearer.
TEST(ScoreCard, SaysWhereOurLawsLose) {
  const WallResult result = wall();
  const auto lost = losses(result);
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0].other, "bullet_default");
  ASSERT_EQ(lost[0].ours.size(), 1u) << "lugre meets it";
  EXPECT_EQ(lost[0].ours[0].first, "impulse");
  ASSERT_EQ(lost[1].ours.size(), 1u) << "lugre is less than a decade further";
  EXPECT_EQ(lost[1].ours[0].first, "impulse");
  EXPECT_EQ(lost[1].ours[0].second, std::nullopt);
}

// A comparison has no failure: what does not hold is what it found.
TEST(ScoreCard, FindingsAreNoFailures) {
  WallResult result = wall();
  EXPECT_TRUE(result.holds());
  result.score_card = false;
  EXPECT_FALSE(result.holds());
}

}  // namespace
}  // namespace hookpoint
