// The Wall of scenes with a known truth, and maps of parameters, as a user runs them.
// ctest: long
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "studies/run/run_store.h"
#include "tests/support/command.h"
#include "tests/support/store_file.h"

namespace hookpoint {
namespace {

using testing::config;
using testing::remove_run;
using testing::Workplace;

// The laws that cost least; the whole Wall is `hookpoint study configs/studies/truths.hook`.
TEST(Wall, EverySceneShowsItsTruth) {
  const Workplace work;
  const auto result =
      work.hookpoint("study " + config("studies/truths.hook") +
                     " --quick --only hookpoint --only nominal --only impulse --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  const std::string rows = work.read("here/results.csv");
  for (const char* scene : {"rolling_sphere", "slide_to_roll", "pendulum", "spinning_disc"})
    EXPECT_NE(rows.find(scene), std::string::npos) << scene;
  EXPECT_GT(std::ranges::count(rows, '\n'), 80) << "truths and subjects";
}

const std::string small_wall =
    "Wall small {\n"
    "  Subject hookpoint { engine = dts; contact = hookpoint; }\n"
    "  Subject lugre { engine = dts; contact = lugre; Fix dt { value = 0.1 ms; } }\n"
    "  Scene stopping_point {}\n"
    "  Scene slide_to_roll {}\n"
    "  Scene pendulum {}\n"
    "}\n";

TEST(Wall, HasTheSameBytesForAnyNumberOfThreads) {
  const Workplace work;
  work.file("small.hook", small_wall);
  const auto one = work.hookpoint("study small.hook --jobs 1 --out one");
  const auto two = work.hookpoint("study small.hook --jobs 2 --out two");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(two.status, 0) << two.err;
  const std::string rows = work.read("one/results.csv");
  EXPECT_FALSE(rows.empty());
  EXPECT_EQ(rows, work.read("two/results.csv"));
}

TEST(Wall, ResumesWithWhatIsMissing) {
  const Workplace work;
  work.file("small.hook", small_wall);
  ASSERT_EQ(work.hookpoint("study small.hook --out here").status, 0);
  const std::string whole = work.read("here/results.csv");
  // A run that is there is taken as it is; one that is not is made.
  {
    studies::RunStore store(work.folder() / "here/store", true);
    const std::string identity = store.assigned("small", 0).value();
    studies::RunRecord changed = store.load(identity).value();
    changed.values.begin()->second.measured = 0.125;
    store.save("small", 0, identity, changed);
  }
  remove_run(work.folder() / "here/store", 1);
  const auto resumed = work.hookpoint("study small.hook --out here --resume");
  EXPECT_EQ(resumed.status, 1) << resumed.err;
  const std::string changed = work.read("here/results.csv");
  EXPECT_NE(changed.find(",0.125,"), std::string::npos) << changed;
  const auto after_first = [](const std::string& rows) {
    return rows.substr(rows.find('\n', rows.find('\n') + 1));
  };
  EXPECT_EQ(after_first(changed), after_first(whole));
  // Without --resume all is run again; rows of another plan are not taken.
  EXPECT_EQ(work.hookpoint("study small.hook --out here").status, 0);
  EXPECT_EQ(work.read("here/results.csv"), whole);
  EXPECT_EQ(work.hookpoint("study small.hook --out here --resume --only lugre").status, 0);
}

TEST(Wall, WarnsOfAStepAboveTheStabilityBound) {
  const Workplace work;
  work.file("coarse.hook",
            "Wall coarse {\n"
            "  Subject ours { engine = dts; contact = hookpoint; }\n"
            "  Subject fine { engine = dts; contact = hookpoint; integrator = explicit_euler; }\n"
            "  Scene stopping_point { Fix dt { value = 5 ms; } }\n"
            "}\n");
  const auto result = work.hookpoint("study coarse.hook --out here");
  // k = 50 kN/m, c = 300 N s/m: (sqrt(c^2 + 4 k m) - c)/k is 4.77 ms, explicit Euler's c/k 6 ms.
  EXPECT_NE(result.err.find("deltat 0.005 s is above the largest stable step 0.00477 s of "
                            "semi_implicit_euler under the law hookpoint"),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("coarse.hook:4:3: warning"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("of explicit_euler"), std::string::npos) << result.err;
  EXPECT_NE(work.read("here/report.html").find("stopping_point under ours: deltat"),
            std::string::npos);
}

// In every cell of the maps: the largest stable step, and atan(mu).
TEST(Maps, AreAsTheirClosedFormsSay) {
  const Workplace work;
  const auto stability =
      work.hookpoint("study " + config("studies/stability_map.hook") + " --quick --out stability");
  EXPECT_EQ(stability.status, 0) << stability.out << stability.err;
  EXPECT_NE(stability.out.find("broke off as expected; 18 of 18 verdicts hold"), std::string::npos)
      << stability.out;
  const auto threshold = work.hookpoint("study " + config("studies/threshold_map.hook") +
                                        " --quick --only hookpoint --out threshold");
  EXPECT_EQ(threshold.status, 0) << threshold.out << threshold.err;
}

TEST(Wall, FailsWhereATruthDoes) {
  const Workplace work;
  work.file("drop.hook",
            "Param dt = 1 ms;\n"
            "World w { gravity = 9.81; deltat = dt; duration = 1 s; integrator = rk4;\n"
            "  Robot b { Base.mobile { mass = 1; Shape.Box dimensions = 1, 1, 1; } } }\n"
            "Expect right { of = w.b.velocity.z; equals = -9.81 m/s; tolerance = 0.001 %; }\n"
            "Expect wrong { of = w.b.velocity.z; equals = -9.9 m/s; tolerance = 0.1 %; }\n");
  work.file("wall.hook",
            "Wall one { Subject ours { engine = dts; } Scene drop { file = \"drop.hook\"; } }\n");
  const auto result = work.hookpoint("study wall.hook --out here");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("drop.wrong under ours"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("drop.right under ours"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1 of 2 verdicts hold"), std::string::npos) << result.out;
}

/// A box that falls, in a scene without ground: its law is the scene's own under any Subject.
void make_drop(const Workplace& work, const std::string& expects) {
  work.file("drop.hook",
            "World w { gravity = 9.81; deltat = 1 ms; duration = 1 s; integrator = rk4;\n"
            "  Robot b { Base.mobile { mass = 1; Shape.Box dimensions = 1, 1, 1; } } }\n" +
                expects);
  work.file("wall.hook",
            "Wall one { Subject ours { engine = dts; contact = lugre; } Scene drop { file = "
            "\"drop.hook\"; } }\n");
}

TEST(Wall, IsNotGreenWhereAllExpectsOfASceneJudgeNothing) {
  const Workplace work;
  make_drop(work,
            "Expect fall { of = w.b.velocity.z; equals = -9.81 m/s; within = 1; laws = lugre; }\n");
  const auto result = work.hookpoint("study wall.hook --out here");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("0 of 0 verdicts hold, 1 Expect judges nothing"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("not judged: Expect drop.fall: it covers neither"), std::string::npos)
      << result.out;
  const std::string page = work.read("here/report.html");
  EXPECT_NE(page.find("✗ No verdict, 1 Expect judges nothing"), std::string::npos);
  EXPECT_NE(page.find("Not judged: Expect drop.fall"), std::string::npos);
}

TEST(Wall, LetsAnExpectOfAnotherLawJudgeNothing) {
  const Workplace work;
  make_drop(work,
            "Expect fall { of = w.b.velocity.z; equals = -9.81 m/s; within = 1; laws = lugre; }\n"
            "Expect drop { of = w.b.velocity.z; equals = -9.81 m/s; tolerance = 0.001 %; }\n");
  const auto result = work.hookpoint("study wall.hook --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 of 1 verdicts hold, 1 Expect judges nothing, as it may"),
            std::string::npos)
      << result.out;
}

TEST(Wall, WithoutARunIsAnError) {
  const Workplace work;
  work.file("empty.hook", "Wall one { Subject ours { engine = dts; } }\n");
  const auto result = work.hookpoint("study empty.hook --out here");
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_NE(result.err.find("empty.hook:1:1: error: the Wall has no run"), std::string::npos)
      << result.err;
}

TEST(Wall, RunsASceneInWhichNothingMoves) {
  const Workplace work;
  work.file(
      "clock.hook",
      "World w { deltat = 1 ms; duration = 0.5 s; Expression twice { formula = \"2 * time\"; } "
      "}\nExpect end { of = w.twice.output; take = final; equals = 1; within = 1e-9; }\n");
  work.file("wall.hook",
            "Wall one { Subject ours { engine = dts; } Scene clock { file = \"clock.hook\"; } }\n");
  const auto result = work.hookpoint("study wall.hook --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 of 1 verdicts hold"), std::string::npos) << result.out;
}

TEST(Wall, JudgesARunThatEndsByItself) {
  const Workplace work;
  work.file(
      "quits.hook",
      "World w { deltat = 1 ms; duration = 0.5 s; Expression late { formula = \"time > 0.2 s\"; "
      "Wire TO Simulator.quit; } }\n"
      "Expect end { of = w.time; take = final; equals = 0.2 s; within = 2 ms; }\n");
  work.file("wall.hook",
            "Wall one { Subject ours { engine = dts; } Scene quits { file = \"quits.hook\"; } }\n");
  const auto result = work.hookpoint("study wall.hook --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("1 of 1 verdicts hold"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace hookpoint
