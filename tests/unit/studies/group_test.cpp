// Metrics of several runs: the spread over a sweep, the distances between subjects; and warnings of
// steps that are too long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/report/report.h"
#include "studies/report/report_distances.h"
#include "studies/run/group_metrics.h"
#include "tests/support/study_runner.h"

namespace hookpoint::studies {
namespace {

TEST(Spread, IsGreatestOverLeastLessOne) {
  const std::vector<double> values{0.25, 0.2, 0.3};
  EXPECT_NEAR(*spread(values), 0.5, 1e-15);
  EXPECT_FALSE(spread(std::vector{0.2}));
  EXPECT_FALSE(spread(std::vector{0.2, 0.}));
}

TEST(PathDistance, IsTheGreatestOfTheCommonPart) {
  const std::vector<Vector3d> a{{0., 0., 0.}, {1., 0., 0.}, {2., 0., 0.}};
  const std::vector<Vector3d> b{{0., 0., 0.}, {1., 3., 4.}, {2., 0., 1.}};
  EXPECT_DOUBLE_EQ(path_distance(a, b), 5.);
  EXPECT_DOUBLE_EQ(path_distance(a, std::span(b).first(1)), 0.);
}

// The Slider moves at 2 mm/s plus 1 mm/s per radian of slope: without acceleration, so that
// friction is the tangent of the slope.
constexpr const char* grouped = R"(
Study groups {
  scene = "scene.hook";
  duration = 1 s;
  settle = 0.2 s;
  Sweep slope { values = 10 deg, 20 deg, 30 deg; }
  Sweep mu { values = 0.8, 1; }
  Measure anisotropy { over = slope; }
  Measure peer_distance;
  Subject ours { engine = dts; contact = hookpoint; }
  Subject slower { engine = ode; Only slope { to = 20 deg; } }
  Subject none { engine = bullet; }
  Truth isotropic { metric = anisotropy; below = 1.1; subjects = slower; }
}
)";

TEST_F(StudyRunner, AnisotropyIsTheSpreadOfFrictionOverTheSweepOfEachSubject) {
  const auto plan = this->plan(grouped);
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  const auto tangent = [](double degrees) { return std::tan(degrees * std::acos(-1.) / 180.); };
  for (const RunResult& row : run.result.rows) {
    const double steepest = row.subject == 0 ? 30. : 20.;
    const std::optional<double>& value = row.metrics[0].measured;
    ASSERT_EQ(value.has_value(), row.subject != 2);
    if (!value) continue;
    EXPECT_NEAR(*value, tangent(steepest) / tangent(10.) - 1., 1e-9);
  }
  EXPECT_EQ(run.result.truths[0].passed, 4);
  EXPECT_EQ(run.result.truths[0].failed, 0);
}

TEST_F(StudyRunner, AnisotropyNeedsEveryRunOfItsSweep) {
  const std::string over_mu = replaced(grouped, "over = slope", "over = mu");
  const auto whole = this->plan(over_mu);
  ASSERT_TRUE(whole) << first_error();
  EXPECT_NEAR(*run(*whole, "whole").result.rows[0].metrics[0].measured, 0., 1e-9);
  const auto broken = this->plan(replaced(over_mu, "0.8, 1;", "0.8, 1, 13;"));  // 13 breaks off
  ASSERT_TRUE(broken) << first_error();
  EXPECT_FALSE(run(*broken, "broken").result.rows[0].metrics[0].measured);
}

TEST_F(StudyRunner, AMetricOverASweepNamesOne) {
  const auto unsaid = plan(replaced(grouped, " { over = slope; }", ";"));
  ASSERT_TRUE(unsaid);
  EXPECT_EQ(first_error(),
            "`anisotropy` says nothing: no Sweep is called azimuth, and `over` names no other");
  EXPECT_FALSE(run(*unsaid, "out").result.rows[0].metrics[0].measured);
  EXPECT_FALSE(plan(replaced(grouped, "over = slope", "over = slop")));
  EXPECT_EQ(first_error(), "no Sweep is called `slop`; did you mean `slope`?");
  EXPECT_FALSE(plan(replaced(grouped, "peer_distance;", "peer_distance { over = slope; }")));
  EXPECT_EQ(first_error(), "`peer_distance` is of one run, not over a Sweep");
}

/// `grouped` with subjects that start at one place: a law of our own starts as deep as it stands.
std::string between_peers() {
  return replaced(grouped, "engine = dts; contact = hookpoint;",
                  "engine = ode; settings = matched;");
}

/// Half as fast but at `matched`.
std::unique_ptr<simulation::Engine> make_half_as_fast(const Experiment& experiment) {
  return std::make_unique<Slider>(experiment, experiment.settings == "matched" ? 1. : 0.5);
}

TEST_F(StudyRunner, PeerDistanceIsTheGreatestSeparationOfTwoKnownPaths) {
  engines_.add("ode", {described_as(engines_.describe("ode")), make_half_as_fast});
  const auto plan = this->plan(between_peers());
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  // After 1 s the subject of half the speed is half a way behind.
  const auto behind = [](double degrees) {
    return 0.5 * (2e-3 + 1e-3 * degrees * std::acos(-1.) / 180.);
  };
  ASSERT_EQ(run.result.peer_distances.size(), 6u);
  EXPECT_EQ(run.result.peer_distances[1].parameters, (std::vector{10., 1.}));
  EXPECT_NEAR(*run.result.peer_distances[1].distances[1], behind(10.), 1e-12);
  EXPECT_NEAR(*run.result.peer_distances[1].distances[3], behind(10.), 1e-12);
  EXPECT_EQ(run.result.peer_distances[1].distances[0], 0.);
  EXPECT_FALSE(run.result.peer_distances[1].distances[2]);  // bullet is skipped
  EXPECT_FALSE(run.result.peer_distances[5].distances[1]);  // 30 deg: the other is not there
  EXPECT_NEAR(*run.result.rows[0].metrics[1].measured, behind(10.), 1e-12);
  const std::string csv = read(folder_ / "out/peer_distance.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "slope [deg],mu,subject,other,peer_distance [m]");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 2 * 4);
}

TEST_F(StudyRunner, TheReportHasTheMatrixAsNumbersAndColours) {
  engines_.add("ode", {described_as(engines_.describe("ode")), make_half_as_fast});
  const auto plan = this->plan(between_peers());
  ASSERT_TRUE(plan) << first_error();
  const std::string table = distance_table(run(*plan, "out").result);
  // 1.17 mm at 20 deg, the steepest at which both run: the only distance, twice.
  EXPECT_NE(table.find("title=\"ours, slower\">1.2</td>"), std::string::npos) << table;
  EXPECT_NE(table.find("title=\"slower, ours\">1.2</td>"), std::string::npos) << table;
  EXPECT_NE(table.find("in mm, between"), std::string::npos) << table;
  EXPECT_EQ(table.find("none"), std::string::npos) << table;  // skipped
  EXPECT_EQ(distance_table({}), "");
}

TEST_F(StudyRunner, PathsAreComparedAtEqualTimesWhateverTheStep) {
  const auto plan = this->plan(replaced(between_peers(), "engine = ode; Only",
                                        "engine = ode; Fix dt { value = 30 ms; } Only"));
  ASSERT_TRUE(plan) << first_error();
  EXPECT_NEAR(*run(*plan, "out").result.rows[0].metrics[1].measured, 0., 1e-12);
}

TEST_F(StudyRunner, ResumedPathsGiveTheSameDistances) {
  engines_.add("ode", {described_as(engines_.describe("ode")), make_half_as_fast});
  const auto plan = this->plan(grouped);
  ASSERT_TRUE(plan) << first_error();
  run(*plan, "whole", 3);
  run(*plan, "cut", 1, false, [this](const Progress& progress) {
    if (progress.done == 5) stop_ = true;
  });
  stop_ = false;
  Slider::steps_taken = 0;
  run(*plan, "cut", 2, true);
  EXPECT_LT(Slider::steps_taken, 10 * 100);
  EXPECT_GT(Slider::steps_taken, 0);
  for (const char* file : {"results.csv", "peer_distance.csv"})
    EXPECT_EQ(read(folder_ / "whole" / file), read(folder_ / "cut" / file)) << file;
}

TEST_F(StudyRunner, WarnsOnceOfEachSubjectsStepAboveItsBound) {
  // Four corners of 20 kN/m under 1 kg: half of 80e3 kg/s^2 is too soft for 10 ms.
  const std::string text =
      replaced(grouped, "Sweep mu", "Sweep dt { values = 0.1 ms, 10 ms; } Sweep mu");
  const auto plan = this->plan(text);
  ASSERT_TRUE(plan) << first_error();
  ASSERT_EQ(plan->warnings.size(), 1u);  // a peer has no such bound
  EXPECT_TRUE(
      plan->warnings[0].starts_with("ours: deltat 0.01 s is above the largest stable step"));
  EXPECT_EQ(std::ranges::count(diagnostics_.all(), language::Severity::warning,
                               &language::Diagnostic::severity),
            1);
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.warnings, plan->warnings);
  EXPECT_NE(report_html(run.result, {}, {}).find("<li>ours: deltat 0.01 s"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint::studies
