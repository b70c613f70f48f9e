// The threshold of slip of a box that is pulled ever harder, against its closed form: laws whose
// friction falls at break-away, engines with one coefficient, pulls above the ground. 1 kg, 0.2 x
// 0.2 x 0.1 m; the numbers are worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

constexpr double m = 1., g = 9.81, onset_speed = 1e-3;

struct Onset {
  std::optional<double> measured, predicted;
  std::string terminal;
};

/// What `subject` makes of a pull that grows from 0 by 2 N/s, `point` from the middle of the box.
Onset onset_of(const std::string& subject, double mu_s, double mu_k,
               const std::string& point = "0, 0, 0", const std::string& more = "") {
  const testing::Workplace work;
  work.file(
      "box.hook",
      "World w { gravity = 9.81; deltat = 0.2 ms; duration = 5 s; Material m { "
      "kinetic_friction = " +
          std::to_string(mu_k) + "; static_friction = " + std::to_string(mu_s) +
          "; } Terrain.Flat ground { material = m; } Robot b { Base.mobile { rest_on = ground; "
          "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } } Force pull { body = "
          "b.base; point = " +
          point +
          "; } Signal.Ramp r { initial = 0; final = 10; duration = 5 s; Wire TO pull.force.x; } }");
  work.file("study.hook",
            "Study s { scene = \"box.hook\"; duration = 5 s; " + more +
                " Measure slip_onset; Truth slip_onset { equals = predicted; within = "
                "0.1 deg; } Subject one { " +
                subject + " } }");
  const auto result = work.hookpoint("study study.hook --jobs 1 --out out");
  std::istringstream table(work.read("out/results.csv"));
  std::string header, row, title, text;
  std::getline(table, header);
  std::getline(table, row);
  Onset onset;
  std::istringstream titles(header), texts(row);
  while (std::getline(titles, title, ',') && std::getline(texts, text, ',')) {
    if (text.empty()) continue;
    if (title == "slip_onset [rad]") onset.measured = std::stod(text);
    if (title == "slip_onset_predicted [rad]") onset.predicted = std::stod(text);
  }
  onset.terminal = result.out + result.err;
  return onset;
}

/// Where a block that slips from `force` [N] reaches 1 mm/s, friction being mu_k from there on:
/// (force - mu_k m g) t + rate t^2/2 = m v.
double angle_of(double force, double mu_k) {
  constexpr double rate = 2.;
  const double left = force - mu_k * m * g;
  const double t = (-left + std::sqrt(left * left + 2. * rate * m * onset_speed)) / rate;
  return std::atan((force + rate * t) / (m * g));
}

TEST(SlipOnset, OfAnEngineWithOneCoefficientIsTheKineticOnes) {
  const double expected = angle_of(0.3 * m * g, 0.3);  // 0.2974
  for (const std::string engine : {"ode", "bullet"}) {
    const Onset onset = onset_of("engine = " + engine + ";", 0.6, 0.3);
    ASSERT_TRUE(onset.predicted && onset.measured) << onset.terminal;
    EXPECT_NEAR(*onset.predicted, expected, 2e-4) << engine;
    EXPECT_NEAR(*onset.measured, *onset.predicted, 2e-3) << engine;
  }
}

TEST(SlipOnset, OfEqualLoadsIsAtStaticFriction) {
  const double expected = angle_of(0.6 * m * g, 0.3);
  const Onset onset = onset_of("contact = hookpoint;", 0.6, 0.3, "0, 0, -0.05");
  ASSERT_TRUE(onset.predicted && onset.measured) << onset.terminal;
  EXPECT_NEAR(*onset.predicted, expected, 1e-4);
  EXPECT_NEAR(*onset.measured, *onset.predicted, 1e-3);
}

// A pull 0.05 m above the ground: N = m g/4 -+ F 0.05/0.4 behind and before. Without a fall of
// friction the sum counts.
TEST(SlipOnset, OfUnequalLoadsIsTheSameWhereFrictionDoesNotFall) {
  for (const std::string law : {"hookpoint", "azad_featherstone", "lugre"}) {
    const Onset onset = onset_of("contact = " + law + ";", 0.5, 0.5);
    ASSERT_TRUE(onset.predicted && onset.measured) << law << onset.terminal;
    EXPECT_NEAR(*onset.predicted, angle_of(0.5 * m * g, 0.5), 2e-4) << law;
    EXPECT_NEAR(*onset.measured, *onset.predicted, 5e-3) << law;
  }
}

// The two behind break at F/4 = mu_s (m g/4 - F/8), F = 4.528 N. With mu_k = 0.1 those before would
// have to carry 2.075 N each of 1.811 N: all slip.
TEST(SlipOnset, OfAnAvalancheIsWhereTheFirstBreaks) {
  const double force = 0.6 * m * g / (1. + 0.6 / 2.);
  const Onset onset = onset_of("contact = hookpoint;", 0.6, 0.1);
  ASSERT_TRUE(onset.predicted && onset.measured) << onset.terminal;
  EXPECT_NEAR(*onset.predicted, angle_of(force, 0.1), 2e-4);
  EXPECT_NEAR(*onset.measured, *onset.predicted, 2e-3);
}

// With mu_k = 0.3 they would carry 1.698 N each: they hold, and break later.
TEST(SlipOnset, HasNoClosedFormWhereOnlySomeBreak) {
  const Onset onset = onset_of("contact = hookpoint;", 0.6, 0.3);
  EXPECT_FALSE(onset.predicted);
  EXPECT_TRUE(onset.measured);
  EXPECT_GT(*onset.measured, std::atan(4.528 / (m * g)) + 0.01) << "later than the first";
  EXPECT_NE(onset.terminal.find("break away one after the other"), std::string::npos)
      << onset.terminal;
}

TEST(SlipOnset, HasNoClosedFormWhereThePullTipsOrTurnsTheBox) {
  // mu 2 needs F = 19.6 N; at 0.1 m over the ground the box tips at m g = 9.81 N.
  const Onset tips = onset_of("contact = hookpoint;", 2., 2., "0, 0, 0.05");
  EXPECT_FALSE(tips.predicted);
  EXPECT_NE(tips.terminal.find("tips"), std::string::npos) << tips.terminal;
  const Onset turns = onset_of("contact = hookpoint;", 0.5, 0.5, "0, 0.05, -0.05");
  EXPECT_FALSE(turns.predicted);
  EXPECT_NE(turns.terminal.find("turns the body"), std::string::npos) << turns.terminal;
}

// What slides at `settle` already has its onset there.
TEST(SlipOnset, IsSeenFromSettleOn) {
  const Onset onset = onset_of("contact = hookpoint;", 0.3, 0.3, "0, 0, -0.05", "settle = 2 s;");
  ASSERT_TRUE(onset.predicted && onset.measured) << onset.terminal;
  EXPECT_NEAR(*onset.measured, std::atan(4. / (m * g)), 1e-6);  // 2 N/s for 2 s
  EXPECT_NEAR(*onset.predicted, *onset.measured, 1e-9);
}

// An engine whose friction yields in proportion to its force reaches 1 mm/s within the cone.
TEST(SlipOnset, OfAnEngineThatCreepsIsWhereItIsFast) {
  const Onset onset = onset_of("engine = ode; settings = matched;", 0.6, 0.6, "0, 0, -0.05");
  ASSERT_TRUE(onset.measured) << onset.terminal;
  ASSERT_TRUE(onset.predicted) << onset.terminal;
  EXPECT_NEAR(*onset.measured, *onset.predicted, 2e-3);
}

}  // namespace
}  // namespace hookpoint
