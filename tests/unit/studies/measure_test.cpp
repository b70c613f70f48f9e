// Metrics that a study defines itself: against motions that are known, and what is wrong with one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "language/values/formula.h"
#include "studies/cluster/run_list.h"
#include "studies/report/report.h"
#include "studies/report/terminal_table.h"
#include "studies/results/claims.h"
#include "studies/run/execute.h"
#include "studies/run/verdict.h"
#include "tests/support/study_runner.h"

namespace hookpoint::studies {
namespace {

/// The Slider moves down a slope at v = 2 mm/s + 1 mm/s slope/rad, from its start x0, z0 on.
constexpr const char* own_study = R"(
Let per_radian = 1 mm/s/rad;
Study own {
  scene = "scene.hook";
  duration = 1 s;
  Sweep slope { values = 0 deg, 30 deg; }
  Subject ours { }
  Subject peer { engine = ode; }
  Measure way {
    of = world.block.base.location.x;
    take = change;
    unit = mm;
    predicted = (2 mm/s + per_radian * slope) * cos(slope) * 1 s;
  }
  Measure moved { of = hypot(block.position.x, block.position.z); take = range; from = 0.25 s; to = 0.75 s; }
  Measure late { of = block.position.x > 1 mm; take = mean; }
  Truth way { equals = predicted; tolerance = 1e-9; }
  Truth far { metric = way; above = 1.5 mm; Only slope { values = 0 deg; } }
  Table ways { rows = subject; columns = slope; value = way; }
}
)";

class StudyMeasure : public StudyRunner {
 protected:
  std::string messages() const {
    std::string all;
    for (const language::Diagnostic& diagnostic : diagnostics_.all())
      all += diagnostic.message + "\n";
    return all;
  }
  /// Of the study with its first Measure replaced.
  std::string error_with(const std::string& measure) {
    const std::string text = own_study;
    const std::size_t begin = text.find("Measure way"), end = text.find("Measure moved");
    const std::string changed = text.substr(0, begin) + measure + text.substr(end);
    EXPECT_FALSE(plan(changed)) << measure;
    return messages();
  }
};

TEST_F(StudyMeasure, ReducesAFormulaOfPortsBesideItsClosedForm) {
  const auto plan = this->plan(own_study);
  ASSERT_TRUE(plan) << messages();
  const StudyRun run = this->run(*plan, "out");
  const StudyResult& result = run.result;
  ASSERT_EQ(result.metrics.size(), 3u);
  EXPECT_EQ(result.metrics[0].unit, "mm");
  EXPECT_EQ(result.metrics[1].unit, "m");
  ASSERT_EQ(result.rows.size(), 4u);
  const double v = 2. + M_PI / 6.;  // mm/s at 30 deg
  for (const std::size_t row : {2u, 3u}) {
    const auto& metrics = result.rows[row].metrics;
    EXPECT_NEAR(*metrics[0].measured, v * std::cos(M_PI / 6.), 1e-9);
    EXPECT_NEAR(*metrics[0].predicted, v * std::cos(M_PI / 6.), 1e-12);
    EXPECT_EQ(metrics[0].ok, true);
  }
  // The Truth `far` speaks of 0 deg alone: 2 mm are above 1.5 mm.
  EXPECT_EQ(result.truths[1].passed, 2);
  EXPECT_TRUE(all_truths_hold(result));
  // Over the level x passes 1 mm at 0.5 s; of the 101 instants 50 come later.
  EXPECT_NEAR(*result.rows[0].metrics[2].measured, 50. / 101., 1e-12);
  const std::string csv = read(run.folder / "results.csv");
  EXPECT_NE(csv.find("way [mm],way_predicted [mm],way_ok,moved [m],moved_predicted [m]"),
            std::string::npos)
      << csv.substr(0, 300);
  EXPECT_TRUE(std::filesystem::exists(run.folder / "ways.csv"));
}

TEST_F(StudyMeasure, AnotherDefinitionOfANameIsAnotherMetric) {
  const std::string text = own_study;
  const auto first = plan(text);
  ASSERT_TRUE(first) << messages();
  run(*first, "out");
  const long steps = Slider::steps_taken;
  const auto same = plan(text);
  run(*same, "out", 1, true);
  EXPECT_EQ(Slider::steps_taken, steps) << "the runs were there";
  const auto other = plan(replaced(text, "take = change", "take = maximum"));
  run(*other, "out", 1, true);
  EXPECT_GT(Slider::steps_taken, steps);
}

TEST_F(StudyMeasure, GoesToOtherProcessesWhole) {
  const auto plan = this->plan(own_study);
  ASSERT_TRUE(plan) << messages();
  const RowPlan& row = plan->rows[0];
  RunList list;
  list.runs.push_back({"a", "b", plan->scene_of(row), measurement_of(*plan, row)});
  write("runs.json", run_list_text(list));
  const RunList read = read_run_list(folder_ / "runs.json");
  ASSERT_EQ(read.runs.size(), 1u);
  const auto& metrics = read.runs[0].measurement.metrics;
  ASSERT_EQ(metrics.size(), 3u);
  for (std::size_t i = 0; i < metrics.size(); ++i)
    EXPECT_EQ(kept_name(*metrics[i]), kept_name(*plan->metrics[i].definition));
}

TEST_F(StudyMeasure, SaysWhatIsWrongWithADefinition) {
  struct Wrong {
    const char *measure, *message;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"Measure creep_speed { of = block.position.x; }", "is a metric that there is"},
           {"Measure way;", "one of your own says what it is `of`"},
           {"Measure fell { take = last; }", "belongs to a metric of your own"},
           {"Measure way { of = block.postion.x; }", "did you mean `position`"},
           {"Measure way { of = block.position; }", "take one, such as `block.position.x`"},
           {"Measure way { of = block.position.x + 1 s; }", "m and s cannot be added"},
           {"Measure way { of = sine(slope); }", "unknown function `sine`"},
           {"Measure way { of = block.position.x; unit = s; }", "is in m, not in s"},
           {"Measure way { of = block.position.x; unit = mmm; }", "`mmm` is no unit"},
           {"Measure way { of = block.position.x; take = time_above; }", "needs the `level`"},
           {"Measure way { of = block.position.x; take = time_above; level = 1 s; }",
            "`level` is to be in m, not in s"},
           {"Measure way { of = block.position.x; take = settle_time; }", "needs the `band`"},
           {"Measure way { of = block.position.x; from = 1 s; to = 0.5 s; }", "later than `from`"},
           {"Measure way { of = block.position.x; predicted = slop; }", "did you mean `slope`"},
           {"Measure way { of = block.position.x; predicted = slope; }", "not in rad"}}) {
    const std::string said = error_with(wrong.measure);
    EXPECT_NE(said.find(wrong.message), std::string::npos) << wrong.measure << "\n" << said;
  }
}

