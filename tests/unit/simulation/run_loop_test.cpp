#include <gtest/gtest.h>

#include <string>

#include "simulation/run/loop.h"

namespace hookpoint::simulation {
namespace {

/// Counts steps; ends by itself, or fails, at a given one.
struct Counter {
  std::int64_t ends_at = -1, fails_after = -1;
  WorldState now;
  const WorldState& state() const { return now; }
  std::string ended() const { return now.step == ends_at ? "enough" : ""; }
  StepStatus step() {
    if (now.step == fails_after)
      return {StepStatus::Kind::not_finite, 0.51, "block.base", "halve deltat"};
    ++now.step;
    return {};
  }
};

constexpr auto always = [] { return true; };

TEST(RunLoop, LooksAfterEachStepUntilTheLast) {
  Counter run;
  std::string seen;
  const RunEnd end =
      run_until(run, 3, always, [&] { seen += " " + std::to_string(run.state().step); });
  EXPECT_TRUE(end.complete());
  EXPECT_EQ(seen, " 1 2 3");
}

TEST(RunLoop, GoesOnFromWhereTheRunIs) {
  Counter run;
  run.now.step = 2;
  int looks = 0;
  EXPECT_TRUE(run_until(run, 3, always, [&] { ++looks; }).complete());
  EXPECT_TRUE(run_until(run, 3, always, [&] { ++looks; }).complete());
  EXPECT_EQ(looks, 1);
}

TEST(RunLoop, EndsWhereTheRunEndsByItself) {
  Counter run;
  run.ends_at = 2;
  const RunEnd end = run_until(run, 5, always, [] {});
  EXPECT_EQ(end.reason, RunEnd::Reason::by_itself);
  EXPECT_EQ(end.why, "enough");
  EXPECT_EQ(run.state().step, 2);
  // At its last step a run is complete, whatever it would do next.
  Counter whole;
  whole.ends_at = 5;
  EXPECT_TRUE(run_until(whole, 5, always, [] {}).complete());
}

TEST(RunLoop, MakesNoStepOnceInterrupted) {
  Counter run;
  const RunEnd end = run_until(
      run, 5, [&] { return run.state().step < 2; }, [] {});
  EXPECT_TRUE(end.interrupted());
  EXPECT_EQ(run.state().step, 2);
}

TEST(RunLoop, StopsAtAStepThatFails) {
  Counter run;
  run.fails_after = 2;
  int looks = 0;
  const RunEnd end = run_until(run, 5, always, [&] { ++looks; });
  EXPECT_TRUE(end.failed());
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(failure_text(end.status), "at 0.51 s (block.base): halve deltat");
}

TEST(RunLoop, StopsWhereWhatAStepLeftCannotBeUsed) {
  Counter run;
  const RunEnd end = run_until(run, 5, always, [&] {
    return run.state().step < 2
               ? StepStatus{}
               : StepStatus{StepStatus::Kind::not_finite, 0.2, "port", "look at the gains"};
  });
  EXPECT_TRUE(end.failed());
  EXPECT_EQ(end.status.body, "port");
  EXPECT_EQ(run.state().step, 2);
}

}  // namespace
}  // namespace hookpoint::simulation
