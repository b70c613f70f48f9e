// What trails, vectors and globs name.
#include "simulation/wiring/port_search.h"

#include <gtest/gtest.h>

namespace hookpoint::simulation {
namespace {

TEST(Glob, FitsWithinNamesAndAcross) {
  EXPECT_TRUE(glob_fits("w.*.x", "w.ball.x"));
  EXPECT_TRUE(glob_fits(std::string(1000, '*'), "w.ball.x"));
  EXPECT_FALSE(glob_fits(std::string(1001, '*'), "w.ball.x")) << "longer than any trail";
  EXPECT_FALSE(glob_fits("w.*.x", "w.ball.base.x")) << "a star stays within a name";
  EXPECT_TRUE(glob_fits("w.**.x", "w.ball.base.x"));
  EXPECT_TRUE(glob_fits("**", "w.ball.base.x"));
  EXPECT_TRUE(glob_fits("leg[?].*", "leg[3].angle"));
  EXPECT_FALSE(glob_fits("leg[?].*", "leg[13].angle"));
  EXPECT_FALSE(glob_fits("a?b", "a.b"));
  EXPECT_TRUE(glob_fits("a*b*c", "aXbXbc"));
  EXPECT_FALSE(glob_fits("a*", "b"));
  EXPECT_TRUE(glob_fits("*", ""));
  EXPECT_FALSE(glob_fits("?", ""));
  // Found at once, though a search that tries all ways would not end.
  EXPECT_FALSE(glob_fits("**a**a**a**a**a**a**a**a**a**a**b", std::string(2000, 'a')));
}

TEST(Glob, ElementsHaveWholes) {
  EXPECT_EQ(whole_of("block.base.location.x"), "block.base.location");
  EXPECT_EQ(whole_of("block.base.orientation.w"), "block.base.orientation");
  EXPECT_EQ(whole_of("sum.in[7]"), "sum.in");
  EXPECT_EQ(whole_of("w.time"), "");
  EXPECT_EQ(whole_of("x"), "");
}

class PortSearch : public ::testing::Test {
 protected:
  PortSearch() {
    experiment.world = "w";
    for (const char* trail :
         {"w.time", "w.ball.location.x", "w.ball.location.y", "w.ball.location.z",
          "w.ball.contact.force.z", "pd.goal", "w.ball.location.x"}) {
      Port port;
      port.trail = trail;
      port.value = &values[ports.size()];
      ports.push_back(port);
    }
  }
  std::string found(const std::vector<std::string>& patterns) const {
    std::string names;
    for (const Port& port : find_all_ports(experiment, ports, patterns))
      names += (names.empty() ? "" : " ") + port.trail;
    return names;
  }
  std::string problem(const std::string& pattern) const {
    try {
      find_ports(experiment, ports, pattern);
    } catch (const ExperimentError& error) {
      return error.what();
    }
    return "";
  }

  Experiment experiment;
  double values[8] = {};
  std::vector<Port> ports;
};

TEST_F(PortSearch, NamesAreThoseUnderWhichPortsAreAskedFor) {
  EXPECT_EQ(found({"ball.location"}), "ball.location.x ball.location.y ball.location.z");
  EXPECT_EQ(found({"w.ball.location"}), "w.ball.location.x w.ball.location.y w.ball.location.z");
  EXPECT_EQ(found({"ball.*"}), "ball.location.x ball.location.y ball.location.z");
  EXPECT_EQ(found({"**.z"}), "w.ball.location.z w.ball.contact.force.z");
  EXPECT_EQ(found({"pd.*", "time"}), "pd.goal time");
  EXPECT_EQ(found({"ball.location[1]"}), "ball.location[1]");
}

TEST_F(PortSearch, OfTwoPortsOfOneTrailTheFirstCounts) {
  const auto all = find_ports(experiment, ports, "w.ball.location.*");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].value, &values[1]);
}

TEST_F(PortSearch, WhatAGlobRepeatsIsLeftOutAndWhatIsNamedTwiceIsNot) {
  EXPECT_EQ(found({"ball.location.y", "ball.location"}),
            "ball.location.y ball.location.x ball.location.z");
  EXPECT_EQ(found({"time", "time"}), "time time");
}

TEST_F(PortSearch, WhatIsNearIsNamed) {
  EXPECT_EQ(problem("ball.locatoin"),
            "there is no port `ball.locatoin`; did you mean `ball.location`?");
  EXPECT_EQ(problem("w.bal.*"), "no port fits `w.bal.*`; did you mean `w.ball.*`?");
  EXPECT_EQ(problem("bull.*.x"), "no port fits `bull.*.x`; did you mean `ball.*.x`?");
  EXPECT_EQ(problem("**.spin"), "no port fits `**.spin`; `hookpoint ports FILE` lists them");
}

}  // namespace
}  // namespace hookpoint::simulation
