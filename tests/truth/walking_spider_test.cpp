// The spider of configs/scenes/walking_spider.hook does on the ground what its table of phases
// says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "tests/support/folders.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

TEST(WalkingSpider, KeepsSpeedDutyFactorAndPhasesOfItsTable) {
  Running run(load_file(std::filesystem::path(testing::source_folder()) /
                        "configs/scenes/walking_spider.hook"));
  constexpr int legs = 8, steps = 16000;  // ten periods of 0.8 s at 0.5 ms
  constexpr double period = 0.8, duty = 0.6, dt = 0.5e-3;
  std::vector<const double*> grounded;
  for (int leg = 0; leg < legs; ++leg)
    grounded.push_back(run.port("on_ground[" + std::to_string(leg) + "].output").value);
  run.step(8000);
  const double begin = run["world.spider.position.x"];
  std::vector<double> share(legs), cosine(legs), sine(legs);
  for (int k = 0; k < steps; ++k) {
    run.step();
    const double angle = 2. * std::numbers::pi * (4. + (k + 1) * dt) / period;
    for (int leg = 0; leg < legs; ++leg) {
      share[leg] += *grounded[leg] / steps;
      cosine[leg] += *grounded[leg] * std::cos(angle) / steps;
      sine[leg] += *grounded[leg] * std::sin(angle) / steps;
    }
  }
  EXPECT_NEAR((run["world.spider.position.x"] - begin) / 8., 0.08, 0.03 * 0.08);
  for (int leg = 0; leg < legs; ++leg) {
    // Ground and joints that give way keep the foot down a little longer (see the scene).
    EXPECT_NEAR(share[leg], duty, 0.05) << leg;
    const double table = (leg % 4 + leg / 4) % 2 == 0 ? 0. : 0.5;
    const double middle = 0.5 / period - duty / 2. + table;  // of the stance, in periods
    const double phase = std::atan2(sine[leg], cosine[leg]) / (2. * std::numbers::pi) - middle;
    EXPECT_NEAR(phase - std::round(phase), 0., 0.004) << leg;
  }
}

}  // namespace
}  // namespace hookpoint