/// A ground and a robot that are named by words; two Materials state one coefficient of friction.
constexpr const char* worded_scene = R"(
Param soil = clay;
Param usual = soil;
Param robot = "low.hook";
Param mu = 0.4;
World world {
  deltat = 10 ms;
  Material clay { kinetic_friction = 0.9; }
  Material oak { static_friction = mu; kinetic_friction = 0.3; }
  Material ice { static_friction = 0.1; }
  Terrain.Slope ground { angle = 10 deg; material = soil; }
  Robot block { Base.mobile { rest_on = ground; Include robot; } }
}
)";

/// With these closed forms, of a length.
std::string worded_study(const std::vector<std::string>& forms) {
  std::string text = R"(
Study worded {
  scene = "worded.hook";
  duration = 0.1 s;
  Sweep soil { values = clay, oak, ice; }
  Sweep contact { values = hookpoint, lugre; }
  Subject low { Fix robot { value = "low.hook"; } }
  Subject high { Fix robot { value = "high.hook"; } }
)";
  for (std::size_t i = 0; i < forms.size(); ++i)
    text += "  Measure way" + std::to_string(i) +
            " { of = block.position.x; take = change; predicted = " + forms[i] + "; }\n";
  return text + "}\n";
}

TEST_F(StudyMeasure, AClosedFormSeesWordsAndTheMaterialsThatTheyName) {
  write("worded.hook", worded_scene);
  for (const char* box : {"low.hook", "high.hook"})
    write(box, "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; }\n");
  const auto plan = this->plan(worded_study(
      {"soil.static_friction * 1 m", "soil.kinetic_friction * 1 m", "clay.static_friction * 1 m",
       "soil == oak ? 1 m : 2 m", "contact != lugre && soil == usual ? 1 m : 2 m",
       "robot == \"low.hook\" ? 3 m : mu * 1 m",
       "soil == ice ? ice.kinetic_friction * 1 m : 5 m"}));
  ASSERT_TRUE(plan) << messages();
  const StudyResult result = run(*plan, "out").result;
  ASSERT_EQ(result.rows.size(), 12u);
  const std::map<std::string, std::pair<double, double>> frictions{
      {"clay", {0.9, 0.9}}, {"oak", {0.4, 0.3}}, {"ice", {0.1, 0.1}}};
  for (const RunResult& row : result.rows) {
    const std::string soil = result.sweeps[0].words[static_cast<std::size_t>(row.parameters[0])];
    const bool lugre = row.parameters[1] == 1.;
    const auto [mu_s, mu_k] = frictions.at(soil);
    // `usual` is the name of `soil`, and holds what that holds.
    const double expected[] = {mu_s,
                               mu_k,
                               0.9,
                               soil == "oak" ? 1. : 2.,
                               lugre ? 2. : 1.,
                               row.subject == 0 ? 3. : 0.4,
                               soil == "ice" ? 0.1 : 5.};
    for (std::size_t i = 0; i < std::size(expected); ++i)
      EXPECT_DOUBLE_EQ(row.metrics[i].predicted.value_or(-1.), expected[i]) << soil << " " << i;
  }
}

