// The runner with an engine of the test's own, whose motion is known: order of rows, bytes of
// results.csv, independence of the number of threads, resuming, failing rows.
#include <gtest/gtest.h>

#include <map>

#include "simulation/scene/load.h"
#include "studies/run/results_csv.h"
#include "studies/run/verdict.h"
#include "tests/support/study_runner.h"

namespace hookpoint::studies {
namespace {

constexpr const char* study = R"(
Study creep {
  scene = "scene.hook";
  duration = 1 s;
  settle = 0.2 s;
  Subject ours { engine = dts; contact = hookpoint; }
  Subject peer { engine = ode; settings = matched; Only slope { from = 15 deg; } }
  Sweep slope { from = 10 deg; to = 30 deg; step = 10 deg; }
  Sweep mu { values = 0.8, 1; }
  Measure creep_speed;
  Truth creep_speed { above = 2 mm/s; below = 2.4 mm/s; subjects = ours; }
  Plot fig5 { x = time; y = displacement; Only slope { values = 20 deg; } Only mu { values = 1; } }
}
)";

TEST_F(StudyRunner, ASweepTakesNoUnitFromAComment) {
  const auto plan = this->plan(
      "Let a = 5 deg; Study s { scene = \"scene.hook\"; duration = 1 s; settle = 0 s;\n"
      "  Sweep slope { values = a /* 3 kg */, 10 deg; } Subject ours { engine = dts; }\n"
      "  Measure slip_distance; }");
  ASSERT_TRUE(plan) << first_error();
  EXPECT_EQ(plan->sweeps[0].texts, (std::vector<std::string>{"5 deg", "10 deg"}));
}

TEST_F(StudyRunner, RowsAreOrderedSweepsOutermostSubjectsInnermost) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  std::string order;
  for (const RowPlan& row : plan->rows)
    order += std::to_string(row.values[0]) + std::to_string(row.values[1]) +
             std::to_string(row.subject) + " ";
  EXPECT_EQ(order, "000 010 100 101 110 111 200 201 210 211 ");
  EXPECT_EQ(plan->sweeps[0].column.unit, "deg");
  EXPECT_EQ(plan->sweeps[0].column.values, (std::vector<double>{10., 20., 30.}));
  const Experiment third = plan->experiment_of(plan->rows[2]);
  EXPECT_NEAR(std::get<contact::SlopeSurface>(third.terrain->surface).angle, 0.3490658503988659,
              1e-16);
  EXPECT_EQ(plan->rows[3].engine, "ode");
  EXPECT_EQ(plan->experiment_of(plan->rows[3]).settings, "matched");
}

TEST_F(StudyRunner, ResultsHaveTheColumnsAndValuesOfTheManual) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  const output::CsvTable table = results_table(run.result, false);
  EXPECT_EQ(table.header,
            (std::vector<std::string>{"slope [deg]", "mu", "subject", "engine", "law", "integrator",
                                      "settings", "creep_speed [m/s]",
                                      "creep_speed_predicted [m/s]", "creep_speed_ok", "status"}));
  ASSERT_EQ(table.rows.size(), 10u);
  EXPECT_EQ(table.rows[3][2], "peer");
  EXPECT_EQ(table.rows[3][4], "");
  EXPECT_EQ(table.rows[3][9], "");
  EXPECT_EQ(table.rows[2][4], "hookpoint");
  EXPECT_EQ(table.rows[2][8], "0");
  EXPECT_NEAR(*run.result.rows[2].metrics[0].measured, 2e-3 + 1e-3 * 0.3490658503988659, 1e-12);
  EXPECT_EQ(table.rows[2][9], "true");   // 2.35 mm/s
  EXPECT_EQ(table.rows[6][9], "false");  // 2.52 mm/s
  EXPECT_FALSE(all_truths_hold(run.result));
  EXPECT_EQ(run.result.rows[4].traces[0].read().time.size(), 101u);
  EXPECT_TRUE(run.result.rows[2].traces[0].read().time.empty());
  for (const char* file :
       {"results.csv", "experiment.hook", "scene.hook", "provenance.json", "traces/fig5_00004.csv"})
    EXPECT_TRUE(std::filesystem::exists(run.folder / file)) << file;
}

