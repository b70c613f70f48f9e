// The runner with an engine of the test's own, whose motion is known: order of rows, bytes of
// results.csv, independence of the number of threads, resuming, failing rows.
// ctest: threads
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "simulation/scene/load.h"
#include "studies/report/figures.h"
#include "studies/results/pivot.h"
#include "studies/run/results_csv.h"
#include "studies/run/verdict.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
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

/// The study over other frictions; its figure is of the first.
std::string with_frictions(const std::string& values) {
  return replaced(replaced(study, "0.8, 1;", values), "Only mu { values = 1; }",
                  "Only mu { values = 0.8; }");
}

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
  const auto plan =
      this->plan(replaced(with_frictions("0.8, 0.5;"), "scene =", "title = \"Who?\"; scene ="));
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
  const auto plan =
      this->plan(replaced(with_frictions("0.8, 13;"), "below = 2.4 mm/s; subjects = ours;",
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
  const auto plan = this->plan(with_frictions("0.8, 13;"));
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "out");
  EXPECT_EQ(run.result.rows[1].status, "not_finite at 0.51 s (block.base): halve deltat");
  EXPECT_FALSE(run.result.rows[1].metrics[0].measured);
  EXPECT_EQ(run.result.rows[1].metrics[0].ok, false);
  EXPECT_EQ(run.result.rows[2].status, "ok");
}

TEST_F(StudyRunner, AMissingEngineIsSkippedNeverPassed) {
  const EngineEntry ours = engines_.at("dts");
  engines_ = {};
  engines_.add("dts", ours);
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

constexpr const char* scene_of_words = R"(
Param soil = clay;
Param law = hookpoint;
Param robot = "box.hook";
World world {
  deltat = 10 ms;
  contact = law;
  Material clay { static_friction = 0.9; kinetic_friction = 0.9; normal_stiffness = 3 N/m; }
  Material oak { static_friction = 0.4; kinetic_friction = 0.4; normal_stiffness = 3 N/m; }
  Terrain.Slope ground { angle = 10 deg; material = soil; }
  Include robot;
}
)";
constexpr const char* study_of_words = R"(
Study words {
  scene = "words.hook"; duration = 1 s;
  Sweep robot { values = "box.hook", "plate.hook"; }
  Sweep soil { values = clay, oak; }
  Sweep law { values = hookpoint, lugre; }
  Subject ours { engine = dts; }
  Subject some { engine = dts; Only soil { values = oak; } }
  Measure creep_speed;
  Truth creep_speed { below = 1 m/s; Only law { values = lugre; } }
  Table creep { rows = soil; columns = robot; value = creep_speed; }
  Plot by_soil { x = soil; y = creep_speed; series = law; Only robot { values = "plate.hook"; } }
}
)";

class WordStudies : public StudyRunner {
 protected:
  WordStudies() {
    write("words.hook", scene_of_words);
    write("box.hook", block("1 kg"));
    write("plate.hook", block("2 kg"));
  }
  static std::string block(const std::string& mass) {
    return "Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.2, 0.2, 0.1; "
           "mass = " +
           mass + "; } } }";
  }
  /// Of the world's first Material that a row's ground is made of.
  static double friction(const Experiment& experiment) {
    return experiment.materials[static_cast<std::size_t>(experiment.terrain->material)]
        .constants.static_friction;
  }
};

TEST_F(WordStudies, AScenesParamsTakeWordsAndFiles) {
  const auto plan = this->plan(study_of_words);
  ASSERT_TRUE(plan) << first_error();
  ASSERT_EQ(plan->rows.size(), 12U);
  EXPECT_EQ(plan->name_of(plan->rows[0]),
            "words (ours, robot = \"box.hook\", soil = clay, law = hookpoint)");
  const Experiment first = plan->experiment_of(plan->rows.front());
  const Experiment last = plan->experiment_of(plan->rows.back());
  EXPECT_EQ(first.contact, "hookpoint");
  EXPECT_EQ(last.contact, "lugre");
  EXPECT_EQ(friction(first), 0.9);
  EXPECT_EQ(friction(last), 0.4);
  EXPECT_EQ(first.robots[0].base.mass.mass, 1.);
  EXPECT_EQ(last.robots[0].base.mass.mass, 2.);
  EXPECT_EQ(plan->subjects[0].info.law, "hookpoint or lugre");
}

