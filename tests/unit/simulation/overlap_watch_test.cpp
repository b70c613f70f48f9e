// Bodies that pass through each other are told once, with what would make them touch.
#include "simulation/run/overlap_watch.h"

#include <gtest/gtest.h>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

std::string finding(const std::string& text, int steps) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  Running running(loaded);
  simulation::OverlapWatch watch(*loaded.experiment, running.world());
  for (int i = 0; i < steps; ++i) {
    running.step();
    watch.observe();
  }
  return watch.finding();
}

/// A box falls onto another; 0.5 m take 0.32 s.
std::string falling(const std::string& fields) {
  return "World w { deltat = 1 ms; " + fields +
         " Terrain.Flat f { } Robot below { Base.mobile { rest_on = f; Shape.Box { dimensions = 0.4, "
         "0.4, 0.2; mass = 1; } } } Robot above { Base.mobile { location = 0, 0, 0.75; Shape.Box { "
         "dimensions = 0.1, 0.1, 0.1; mass = 1; } } } }";
}

TEST(OverlapWatch, TellsOfRobotsThatNothingMakesTouch) {
  const std::string found = finding(falling("touch = points;"), 1000);
  EXPECT_NE(found.find("'below.base' and 'above.base' overlap"), std::string::npos) << found;
  EXPECT_NE(found.find("touch = shapes"), std::string::npos) << found;
  EXPECT_EQ(finding(falling("touch = points;"), 250), "");  // not yet
  EXPECT_EQ(finding(falling("touch = shapes;"), 1000), "");
}

/// Two legs of 0.4 m on hips 0.3 m apart that turn towards each other about vertical axes.
std::string legs(const std::string& fields, double from) {
  const auto leg = [&](const char* name, double y, double angle, double rate, const char* height) {
    return std::string("Chain ") + name + " { hip_distance = 0, " + std::to_string(y) +
           ", 0; Link one { angle = " + std::to_string(angle) + "; rate = " + std::to_string(rate) +
           "; Shape.Box { dimensions = 0.4, 0.05, " + height +
           "; location = 0.2, 0, 0; mass = 1; } } } ";
  };
  return "World w { deltat = 1 ms; gravity = 0; touch = shapes; Robot spider { " + fields +
         " Base.fixed; " + leg("left", 0.15, -from, -0.2, "0.05") +
         leg("right", -0.15, from, 0.2, "0.06") + "} }";
}

TEST(OverlapWatch, TellsOfLegsThatCross) {
  const std::string found = finding(legs("", 0.2), 1500);
  EXPECT_NE(found.find("'spider.left.one' and 'spider.right.one' overlap"), std::string::npos)
      << found;
  EXPECT_NE(found.find("self_contact = true"), std::string::npos) << found;
  EXPECT_EQ(finding(legs("self_contact = true;", 0.2), 1500), "");
  // Legs that are built crossed are meant.
  EXPECT_EQ(finding(legs("", 0.36), 100), "");
}

}  // namespace
}  // namespace hookpoint