TEST_F(StudyRunner, EachRunHasItsRegimeAndEachTruthItsCounts) {
  // tan(30 deg) = 0.577: friction 0.8 and 1 hold at 10, 20 and 30 deg, 0.5 does not at 30.
  const auto plan = this->plan(
      replaced(replaced(study, "0.8, 1;", "0.8, 0.5;"), "scene =", "title = \"Who?\"; scene ="));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.title, "Who?");
  std::string regimes;
  for (const RunResult& row : run.result.rows) regimes += row.regime == Regime::slides ? 's' : 'h';
  EXPECT_EQ(regimes, "hhhhhhhhss");
  // 2 mm/s + 1 mm/s per radian is 2.17, 2.35 and 2.52 mm/s; the Truth covers `ours` alone.
  ASSERT_EQ(run.result.truths.size(), 1u);
  EXPECT_EQ(run.result.truths[0].passed, 4);
  EXPECT_EQ(run.result.truths[0].failed, 2);
  EXPECT_EQ(run.result.truths[0].first_failure, 6);
}

TEST_F(StudyRunner, ASignalThatCountsFromSettleStartsThereAtZero) {
  const auto plan = this->plan(replaced(study, "y = displacement", "y = drift"));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  const Trace trace = run.result.rows[4].traces[0].read();
  ASSERT_EQ(trace.time.size(), 81u);  // of 100 steps, those from 0.2 s
  EXPECT_EQ(trace.time.front(), 0.);
  EXPECT_EQ(trace.value.front(), 0.);
  EXPECT_NEAR(trace.time.back(), 0.8, 1e-12);
  EXPECT_NEAR(trace.value.back(), 0.8 * (2e-3 + 1e-3 * 0.3490658503988659), 1e-12);
}

TEST_F(StudyRunner, TheReportsProvenanceIsThatOfTheFile) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(read(run.folder / "provenance.json"), provenance_json(run.provenance));
  for (const auto& [name, value] : provenance_lines(run.provenance))
    if (name == "date" || name == "compiler" || name == "hash of the experiment") {
      EXPECT_NE(provenance_json(run.provenance).find('"' + value + '"'), std::string::npos) << name;
    }
}

TEST_F(StudyRunner, ADivergedRowIsNoSuccess) {
  const auto plan = this->plan(replaced(replaced(study, "0.8, 1;", "0.8, 13;"),
                                        "below = 2.4 mm/s; subjects = ours;",
                                        "below = 1 m/s; Only mu { to = 1; }"));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.truths[0].failed, 0);
  EXPECT_FALSE(all_truths_hold(run.result));
}

TEST_F(StudyRunner, BytesDoNotDependOnTheNumberOfThreads) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  run(*plan, "one", 1);
  run(*plan, "seven", 7);
  EXPECT_EQ(read(folder_ / "one/results.csv"), read(folder_ / "seven/results.csv"));
  EXPECT_FALSE(read(folder_ / "one/results.csv").empty());
}

TEST_F(StudyRunner, EachRowIsToldAsItFinishesAndIsThenInTheTable) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  for (const bool resume : {false, true}) {
    std::map<std::size_t, RunResult> told;
    RunOptions options{4, resume, folder_ / "told", {}, {}};
    options.row_done = [&](std::size_t row, const RunResult& result) {
      EXPECT_TRUE(told.emplace(row, result).second) << row;
    };
    const StudyRun run = run_study(*plan, engines_, options, stop_);
    ASSERT_EQ(told.size(), run.result.rows.size());
    for (const auto& [row, result] : told) {
      const RunResult& final = run.result.rows[row];
      EXPECT_EQ(result.parameters, final.parameters);
      EXPECT_EQ(result.subject, final.subject);
      EXPECT_EQ(result.status, final.status);
      EXPECT_EQ(result.metrics[0].measured, final.metrics[0].measured);
      EXPECT_EQ(result.metrics[0].predicted, final.metrics[0].predicted);
      EXPECT_EQ(result.metrics[0].ok, final.metrics[0].ok);
      EXPECT_EQ(result.traces[0].read().value, final.traces[0].read().value);
    }
  }
  this->run(*plan, "untold", 4);
  EXPECT_EQ(read(folder_ / "told/results.csv"), read(folder_ / "untold/results.csv"));
}

TEST_F(StudyRunner, AVerdictThatComparesRowsIsNotToldOfOneAlone) {
  const auto plan = this->plan(
      replaced(study, "above = 2 mm/s; below = 2.4 mm/s;", "same_over = slope; tolerance = 0.01;"));
  ASSERT_TRUE(plan) << first_error();
  RunOptions options{1, false, folder_ / "out", {}, {}};
  options.row_done = [](std::size_t, const RunResult& result) {
    EXPECT_FALSE(result.metrics[0].ok);
  };
  const StudyRun run = run_study(*plan, engines_, options, stop_);
  EXPECT_EQ(run.result.rows[0].metrics[0].ok, true);
  EXPECT_EQ(run.result.rows[6].metrics[0].ok, false);
}