TEST_F(WordStudies, TheirResultsHoldTheWords) {
  const auto plan = this->plan(study_of_words);
  ASSERT_TRUE(plan) << first_error();
  StudyRun run = this->run(*plan, "out", 2);
  const output::CsvTable table = results_table(run.result, false);
  // `law` is swept: it has one column.
  EXPECT_EQ(table.header[2], "law");
  EXPECT_EQ(std::ranges::count(table.header, "law"), 1);
  EXPECT_EQ(table.rows.back()[0], "plate.hook");
  EXPECT_EQ(table.rows.back()[1], "oak");
  EXPECT_EQ(table.rows.back()[2], "lugre");
  EXPECT_EQ(run.result.truths[0].passed, 6);
  const Pivot pivot = pivot_of(run.result, run.result.tables[0]);
  EXPECT_EQ(pivot.rows, (std::vector<std::string>{"clay", "oak"}));
  EXPECT_EQ(pivot.columns, (std::vector<std::string>{"box.hook", "plate.hook"}));
  EXPECT_EQ(pivot.at(1, 0).rows, 4);
  const Figure figure = make_figure(run.result, 0);
  EXPECT_EQ(figure.plot.x.names, (std::vector<std::string>{"clay", "oak"}));
  EXPECT_EQ(figure.plot.series.size(), 4U);
  EXPECT_TRUE(figure.plot.series[0].scattered);
  const std::string script = output::plot_script(figure.plot);
  EXPECT_NE(script.find("('clay' 0, 'oak' 1)"), std::string::npos) << script;
  EXPECT_NE(script.find("xrange [-0.5:1.5]"), std::string::npos) << script;
  const std::string before = read(run.folder / "results.csv");
  const long steps = Slider::steps_taken;
  run.files.reset();
  EXPECT_EQ(read(this->run(*plan, "out", 1, true).folder / "results.csv"), before);
  EXPECT_EQ(Slider::steps_taken, steps);
}

TEST_F(WordStudies, EngineContactAndTerrainAreTheWorlds) {
  write("ice.hook",
        "Param seed = 1; Material ice { static_friction = 0.1; kinetic_friction = 0.1; }"
        "Terrain.Slope ground { angle = 20 deg; material = ice; }");
  write("turf.hook",
        "Param tilt = 10 deg; Material turf { static_friction = 0.7; kinetic_friction = 0.7; }"
        "Terrain.Slope ground { angle = tilt; material = turf; }");
  const auto plan = this->plan(R"(
Study grounds {
  scene = "words.hook"; duration = 1 s;
  Sweep terrain { values = "ice.hook", "turf.hook"; }
  Sweep engine { values = dts, ode; }
  Sweep contact { values = hookpoint, lugre; }
  Fix tilt { value = 5 deg; }
  Subject all { integrator = rk4; Fix law { value = lugre; } }
  Measure creep_speed;
})");
  ASSERT_TRUE(plan) << first_error();
  ASSERT_EQ(plan->rows.size(), 8U);
  const Experiment ours = plan->experiment_of(plan->rows[0]);
  const Experiment theirs = plan->experiment_of(plan->rows[7]);
  EXPECT_EQ(ours.engine, "dts");
  EXPECT_EQ(ours.contact, "hookpoint");
  EXPECT_EQ(ours.integrator, "rk4");
  EXPECT_EQ(friction(ours), 0.1);
  EXPECT_EQ(theirs.engine, "ode");
  EXPECT_EQ(friction(theirs), 0.7);
  EXPECT_NEAR(std::get<contact::SlopeSurface>(theirs.terrain->surface).angle, 5. * M_PI / 180.,
              1e-15);
  // A peer has a contact of its own: both laws are one run.
  EXPECT_EQ(plan->rows[6].hash, plan->rows[7].hash);
  EXPECT_NE(plan->rows[4].hash, plan->rows[5].hash);
  const output::CsvTable table = results_table(this->run(*plan, "out").result, false);
  EXPECT_EQ(table.rows[1][2], "lugre");
  EXPECT_EQ(std::ranges::count(table.header, "engine"), 1);
  const auto law = std::ranges::find(table.header, "law") - table.header.begin();
  EXPECT_EQ(table.rows[1][static_cast<std::size_t>(law)], "lugre");
  EXPECT_EQ(table.rows[7][static_cast<std::size_t>(law)], "");
  const ScenePlan scene = plan->scene_of(plan->rows[0]);
  EXPECT_TRUE(scene.ground && scene.ground->parameters.empty());
  EXPECT_EQ(plan->scene_of(plan->rows[7]).ground->parameters.at("tilt").substr(0, 8), "0.087266");
}

TEST_F(WordStudies, WhatIsWrongWithAWordHasItsPlace) {
  const auto told = [&](const std::string& from, const std::string& to) {
    EXPECT_FALSE(plan(replaced(study_of_words, from, to))) << to;
    const language::Diagnostic& first = diagnostics_.all().front();
    return std::to_string(first.position.file == nullptr
                              ? 0
                              : first.position.offset -
                                    std::min(first.position.offset,
                                             replaced(study_of_words, from, to).find(to))) +
           " " + first.message;
  };
  EXPECT_EQ(told("Sweep soil { values = clay, oak", "Sweep sol { values = clay, oak").substr(2),
            "no Param of the scene is called `sol`; did you mean `soil`?");
  EXPECT_EQ(told("clay, oak; }", "clay, 5; }"),
            "6 the values of `values` are all numbers or all words, not a number behind the word "
            "`clay`");
  EXPECT_EQ(told("clay, oak; }", "clay, clay; }"), "0 `clay` stands there twice");
  EXPECT_EQ(told("values = oak", "values = oka"),
            "9 no value of the Sweep soil is called `oka`; did you mean `oak`?");
  EXPECT_EQ(told("values = oak", "from = 3"),
            "7 `soil` has words, which have no order: give `values`");
  EXPECT_EQ(
      told("Sweep law { values = hookpoint, lugre", "Sweep contact { values = hookpoint, lugra")
          .substr(0, 62),
      "36 no contact is called `lugra`; did you mean `lugre`?");
  EXPECT_EQ(told("series = law;", "scale = log_x;"),
            "8 `soil` has words: its axis cannot be logarithmic");
}