TEST_F(StudyMeasure, AClosedFormTakesTheStepThatTheRunChooses) {
  write("worded.hook", replaced(worded_scene, "deltat = 10 ms", "deltat = auto"));
  for (const char* box : {"low.hook", "high.hook"})
    write(box, "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; }\n");
  const auto plan = this->plan(worded_study({"world.deltat * 1 m/s"}));
  ASSERT_TRUE(plan) << messages();
  for (const RowPlan& row : plan->rows) {
    ASSERT_GT(row.deltat, 0.);
    EXPECT_DOUBLE_EQ(row.forms.at(0).predicted.value_or(-1.), row.deltat);
  }
}

TEST_F(StudyMeasure, SaysWhatIsWrongWithAWordInAClosedForm) {
  write("worded.hook", worded_scene);
  for (const char* box : {"low.hook", "high.hook"})
    write(box, "Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; }\n");
  for (const auto& [form, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"soil * 1 m", "`soil` holds the word `clay`"},
           {"soil == mu ? 1 m : 2 m", "`mu` is a number, and compared with a word"},
           {"soil.statik_friction * 1 m", "did you mean `static_friction`"},
           {"\"clay\" * 1 m", "is a string, no number"},
           {"soil == oak ? 1 m : oak * 1 m", "no Param of the scene that is a number"},
           {"soil == okk ? 1 m : 2 m", "`okk` is no word of a Sweep"},
           {"soil == okk ? 1 m : 2 m", "did you mean `oak`"},
           {"soil < oak ? 1 m : 2 m", "`soil` holds the word `clay`"}}) {
    EXPECT_FALSE(plan(worded_study({form}))) << form;
    EXPECT_NE(messages().find(message), std::string::npos) << form << "\n" << messages();
  }
}