TEST_F(StudyRunner, ARowsSettingsMakeItsExperimentOfItsScene) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  language::Library library(schema_, {});
  for (const RowPlan& row : plan->rows) {
    language::EvaluateOptions options;
    for (const std::string& setting : plan->settings_of(row)) {
      const std::size_t equals = setting.find('=');
      options.overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
    }
    language::Diagnostics found;
    const auto tree = library.evaluate(row.scene->file, options, found);
    ASSERT_TRUE(tree) << plan->name_of(row);
    const auto experiment = simulation::load_experiment(*tree, found, {});
    ASSERT_TRUE(experiment) << plan->name_of(row);
    const Experiment runs = plan->experiment_of(row);
    EXPECT_EQ(std::get<contact::SlopeSurface>(experiment->terrain->surface).angle,
              std::get<contact::SlopeSurface>(runs.terrain->surface).angle);
    EXPECT_EQ(experiment->materials[0].constants.static_friction,
              runs.materials[0].constants.static_friction);
    EXPECT_EQ(experiment->engine, runs.engine);
    EXPECT_EQ(experiment->settings, runs.settings);
    EXPECT_EQ(experiment->contact, runs.contact);
    EXPECT_EQ(experiment->duration, plan->duration);
    EXPECT_EQ(runs.duration, plan->duration);
  }
}

TEST_F(StudyRunner, ADivergedRowSaysWhenAndTheOthersRunOn) {
  const auto plan = this->plan(replaced(study, "0.8, 1;", "0.8, 13;"));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.rows[1].status, "not_finite at 0.51 s (block.base): halve deltat");
  EXPECT_FALSE(run.result.rows[1].metrics[0].measured);
  EXPECT_EQ(run.result.rows[1].metrics[0].ok, false);
  EXPECT_EQ(run.result.rows[2].status, "ok");
}

TEST_F(StudyRunner, AMissingEngineIsSkippedNeverPassed) {
  engines_.erase("ode");
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.rows[3].status, "skipped: engine ode is not on this machine");
  EXPECT_FALSE(run.result.rows[3].metrics[0].ok);
  EXPECT_FALSE(run.result.subjects[1].available);
}

TEST_F(StudyRunner, ResumesAfterAnInterruptToTheSameBytes) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  run(*plan, "whole");
  const std::string expected = read(folder_ / "whole/results.csv");
  const StudyRun cut = run(*plan, "cut", 1, false, [this](const Progress& progress) {
    if (progress.done == 4) stop_ = true;
  });
  EXPECT_TRUE(cut.interrupted);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut/results.csv"));
  stop_ = false;
  Slider::steps_taken = 0;
  const StudyRun resumed = run(*plan, "cut", 2, true);
  EXPECT_FALSE(resumed.interrupted);
  EXPECT_EQ(Slider::steps_taken, 6 * 100);
  EXPECT_EQ(read(folder_ / "cut/results.csv"), expected);
}

TEST_F(StudyRunner, ResumingNeverTakesRowsOfAnotherPlan) {
  const auto plan = this->plan(study);
  ASSERT_TRUE(plan) << first_error();
  run(*plan, "out");
  const auto longer = this->plan(replaced(study, "1 s", "2 s"));
  ASSERT_TRUE(longer) << first_error();
  EXPECT_NE(plan->hash, longer->hash);
  Slider::steps_taken = 0;
  run(*longer, "out", 1, true);
  EXPECT_EQ(Slider::steps_taken, 10 * 200);
}

TEST_F(StudyRunner, QuickTakesTheEndsOfSweepsAndAFifthOfTheTime) {
  const auto plan = this->plan(study, {true, {}});
  ASSERT_TRUE(plan) << first_error();
  EXPECT_EQ(plan->sweeps[0].column.values, (std::vector<double>{10., 30.}));
  EXPECT_DOUBLE_EQ(plan->duration, 0.2);
  EXPECT_DOUBLE_EQ(plan->settle, 0.04);
}

TEST_F(StudyRunner, OnlyRunsTheNamedSubject) {
  const auto plan = this->plan(study, {false, {"peer"}});
  ASSERT_TRUE(plan) << first_error();
  EXPECT_EQ(plan->rows.size(), 4u);
  EXPECT_FALSE(this->plan(study, {false, {"pear"}}));
  EXPECT_EQ(first_error(), "no Subject is called `pear`; did you mean `peer`?");
}

TEST_F(StudyRunner, MisspeltNamesAreErrorsBeforeAnythingRuns) {
  EXPECT_FALSE(plan(replaced(study, "Sweep slope", "Sweep slop")));
  EXPECT_EQ(first_error(), "no Param of the scene is called `slop`; did you mean `slope`?");
  EXPECT_FALSE(plan(replaced(study, "Measure creep_speed", "Measure creep_sped")));
  EXPECT_EQ(first_error(), "no metric is called `creep_sped`; did you mean `creep_speed`?");
  EXPECT_FALSE(plan(replaced(study, "subjects = ours", "subjects = our")));
  EXPECT_EQ(first_error(), "no Subject is called `our`; did you mean `ours`?");
  EXPECT_FALSE(plan(replaced(study, "scene.hook", "secne.hook")));
  EXPECT_EQ(first_error(), "no file \"secne.hook\" beside the study or in configs/");
}

