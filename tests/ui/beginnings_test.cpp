// The first minutes: the program without arguments, and the files that `new` writes.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::has;
using testing::Workplace;

/// The second column of a record, which follows the time.
std::vector<double> second_column(const std::string& csv) {
  std::vector<double> values;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t comma = line.find(',');
    values.push_back(std::stod(line.substr(comma + 1)));
  }
  return values;
}

TEST(Beginnings, TheProgramAloneSaysHowToBegin) {
  const CommandResult said = Workplace().hookpoint("");
  EXPECT_EQ(said.status, 0);
  EXPECT_TRUE(has(said.out, "hookpoint new robot")) << said.out;
  EXPECT_TRUE(has(said.out, "hookpoint --help")) << said.out;
}

TEST(Beginnings, ANewRobotStands) {
  const Workplace place;
  const CommandResult written = place.hookpoint("new robot walker");
  ASSERT_EQ(written.status, 0) << written.err;
  EXPECT_TRUE(has(written.out, "hookpoint view walker.hook")) << written.out;
  const CommandResult checked = place.hookpoint("check walker.hook");
  EXPECT_EQ(checked.status, 0);
  EXPECT_EQ(checked.out, "walker.hook: fine\n") << checked.err;
  ASSERT_EQ(place.hookpoint("run walker.hook --out run").status, 0);
  const std::vector<double> heights = second_column(place.read("run/motion.csv"));
  ASSERT_GT(heights.size(), 100u);
  // Two links of 20 cm, bent by 35 deg: 0.328 m.
  EXPECT_NEAR(heights.back(), 2 * 0.2 * 0.819152, 0.01);
  EXPECT_FALSE(has(place.read("walker.hook"), "starter"));
}

TEST(Beginnings, ANewControllerHops) {
  const Workplace place;
  ASSERT_EQ(place.hookpoint("new controller thrust").status, 0);
  ASSERT_EQ(place.hookpoint("run thrust.hook --out run").status, 0);
  const std::vector<double> heights = second_column(place.read("run/motion.csv"));
  int hops = 0;
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
    hops += heights[i] > 0.55 && heights[i] >= heights[i - 1] && heights[i] > heights[i + 1];
  EXPECT_GE(hops, 5);  // 0.5 m is where its foot leaves the ground
}

TEST(Beginnings, ANewStudyHasAReport) {
  const Workplace place;
  ASSERT_EQ(place.hookpoint("new study who_creeps").status, 0);
  const CommandResult ran = place.hookpoint("study who_creeps.hook --quick --out out");
  EXPECT_TRUE(ran.status == 0 || ran.status == 3) << ran.err;  // 3: without an engine of it
  EXPECT_TRUE(has(place.read("out/report.html"), "Creep of a block on a slope"));
}

TEST(Beginnings, AWrongNameWritesNothing) {
  const Workplace place;
  for (const std::string name : {"2legs", "'a b'", "../walker", "a.b", "''"}) {
    const CommandResult refused = place.hookpoint("new robot " + name);
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_FALSE(refused.err.empty()) << name;
  }
  for (const std::string name : {"For", "Let"}) {
    const CommandResult refused = place.hookpoint("new robot " + name);
    EXPECT_EQ(refused.status, 2) << name << refused.out;
  }
  EXPECT_EQ(place.entries(), 0u);
}

TEST(Beginnings, WhatIsThereStays) {
  const Workplace place;
  place.file("walker.hook", "mine");
  const CommandResult refused = place.hookpoint("new robot walker");
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(has(refused.err, "walker.hook is there already")) << refused.err;
  EXPECT_EQ(place.read("walker.hook"), "mine");
}

}  // namespace
}  // namespace hookpoint