TEST_F(StudyMeasure, ExpectsOfTheSceneAreTruthsOfTheStudy) {
  write("expecting.hook", replaced(slider_scene, "deltat = dt;", "deltat = dt; duration = 1 s;") +
                              R"(
Expect way {
  of = world.block.position.x; take = change;
  equals = (2 mm/s + 1 mm/s/rad * slope) * cos(slope) * 1 s; tolerance = 1e-9;
}
Expect of_hooks {
  of = world.block.position.x; take = maximum; equals = 0; within = 1 um; laws = hookpoint;
}
)");
  const std::string study = R"(
Study own {
  scene = "expecting.hook"; duration = 1 s;
  Sweep slope { values = 0 deg, 30 deg; }
  Subject ours { contact = hunt_crossley; }
  Subject hooks { contact = hookpoint; }
}
)";
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << messages();
  const StudyResult result = run(*plan, "out").result;
  ASSERT_EQ(result.truths.size(), 2u);
  EXPECT_EQ(result.truths[0].passed, 4);
  EXPECT_EQ(result.truths[0].failed, 0);
  EXPECT_EQ(result.truths[1].passed, 0) << "the hooks hold nothing here";
  EXPECT_EQ(result.truths[1].failed, 2) << "of one law alone";
  EXPECT_NE(result.truths[0].words.find("the scene's (2 mm/s"), std::string::npos);
  const auto without = this->plan(replaced(study, "duration", "expects = false; duration"));
  ASSERT_TRUE(without) << messages();
  EXPECT_TRUE(without->metrics.empty());
  const auto shorter = this->plan(replaced(study, "duration = 1 s", "duration = 0.9 s"));
  ASSERT_TRUE(shorter) << messages();
  EXPECT_TRUE(shorter->metrics.empty()) << "they speak of a run of 1 s";
}

/// With a Claim of that text in it.
std::string claiming(const std::string& text, const std::string& more = "") {
  return replaced(own_study, "  Table ways",
                  "  Claim answer { text = \"" + text + "\"; " + more + " }\n  Table ways");
}

TEST_F(StudyMeasure, AClaimIsFilledInAndStandsWithItsTruths) {
  const auto plan = this->plan(claiming(
      "<b> {way of ours at slope = 0 deg}, {largest way}, {way of ours at slope = 30 deg / least "
      "way} {{{predicted way of peer at slope = 0 deg}}} {subject of least way}"));
  ASSERT_TRUE(plan) << messages();
  StudyResult result = run(*plan, "out").result;
  ASSERT_EQ(result.claims.size(), 1u);
  // v cos(30 deg) = 2.185 mm.
  const SaidClaim said = said_of(result, result.claims[0]);
  EXPECT_EQ(said.text, "<b> 2 mm, 2.19 mm, 1.09 {2 mm} ours");
  EXPECT_EQ(said.verdict, ClaimVerdict::holds);
  EXPECT_EQ(said.why, "holds: way in 4 runs, far in 2 runs");
  const std::string page = report_html(result, {}, {});
  EXPECT_NE(page.find("&lt;b&gt; 2 mm"), std::string::npos);
  EXPECT_LT(page.find("&lt;b&gt; 2 mm"), page.find("<table"));
  EXPECT_EQ(terminal_table(result, {}).find("<b> 2 mm"), 0u);
  // One row less is one too few for the sentence.
  result.truths[1].failed = 1;
  result.truths[1].passed = 1;
  const SaidClaim wrong = said_of(result, result.claims[0]);
  EXPECT_EQ(wrong.verdict, ClaimVerdict::fails);
  EXPECT_EQ(wrong.why, "does not hold: it fails far in 1 of 2 runs");
  EXPECT_NE(report_html(result, {}, {}).find("class=\"claim bad\""), std::string::npos);
  for (RunResult& row : result.rows) row.metrics[0].measured.reset();
  result.truths.clear();
  result.claims[0].truths.clear();
  EXPECT_EQ(said_of(result, result.claims[0]).verdict, ClaimVerdict::unsaid);
}