TEST_F(StudyRunner, AUnitThatDoesNotFitTheSceneIsAnError) {
  EXPECT_FALSE(
      plan(replaced(study, "from = 10 deg; to = 30 deg; step = 10 deg", "values = 1 m, 2 m")));
  EXPECT_NE(first_error(), "");
}

constexpr const char* map = "Plot map { x = slope; y = mu; colour = creep_speed; }";

TEST_F(StudyRunner, AMapHasTwoSweepsAndAMetric) {
  const auto planned = plan(replaced(study, "Plot fig5", std::string(map) + " Plot fig5"));
  ASSERT_TRUE(planned) << first_error();
  const PlotSpec& spec = planned->plots.front().spec;
  EXPECT_EQ(spec.x_unit, "deg");
  EXPECT_EQ(spec.y_unit, "");
  EXPECT_EQ(spec.color_unit, "m/s");
}

TEST_F(StudyRunner, AMapOfWhatIsNotThereIsRefused) {
  const auto error_of = [&](const char* from, const char* to) {
    plan(replaced(study, "Plot fig5", replaced(map, from, to) + " Plot fig5"));
    return first_error();
  };
  EXPECT_NE(error_of("y = mu", "y = creep_speed").find("no Sweep is called `creep_speed`"),
            std::string::npos);
  EXPECT_NE(error_of("creep_speed", "tilt_max").find("no Measure of this study"),
            std::string::npos);
  EXPECT_NE(error_of("x = slope", "x = time").find("x and y are sweeps"), std::string::npos);
  EXPECT_NE(error_of("y = mu; colour", "y = creep_speed; outline").find("belongs to a map"),
            std::string::npos);
}

constexpr const char* panels =
    "Plot panels { x = slope; y = creep_speed; scale = log; panels = mu; axes = own; floor = 2 "
    "mm/s;"
    " Reference rigid_body { value = 3 mm/s; Only mu { values = 1; } } }";

TEST_F(StudyRunner, APlotMayHavePanelsAndReferences) {
  const auto planned = plan(replaced(study, "Plot fig5", std::string(panels) + " Plot fig5"));
  ASSERT_TRUE(planned) << first_error();
  const PlotSpec& spec = planned->plots.front().spec;
  EXPECT_EQ(spec.panels, std::vector<std::string>{"mu"});
  EXPECT_TRUE(spec.own_axes);
  EXPECT_EQ(spec.floor, 2e-3);
  ASSERT_EQ(spec.references.size(), 1u);
  EXPECT_EQ(spec.references[0].label, "rigid body");
  EXPECT_EQ(spec.references[0].value, 3e-3);
  EXPECT_EQ(spec.references[0].where, (SweepValues{{"mu", {1.}}}));
}

TEST_F(StudyRunner, WhatAMetricIsHeldAgainstHasItsUnit) {
  plan(replaced(study, "above = 2 mm/s", "above = 2 deg"));
  EXPECT_EQ(first_error(), "`above` is in m/s, not rad");
  plan(replaced(study, "Plot fig5", replaced(panels, "3 mm/s", "3 mm") + " Plot fig5"));
  EXPECT_EQ(first_error(), "`value` is in m/s, not m");
  plan(replaced(study, "Plot fig5", replaced(panels, "2 mm/s", "2 mm") + " Plot fig5"));
  EXPECT_EQ(first_error(), "`floor` is in m/s, not m");
}

TEST_F(StudyRunner, PanelsAreSweepsThatNothingElseShows) {
  const auto error_of = [&](const char* from, const char* to) {
    plan(replaced(study, "Plot fig5", replaced(panels, from, to) + " Plot fig5"));
    return first_error();
  };
  EXPECT_EQ(error_of("panels = mu", "panels = slop"),
            "no Sweep is called `slop`; did you mean `slope`?");
  EXPECT_EQ(error_of("panels = mu", "panels = slope"),
            "`slope` is already an axis or makes the curves");
  EXPECT_EQ(error_of("Only mu", "Only nu"), "no Sweep is called `nu`; did you mean `mu`?");
  EXPECT_NE(error_of("y = creep_speed", "y = mu; colour = creep_speed").find("a map has a panel"),
            std::string::npos);
}

}  // namespace
}  // namespace hookpoint::studies
