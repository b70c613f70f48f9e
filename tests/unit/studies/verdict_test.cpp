// A study that judged nothing is not green: what covers no run, or has no closed form for the runs
// that it covers, says why and is counted. The engine slides at 2 mm/s and a millimetre a second
// per radian of slope.
#include "studies/run/verdict.h"

#include <gtest/gtest.h>

#include <string>

#include "studies/report/report.h"
#include "studies/report/terminal_table.h"
#include "studies/results/claims.h"
#include "studies/results/idleness.h"
#include "studies/run/run_record.h"
#include "tests/support/study_runner.h"

namespace hookpoint::studies {
namespace {

class StudyVerdict : public StudyRunner {
 protected:
  StudyVerdict() {
    engines_.add("mujoco", {described_as({"mujoco", "", "double", false, {}, {}})});
    write("ball.hook",
          replaced(slider_scene, "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; }",
                   "mass = 1 kg; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; "
                   "ContactPoint d { radius = 5 cm; }"));
  }
  StudyResult result_of(const std::string& text, const PlanOptions& options = {}) {
    const auto planned = plan(text, options);
    EXPECT_TRUE(planned) << text << first_error();
    if (!planned) return {};
    runs_.push_back(run(*planned, "out" + std::to_string(runs_.size())));
    return runs_.back().result;
  }
  std::vector<StudyRun> runs_;
};

std::string study(const std::string& blocks, const std::string& subject = "Subject ours { }",
                  const std::string& scene = "scene.hook") {
  return "Study s { scene = \"" + scene +
         "\"; duration = 1 s; Sweep slope { values = 4 deg, 8 deg, 12 deg; } " + subject +
         " Measure creep_speed; " + blocks + " }";
}

void expect_idle(const StudyResult& result, Idle idle, const std::string& why,
                 const std::string& words) {
  const std::vector<IdleBlock> blocks = idle_blocks(result);
  ASSERT_EQ(blocks.size(), 1U) << why;
  EXPECT_EQ(blocks[0].idleness.idle, idle) << blocks[0].idleness.why;
  EXPECT_EQ(blocks[0].idleness.why, why);
  EXPECT_EQ(all_truths_hold(result), idle != Idle::fault);
  EXPECT_NE(terminal_table(result, {}).find(words), std::string::npos)
      << terminal_table(result, {});
  const std::string page = report_html(result, {}, {});
  EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_NE(page.find(why), std::string::npos) << why;
  EXPECT_EQ(page.find("verdict good"), std::string::npos) << "nothing was judged";
}

TEST_F(StudyVerdict, ATruthWithoutAClosedFormSaysWhyAndFails) {
  const std::string truth = "Truth creep_speed { equals = predicted; within = 1 mm/s; ";
  const std::string why = "no closed form: the body rolls: contact point d is a ball";
  expect_idle(result_of(study(truth + "}", "Subject ours { }", "ball.hook")), Idle::fault, why,
              "1 Truth judges nothing");
  expect_idle(result_of(study(truth + "may_be_empty = true; }", "Subject ours { }", "ball.hook")),
              Idle::allowed, why, "1 Truth judges nothing, as it may");
}

TEST_F(StudyVerdict, WhatIsJudgedBesideItIsCountedWithIt) {
  const StudyResult result = result_of(study(
      "Truth creep_speed { equals = predicted; } Truth moves { metric = creep_speed; above = 1 "
      "mm/s; }",
      "Subject ours { }", "ball.hook"));
  EXPECT_FALSE(all_truths_hold(result));
  EXPECT_NE(terminal_table(result, {}).find("3 of 3 verdicts hold, 1 Truth judges nothing"),
            std::string::npos);
  EXPECT_NE(report_html(result, {}, {})
                .find("✗ 3 verdicts hold; <a href=\"#idle\">1 Truth judges "
                      "nothing</a>."),
            std::string::npos);
}

TEST_F(StudyVerdict, SomeRunsThatATruthCannotJudgeAreCountedBesideIt) {
  // Of the two subjects the ode of this test has no closed form of its creep.
  const StudyResult result =
      result_of(study("Truth creep_speed { equals = predicted; within = 1 m/s; }",
                      "Subject ours { } Subject other { engine = ode; }"));
  EXPECT_TRUE(all_truths_hold(result));
  EXPECT_EQ(result.truths[0].passed, 3);
  EXPECT_EQ(result.truths[0].unjudged, 3);
  const std::string table = terminal_table(result, {false, 1000});
  EXPECT_NE(table.find("3 runs not judged: no closed form: the engine has none of its creep"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("creep_speed of other (3 runs): the engine has none of its creep"),
            std::string::npos)
      << table;
}

TEST_F(StudyVerdict, AnEngineThatIsNotThereIsNoFault) {
  for (const std::string block :
       {"Truth creep_speed { above = 0; }",
        "Table t { rows = subject; columns = slope; value = "
        "creep_speed; }",
        "Plot p { x = slope; y = creep_speed; }", "Plot p { x = time; y = drift; }",
        "Claim c { text = \"{creep_speed of gone}\"; }",
        "Truth creep_speed { above = 0; subjects = gone; }"})
    expect_idle(result_of(study(block, "Subject gone { engine = mujoco; }")), Idle::left_out,
                "skipped: engine mujoco is not on this machine", "left out");
}

TEST_F(StudyVerdict, WhatIsComparedWithAnEngineThatIsNotThereIsLeftOut) {
  const std::string both = "Subject ours { } Subject gone { engine = mujoco; }";
  for (const std::string block :
       {"Truth peer_distance { below = 1 m; }",
        "Table t { rows = subject; columns = slope; value = peer_distance; }"})
    expect_idle(result_of(study("Measure peer_distance; " + block, both)), Idle::left_out,
                "engine mujoco is not on this machine", "left out");
  const std::string engines =
      "Study s { scene = \"scene.hook\"; duration = 1 s; Sweep engine { values = mujoco, dts, ode; "
      "} "
      "Subject any { } Measure creep_speed; Truth creep_speed { same_over = engine; } }";
  expect_idle(result_of(engines), Idle::left_out, "skipped: engine mujoco is not on this machine",
              "left out");
}

TEST_F(StudyVerdict, WhatQuickOrOnlyLeavesOutIsNoFault) {
  PlanOptions quick;
  quick.quick = true;  // 4 and 12 deg
  for (const std::string block :
       {"Truth creep_speed { above = 0; Only slope { values = 8 deg; } }",
        "Truth creep_speed { above = 0; Only slope { from = 5 deg; to = 9 deg; } }",
        "Plot p { x = slope; y = creep_speed; Only slope { values = 8 deg; } }",
        "Claim c { text = \"{creep_speed at slope = 8 deg}\"; }"})
    expect_idle(result_of(study(block), quick), Idle::left_out,
                "--quick leaves out the values of slope that it is about", "left out");
  PlanOptions only;
  only.only = {"ours"};
  expect_idle(result_of(study("Truth creep_speed { above = 0; subjects = other; }",
                              "Subject ours { } Subject other { engine = ode; }"),
                        only),
              Idle::left_out, "--only leaves out other", "left out");
}

TEST_F(StudyVerdict, RunsThatAreNotPlannedAreAFault) {
  const std::string subject = "Subject ours { Only slope { to = 8 deg; } }";
  for (const std::string block :
       {"Truth creep_speed { above = 0; Only slope { values = 12 deg; } }",
        "Table t { rows = subject; columns = slope; value = creep_speed; Only slope { values = 12 "
        "deg; } }",
        "Plot p { x = slope; y = creep_speed; Only slope { from = 10 deg; } }",
        "Plot p { x = time; y = drift; Only slope { from = 10 deg; } }",
        "Claim c { text = \"{creep_speed}\"; Only slope { values = 12 deg; } }"})
    expect_idle(result_of(study(block, subject)), Idle::fault, "no run has slope = 12 deg",
                "nothing");
}

TEST_F(StudyVerdict, AMetricWithoutAValueIsAFaultOfWhatShowsIt) {
  // A body without impulses has no rate of them.
  const std::string measured = "Measure impacts; ";
  for (const std::string block :
       {"Table t { rows = subject; columns = slope; value = impacts; }",
        "Plot p { x = slope; y = impacts; }", "Plot p { x = impacts; y = creep_speed; }",
        "Claim c { text = \"{impacts}\"; }"})
    expect_idle(result_of(study(measured + block)), Idle::fault, "no run has a value of impacts",
                "shows nothing");
  expect_idle(result_of(study("Claim c { text = \"{predicted creep_speed}\"; }", "Subject ours { }",
                              "ball.hook")),
              Idle::fault, "no closed form: the body rolls: contact point d is a ball",
              "1 Claim shows nothing");
}

TEST_F(StudyVerdict, ARunIsNotComparedWithItself) {
  const std::string one =
      "Study s { scene = \"scene.hook\"; duration = 1 s; Sweep slope { values = 4 "
      "deg; } Subject ours { } Measure creep_speed; Truth creep_speed { "
      "same_over = slope; } }";
  expect_idle(result_of(one), Idle::fault,
              "the run with the first value of slope has no other to be compared with",
              "1 Truth judges nothing");
  const StudyResult several =
      result_of(study("Truth creep_speed { same_over = slope; within = 1; }"));
  EXPECT_EQ(several.truths[0].passed, 3);
}

TEST_F(StudyVerdict, AMeasureOfOnesOwnNeedsAPrediction) {
  expect_idle(
      result_of(study("Measure way { of = block.position.x; } Truth way { equals = predicted; "
                      "}")),
      Idle::fault, "no closed form: the Measure has no `predicted`", "1 Truth judges nothing");
}

TEST_F(StudyVerdict, AnOnlyWithAValueThatItsSweepLacksIsAnError) {
  for (const char* owner :
       {"Truth creep_speed { above = 0; ONLY }", "Plot p { x = slope; y = creep_speed; ONLY }",
        "Table t { rows = subject; columns = slope; value = creep_speed; ONLY }",
        "Claim c { text = \"{creep_speed}\"; ONLY }",
        "Plot p { x = slope; y = creep_speed; Reference r { value = 1; ONLY } }"}) {
    EXPECT_FALSE(plan(study(replaced(owner, "ONLY", "Only slope { values = 11 deg; }"))));
    EXPECT_EQ(first_error(),
              "`11 deg` is no value of the Sweep `slope`; it has 4 deg, 8 deg, 12 deg")
        << owner;
    EXPECT_FALSE(plan(study(replaced(owner, "ONLY", "Only slope { from = 13 deg; }"))));
    EXPECT_EQ(first_error(),
              "no value of the Sweep `slope` lies there; it has 4 deg, 8 deg, 12 deg");
  }
  EXPECT_FALSE(plan(study("", "Subject ours { Only slope { values = 11 deg; } }")));
  EXPECT_EQ(diagnostics_.all().front().position.file->path, (folder_ / "study.hook").string());
  const std::string many =
      "Study s { scene = \"scene.hook\"; duration = 1 s; Sweep slope { from = 0 "
      "deg; to = 30 deg; step = 1 deg; } Subject ours { } Measure creep_speed; "
      "Truth creep_speed { above = 0; Only slope { values = 11.4 deg; } } }";
  EXPECT_FALSE(plan(many));
  EXPECT_EQ(
      first_error(),
      "`11.4 deg` is no value of the Sweep `slope`; it has 31 values, of which the nearest are "
      "10 deg, 11 deg, 12 deg");
}

TEST_F(StudyVerdict, WordsThatQuickLeavesOutAreNoError) {
  const std::string text =
      "Study s { scene = \"scene.hook\"; duration = 1 s; Sweep contact { values = hookpoint, "
      "lugre, "
      "nominal; } Subject ours { } Measure creep_speed; Truth creep_speed { above = 0; Only "
      "contact "
      "{ values = lugre; } } }";
  PlanOptions quick;
  quick.quick = true;
  expect_idle(result_of(text, quick), Idle::left_out,
              "--quick leaves out the values of contact that it is about", "left out");
  EXPECT_FALSE(plan(replaced(text, "values = lugre", "values = lugrre")));
  EXPECT_NE(first_error().find("did you mean `lugre`"), std::string::npos) << first_error();
}

TEST_F(StudyVerdict, ANumberIsToldInTheUnitThatTheUserWrote) {
  const StudyResult result = result_of(replaced(
      study("Truth creep_speed { value = 2 mm/s; within = 0.5 mm/s; } Truth slow { metric = "
            "creep_speed; below = 3 mm/s; above = 0.001; }"),
      "Measure creep_speed;", "Measure creep_speed { unit = \"mm/s\"; }"));
  EXPECT_EQ(result.metrics[0].unit, "mm/s");
  // 2 mm/s and a millimetre a second per radian: 2.0698 at 4 deg.
  EXPECT_NEAR(*result.rows[0].metrics[0].measured, 2.0698132, 1e-6);
  EXPECT_EQ(result.truths[0].words, "creep_speed equals 2 mm/s within 0.5 mm/s");
  EXPECT_EQ(result.truths[1].words, "creep_speed is above 1 mm/s and is below 3 mm/s");
  EXPECT_EQ(result.truths[0].passed, 3);
  EXPECT_EQ(result.truths[1].passed, 3);
  EXPECT_FALSE(
      plan(replaced(study(""), "Measure creep_speed;", "Measure creep_speed { unit = mm; }")));
  EXPECT_NE(first_error().find("is in m/s, not in m"), std::string::npos) << first_error();
}

TEST(StoredReason, SurvivesAndIsNotNeeded) {
  RunRecord record;
  record.values["creep_speed"] = {1., std::nullopt, "contact point d\nis a ball"};
  const auto read = read_numbers(numbers_text(record));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->values.at("creep_speed").no_form, "contact point d is a ball");
  // As it was written before reasons were kept.
  record.values["creep_speed"].no_form.clear();
  const std::string before = numbers_text(record);
  EXPECT_EQ(before.find("no_form"), std::string::npos);
  EXPECT_EQ(read_numbers(before)->values.at("creep_speed").no_form, "");
}

TEST_F(StudyVerdict, AReasonIsThereAfterResume) {
  const auto planned =
      plan(study("Truth creep_speed { equals = predicted; }", "Subject ours { }", "ball.hook"));
  ASSERT_TRUE(planned) << first_error();
  const StudyResult first = run(*planned, "out").result;
  const long steps = Slider::steps_taken;
  const StudyResult again = run(*planned, "out", 1, true).result;
  EXPECT_EQ(Slider::steps_taken, steps);
  EXPECT_EQ(again.truths[0].idleness.why, first.truths[0].idleness.why);
  EXPECT_EQ(terminal_table(again, {}), terminal_table(first, {}));
}

}  // namespace
}  // namespace hookpoint::studies