// Over the level the block moves 2 mm at a height of 50 mm; from 0.25 s to 0.75 s its distance grows by
// (1.5^2 - 0.5^2) mm^2 / (2 * 50 mm) = 0.02 mm. x is above 1 mm at 50 of 101 instants.
TEST_F(StudyMeasure, ARatioOfTwoUnitsIsInSI) {
  const auto plan = this->plan(claiming("{way / moved} {moved / way} {way of ours / late of ours}",
                                        "Only slope { values = 0 deg; }"));
  ASSERT_TRUE(plan) << messages();
  const StudyResult result = run(*plan, "out").result;
  EXPECT_EQ(said_of(result, result.claims[0]).text, "100 0.01 0.00404 m");
}

TEST_F(StudyMeasure, AClaimTakesTheTruthsThatItNames) {
  const auto plan =
      this->plan(claiming("Far: {way}", "truth = far; Only slope { values = 0 deg; }"));
  ASSERT_TRUE(plan) << messages();
  const StudyResult result = run(*plan, "out").result;
  const SaidClaim said = said_of(result, result.claims[0]);
  EXPECT_EQ(said.text, "Far: 2 mm");
  EXPECT_EQ(said.why, "holds: far in 2 runs");
}

TEST_F(StudyMeasure, SaysWhatIsWrongWithAClaim) {
  struct Wrong {
    const char *text, *more, *message;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"{wya}", "", "did you mean `way`"},
           {"{way of our}", "", "no Subject is called `our`"},
           {"{way at slop = 0 deg}", "", "no Sweep is called `slop`"},
           {"{way at slope = 7 deg}", "", "`7 deg` is no value of the Sweep `slope`"},
           {"{way nicely}", "", "`nicely` in `{way nicely}` is not understood"},
           {"{subject way}", "", "expected `subject of least METRIC`"},
           {"{way", "", "opens or closes no number"},
           {"way}", "", "opens or closes no number"},
           {"{way}", "truth = fra;", "no Truth is called `fra`; did you mean `far`"}}) {
    EXPECT_FALSE(plan(claiming(wrong.text, wrong.more))) << wrong.text;
    EXPECT_NE(messages().find(wrong.message), std::string::npos) << wrong.text << "\n"
                                                                 << messages();
  }
}

// What is printed reads back as the same formula.
TEST(Formula, PrintsWhatItComputes) {
  struct Case {
    const char* text;
    double value;
  };
  for (const Case& one : std::initializer_list<Case>{{"a - (b - c)", 2. - (3. - 5.)},
                                                     {"a - b - c", 2. - 3. - 5.},
                                                     {"a / (b * c)", 2. / 15.},
                                                     {"a / b * c", 2. / 3. * 5.},
                                                     {"-a ^ 2", -4.},
                                                     {"(-a) ^ 2", 4.},
                                                     {"a ^ (b ^ 2)", 512.},
                                                     {"(a ^ b) ^ 2", 64.},
                                                     {"a > b ? a : b + c * 2", 13.},
                                                     {"(a > b ? a : b) * 2", 6.},
                                                     {"(a < b && !(b < a)) || a == c ? 1 : 0", 1.},
                                                     {"max(a, b, c) - mod(c, b)", 3.},
                                                     {"(2 m) ^ 2 / 1 m^2 + pi - pi", 4.},
                                                     // `g` and `s` are units, too.
                                                     {"(6 m) / g - (1 s) * s", 1.2 - 5.}}) {
    const auto formula = language::read_formula(one.text);
    ASSERT_TRUE(formula) << one.text;
    std::vector<double> names;
    for (const std::string& name : formula->names)
      names.push_back(name == "a" ? 2. : name == "b" ? 3. : 5.);
    EXPECT_DOUBLE_EQ(language::FormulaEvaluator(*formula)(names), one.value) << one.text;
    const auto again = language::read_formula(formula->text);
    ASSERT_TRUE(again) << formula->text;
    EXPECT_EQ(again->text, formula->text);
    EXPECT_DOUBLE_EQ(language::FormulaEvaluator(*again)(names), one.value) << formula->text;
  }
  EXPECT_FALSE(language::read_formula("a +"));
}

}  // namespace
}  // namespace hookpoint::studies