TEST_F(WordStudies, AWordThatTheSceneCannotTakeHasItsPlaceInTheStudy) {
  const std::string text =
      "Study s { scene = \"words.hook\"; duration = 1 s; Sweep law { values = hookpoint, lugra; } "
      "Subject ours { engine = dts; } Measure creep_speed; }";
  EXPECT_FALSE(plan(text));
  const auto& all = diagnostics_.all();
  const auto found =
      std::ranges::find(all, language::Severity::error, &language::Diagnostic::severity);
  ASSERT_NE(found, all.end());
  const language::Diagnostic& first = *found;
  EXPECT_EQ(first.message.substr(0, 20), "`lugra` is no value ");
  EXPECT_EQ(first.position.offset, text.find("lugra"));
  EXPECT_EQ(first.position.length, 5U);
}

TEST_F(WordStudies, ThePagesExampleIsPlannedAsItSays) {
  const std::filesystem::path page =
      std::filesystem::path(testing::source_folder()) / "docs/studies.md";
  std::string example;
  for (const testing::PageBlock& block : testing::blocks_of(read(page))) {
    if (block.name == "soils.hook") example = block.text;
    if (!block.name.empty()) write(block.name, block.text);
  }
  const auto plan = this->plan(example);
  ASSERT_TRUE(plan) << first_error();
  EXPECT_EQ(plan->rows.size(), 12U);
}

TEST_F(StudyRunner, SeedsRunEachRowAndATruthJudgesTheirMean) {
  // With a Param `seed` that the slope follows from: the slider itself knows no chance.
  write("scene.hook",
        "Param seed = 7;\n" + replaced(slider_scene, "angle = slope", "angle = slope * seed"));
  const std::string text = R"(
Study seeded {
  scene = "scene.hook"; duration = 1 s; seeds = 3;
  Sweep mu { values = 0.8, 1; }
  Fix slope { value = 0.1; }
  Subject ours { engine = dts; }
  Subject peer { engine = ode; }
  Measure creep_speed;
  Truth mean { metric = creep_speed; equals = value; value = 2.2 mm/s; within = 0.05 mm/s; }
  Truth low { metric = creep_speed; below = 2.15 mm/s; Only mu { values = 1; } }
  Plot by_mu { x = mu; y = creep_speed; }
  Plot path { x = time; y = displacement; }
})";
  const auto plan = this->plan(text);
  ASSERT_TRUE(plan) << first_error();
  ASSERT_EQ(plan->rows.size(), 12U);
  EXPECT_EQ(plan->seeds, (std::set<std::uint64_t>{1, 2, 3}));
  const StudyRun run = this->run(*plan, "out");
  const output::CsvTable table = results_table(run.result, false);
  EXPECT_EQ(table.header[1], "seed");
  EXPECT_EQ(table.rows[5][1], "3");
  // 2 mm/s and 0.1, 0.2, 0.3 mm/s: mean 2.2, s = 0.1; only the mean is within 0.05 of it.
  EXPECT_NEAR(*run.result.rows[0].metrics[0].measured, 2.1e-3, 1e-12);
  EXPECT_EQ(run.result.truths[0].passed, 4);
  EXPECT_EQ(run.result.truths[1].failed, 2);
  EXPECT_EQ(run.result.truths[1].first_failure, 6);
  const Figure figure = make_figure(run.result, 0);
  ASSERT_EQ(figure.plot.series.size(), 2U);
  const output::Series& ours = figure.plot.series[0];
  EXPECT_NEAR(ours.measured.y[0], 2.2e-3, 1e-12);
  EXPECT_NEAR(ours.half_widths.at(0), 4.302652729911275 * 1e-4 / std::sqrt(3.), 1e-12);
  const std::string script = output::plot_script(figure.plot);
  EXPECT_NE(script.find("yerrorbars"), std::string::npos);
  EXPECT_EQ(output::plot_data(figure.plot).substr(0, 51),
            "series,kind,mu,creep speed [m/s],half_width [m/s]\no");
  const Figure path = make_figure(run.result, 1);
  EXPECT_NEAR(path.plot.series.at(0).measured.y.back(), 2.2e-3, 1e-12);
  EXPECT_FALSE(this->plan(replaced(text, "Sweep mu { values = 0.8, 1; }",
                                   "Sweep seed { values = 1, 2; } Sweep mu { values = 1; }")));
  EXPECT_EQ(first_error(), "`seeds` varies the Param `seed`: it cannot be swept or fixed");
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
  EXPECT_EQ(first_error(),
            "no metric is called `creep_sped` (one of your own says what it is `of`); did you mean "
            "`creep_speed`?");
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
