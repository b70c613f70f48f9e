// Bodies that pass through an obstacle are reported once, and those that go around it are not.
#include "simulation/run/passage_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

struct Passage {
  std::string found;
  double end = 0.;  ///< of the body along its way [m]
};

Passage passage(const std::string& text, const char* position, int steps) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  Running running(loaded);
  simulation::PassageWatch watch(*loaded.experiment, running.world());
  for (int i = 0; i < steps; ++i) {
    running.step();
    watch.observe();
  }
  return {watch.finding(), running[position]};
}

/// A box of 1 kg that falls 5 m onto a shelf.
Passage falls(const std::string& thickness) {
  return passage(
      "World w { gravity = 9.81; deltat = 1 ms; Material m { normal_stiffness = 10 kN/m; normal_damping = "
      "60; } Obstacle.Box shelf { dimensions = 2, 2, " +
          thickness +
          "; material = m; } Robot b { Base.mobile { location = 0, 0, 5.05; Shape.Box { dimensions = 0.1, "
          "0.1, 0.1; mass = 1; } } } }",
      "b.position.z", 1600);
}

// It arrives with v = 9.9 m/s, and four corners with k = 10 kN/m stop it within v sqrt(m/(4 k)) = 50 mm.
TEST(PassageWatch, TellsOfAShelfThatIsThinnerThanTheFallPenetrates) {
  const Passage thin = falls("0.004");
  EXPECT_LT(thin.end, -0.1);
  for (const char* part : {"'b.base' passed through Obstacle 'shelf'", "0.004 m thick"})
    EXPECT_NE(thin.found.find(part), std::string::npos) << thin.found;
  const Passage thick = falls("0.4");
  EXPECT_GT(thick.end, 0.2);
  EXPECT_EQ(thick.found, "");
}

/// A ball of 10 mm thrown along x at a plate in the plane of y and z, beside its edge at y = 0.5 m.
Passage thrown(double speed, double beside) {
  return passage(
      "World w { gravity = 0; deltat = 1 ms; Material m { normal_stiffness = 1e6; normal_damping = 0; } "
      "Obstacle.Box plate { dimensions = 0.002, 1, 1; location = 0.3, 0, 0; material = m; } Robot b { "
      "Base.mobile { location = 0, " +
          std::to_string(beside) + ", 0; velocity = " + std::to_string(speed) +
          ", 0, 0; Shape.Sphere { radius = 0.01; mass = 0.5; } } } }",
      "b.position.x", 200);
}

// 50 mm a step carry a ball of 20 mm over a plate of 2 mm.
TEST(PassageWatch, TellsOfABallThatPassesAPlateInOneStep) {
  const Passage fast = thrown(50., 0.);
  EXPECT_GT(fast.end, 1.);
  EXPECT_NE(fast.found.find("passed through Obstacle 'plate'"), std::string::npos) << fast.found;
  EXPECT_EQ(thrown(50., 0.55).found, "");  // it flies past the edge
  EXPECT_EQ(thrown(0.5, 0.).found, "");    // it comes back
}

}  // namespace
}  // namespace hookpoint
