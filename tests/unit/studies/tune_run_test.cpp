// Tunings from their files: what a Tune says, another ground under a scene, and whole searches
// whose answer is a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "studies/tune/outputs.h"
#include "tests/support/command.h"
#include "tests/support/planned.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

/// A unit mass on one point whose spring and damper along the ground say next to nothing. Its step
/// is long, and stable up to 150 kN/m: what takes time here is the number of steps.
constexpr const char* point_scene = R"(
Param height = 0 m;
Param unused = 1;
World world {
  gravity = 9.81;
  deltat = 5 ms;
  duration = 4 s;
  Material floor {
    normal_stiffness = 5 kN/m; normal_damping = 10 N.s/m; tangential_stiffness = 1 N/m; tangential_damping = 0 N.s/m;
  }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, height; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)";

/// The stiffest floor on which steps of 10 ms are stable.
constexpr const char* stiffest = R"(
Tune stiffest {
  scene = "scene.hook";
  settle = 3 s;
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Objective penetration_mean { minimise; }
  Require stable_step { above = 10 ms; }
  method = cmaes; population = 8; generations = 12; seeds = 2; samples = 16;
}
)";

class TuneFile : public ::testing::Test {
 protected:
  TuneFile() : application_({}, [this](const language::Diagnostics& found) { tell(found); }) {
    place_.file("scene.hook", point_scene);
  }

  std::vector<TunePlan> plans(const std::string& text, bool quick = false) {
    told_.clear();
    // A file is read once: each text has a name of its own.
    const std::string name = "tune" + std::to_string(++files_) + ".hook";
    return planned_tunes(application_, place_.file(name, text), quick);
  }

  /// The folder that a tuning of the plan left.
  TuneResult run(const TunePlan& plan, const std::string& folder, int jobs, bool resume = false,
                 std::size_t stop_after = 0) {
    std::atomic<bool> stop = false;
    TuneOptions options;
    options.run.jobs = jobs;
    options.run.resume = resume;
    options.run.folder = place_.folder() / folder;
    options.run.progress = [&](const Progress& progress) {
      if (stop_after > 0 && progress.done >= stop_after) stop = true;
    };
    const TuneRun tuning = run_tuning(plan, application_.engines(), options, stop);
    write_tuning(*tuning.files, plan, tuning, "hookpoint tune tune.hook");
    return tuning.result;
  }

  void tell(const language::Diagnostics& found) {
    for (const language::Diagnostic& diagnostic : found.all())
      if (diagnostic.severity == language::Severity::error) told_ += diagnostic.message + "\n";
  }

  Workplace place_;
  std::string told_;
  application::Application application_;
  int files_ = 0;
};

TEST_F(TuneFile, FindsTheStiffestFloorThatAStepAllows) {
  // An index of so wide a range needs more samples than the other tests do.
  std::string text = stiffest;
  text.replace(text.find("samples = 16"), 12, "samples = 64");
  const auto found = plans(text);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TuneResult result = run(found[0], "out", 2);
  EXPECT_TRUE(result.holds(found[0]));
  // Semi-implicit Euler on m x'' = -k x - c x' is stable while dt^2 k + 2 dt c < 4 m.
  const double stiffest_allowed = (4. - 2. * 0.01 * 10.) / (0.01 * 0.01) / 1e3;  // [kN/m]
  EXPECT_LT(*result.best().values[0], stiffest_allowed);
  EXPECT_GT(*result.best().values[0], 0.97 * stiffest_allowed);
  // It rests m g/k deep.
  const double depth = 9.81 / (*result.best().values[0] * 1e3);
  EXPECT_NEAR(*value_of(found[0].objectives[0], result.best()), depth, 1e-4 * depth);
  // The files' own 5 kN/m are softer; without a random number, seeds make no difference.
  const ObjectiveComparison& own = result.references[0].comparisons[0];
  EXPECT_EQ(own.verdict, ObjectiveComparison::Verdict::better);
  EXPECT_EQ(own.margin, 0.);
  EXPECT_EQ(*result.references[0].comparisons[0].other,
            *value_of(found[0].objectives[0], result.candidates[0]));
  EXPECT_EQ(result.candidates[0].values[0], 5.);
  // One constant explains all of the variance.
  ASSERT_TRUE(result.indices[0]);
  EXPECT_NEAR(result.indices[0]->total[0], 1., 0.5);
}

TEST_F(TuneFile, LeavesTheSameBytesForAnyThreadsInterruptedAndResumed) {
  const auto found = plans(stiffest);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TuneResult whole = run(found[0], "whole", 1);
  EXPECT_FALSE(whole.interrupted);
  run(found[0], "threads", 3);
  const TuneResult part = run(found[0], "resumed", 2, false, 75);
  EXPECT_TRUE(part.interrupted);
  EXPECT_NE(place_.read("resumed/recommended.json").find("\"complete\": false"), std::string::npos);
  EXPECT_LT(part.candidates.size(), whole.candidates.size());
  EXPECT_FALSE(run(found[0], "resumed", 2, true).interrupted);
  for (const char* file : {"evaluations.csv", "pareto.csv", "recommended.json", "sobol.csv",
                           "materials/floor_tuned.hook", "scene.hook", "experiment.hook",
                           "depth_over_time.csv", "one_at_a_time_penetration_mean.svg"}) {
    const std::string bytes = place_.read(std::filesystem::path("whole") / file);
    EXPECT_FALSE(bytes.empty()) << file;
    EXPECT_EQ(bytes, place_.read(std::filesystem::path("threads") / file)) << file;
    EXPECT_EQ(bytes, place_.read(std::filesystem::path("resumed") / file)) << file;
  }
}

TEST_F(TuneFile, GivesAMaterialThatRunsAsTheCandidateRan) {
  const auto found = plans(stiffest, true);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TuneResult result = run(found[0], "out", 2);
  const std::string scene =
      "Include \"out/materials/floor_tuned.hook\";\nWorld world { Terrain.Flat ground { material = "
      "floor_tuned; } }\n";
  const auto experiment = application_.load(place_.file("included.hook", scene), {});
  ASSERT_TRUE(experiment) << told_;
  EXPECT_EQ(experiment->materials.front().constants.normal_stiffness,
            found[0].varied[0].unit.to_si(*result.best().values[0]));
  EXPECT_EQ(experiment->materials.front().constants.tangential_stiffness, 1.);
  EXPECT_TRUE(application_.load(place_.folder() / "out/scene.hook", {})) << told_;
}

TEST_F(TuneFile, PutsAnotherGroundUnderAScene) {
  place_.file("slope.hook", R"(
Param fall = 3 deg;
Param stiffness = 7 kN/m;
Param seed = 1;
Material turf { normal_stiffness = stiffness; static_friction = 0.5 + seed / 100; }
Terrain.Slope ground { angle = fall; material = turf; }
)");
  const std::string text = R"(
Tune ground {
  scene = "scene.hook"; terrain = "slope.hook";
  Vary stiffness { from = 1 kN/m; to = 9 kN/m; }
  Vary height { from = 0 mm; to = 5 mm; }
  Vary normal_damping { from = 1 N.s/m; to = 9 N.s/m; }
  Objective creep_speed { minimise; }
  Objective penetration_max { minimise; }
}
)";
  const auto found = plans(text);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TunePlan& plan = found[0];
  EXPECT_EQ(plan.scene->material(), "turf");
  EXPECT_EQ(plan.varied[0].place, ConstantPlace::parameter);
  EXPECT_EQ(plan.varied[1].place, ConstantPlace::parameter);
  EXPECT_EQ(plan.varied[2].place, ConstantPlace::material_field);
  EXPECT_EQ(plan.own[0], 7.);
  EXPECT_EQ(plan.own[1], 0.);
  EXPECT_EQ(plan.own[2], 300.);  // the class's default
  language::Diagnostics diagnostics;
  const auto scene = plan.scene->load(plan.settings({2.5, 4., 6.}), 3, diagnostics);
  ASSERT_TRUE(scene);
  const simulation::Experiment& experiment = scene->experiment;
  EXPECT_DOUBLE_EQ(std::get<contact::SlopeSurface>(experiment.terrain->surface).angle,
                   3. * std::numbers::pi / 180.);
  ASSERT_EQ(experiment.materials.size(), 1u);
  EXPECT_EQ(experiment.materials[0].name, "turf");
  EXPECT_EQ(experiment.materials[0].constants.normal_stiffness, 2500.);
  EXPECT_EQ(experiment.materials[0].constants.normal_damping, 6.);
  EXPECT_EQ(experiment.materials[0].constants.static_friction, 0.53);
  EXPECT_EQ(experiment.robots[0].location.z, 0.004);
  EXPECT_EQ(experiment.seed, 3u);
  EXPECT_EQ(experiment.duration, 4.);
  // As printed it is a file that means the same.
  const auto again =
      application_.load(place_.file("printed.hook", language::print(*scene->tree)), {});
  ASSERT_TRUE(again) << told_;
  EXPECT_EQ(again->materials[0].constants.normal_damping, 6.);
}

TEST_F(TuneFile, TakesTheAnalyticGuessFromAdvice) {
  // 9.81 N may sink 1 mm by default: k = 9.81 kN/m.
  const auto found = plans(stiffest, true);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TuneResult result = run(found[0], "out", 1);
  ASSERT_EQ(result.references.size(), 2u) << result.analytic_words;
  EXPECT_NEAR(*result.candidates[result.references[1].candidate].values[0], 9.81, 1e-4);
}

TEST_F(TuneFile, FindsTheParamsThatComeNearestToTheAdvice) {
  place_.file("soft.hook", R"(
Param sink = 4 mm;
Param other = 1;
Material soft { normal_stiffness = 9.81 N / sink; normal_damping = 10 * other; tangential_stiffness = 1; tangential_damping = 0; nominal_penetration = 2 mm; }
Terrain.Flat ground { material = soft; }
)");
  const auto found = plans(R"(
Tune soft {
  scene = "scene.hook"; terrain = "soft.hook";
  Vary sink { from = 0.1 mm; to = 10 mm; scale = log; }
  Objective penetration_max { minimise; }
  method = cmaes; population = 8; generations = 1; seeds = 1; samples = 0;
}
)");
  ASSERT_EQ(found.size(), 1u) << told_;
  const TuneResult result = run(found[0], "out", 1);
  ASSERT_EQ(result.references.size(), 2u) << result.analytic_words;
  EXPECT_NEAR(*result.candidates[result.references[1].candidate].values[0], 2., 0.01);
}

TEST_F(TuneFile, SaysWhatIsWrongWithATune) {
  const auto with = [](const std::string& change) {
    return "Tune t { scene = \"scene.hook\"; " + change + " }\n";
  };
  const std::string good =
      "Vary normal_stiffness { from = 1 kN/m; to = 9 kN/m; } Objective fell { minimise; }";
  const std::pair<std::string, std::string> wrong[] = {
      {good + " terrain = \"nowhere.hook\";", "no file \"nowhere.hook\""},
      {good + " material = flor;", "no Material `flor`; did you mean `floor`?"},
      {"Vary normal_stifness { from = 1; to = 2; } Objective fell { minimise; }",
       "did you mean `normal_stiffness`?"},
      {"Vary normal_stiffness { from = 2; to = 1; } Objective fell { minimise; }",
       "`to` must be greater"},
      {"Vary normal_stiffness { from = 0; to = 1; scale = log; } Objective fell { minimise; }",
       "begins above 0"},
      {"Vary normal_stiffness { from = 1 m; to = 2 m; } Objective fell { minimise; }", "N/m"},
      {"Vary normal_stiffness { from = 1; to = 2; }", "needs an Objective"},
      {"Objective fell { minimise; }", "needs a Vary"},
      {good + " Objective unrest;", "one of `minimise;`, `maximise;` and `target = `"},
      {good + " Objective unrest { minimise; target = 0.1; }", "one of `minimise;`"},
      {good + " Objective stable_step { target = 1 m; }", "`target` is in s"},
      {good + " Objective sink { minimise; }", "a Measure defines one of your own"},
      {good + " Measure sink { of = point.position.z; } Objective sinks { minimise; }",
       "did you mean `sink`?"},
      {good + " Measure sink { of = point.postion.z; }", "did you mean `position`?"},
      {good + " Measure sink { of = point.position.z; predicted = height; }",
       "leave `predicted` out"},
      {good + " Measure sink { of = point.position.z; from = 4 s; }", "a run ends at 4 s"},
      {good + " Measure sink { trace = drop; }", "no Trace of the study's Cases"},
      {good + " Measure sink { of = point.position.z; } Require sink { below = 1 s; }",
       "`below` is in m"},
      {good + " Measure step_time;", "never the same twice"},
      {good + " Vary unused { from = 1; to = 2; }", "`unused` changes nothing in the scene"},
      {good + " Objective fel { minimise; }", "did you mean `fell`?"},
      {good + " Objective step_time { minimise; }", "never the same twice"},
      {good + " Objective peer_distance { minimise; }", "several runs together"},
      {good + " Require fell;", "says `equals`, `above` or `below`"},
      {good + " Require stable_step { above = 1 m; }", "`above` is in s"},
      {good + " population = 10;", "a multiple of 4"},
      {good + " method = cmaes; Objective unrest { minimise; }", "cmaes takes one Objective"},
      {good + " settle = 5 s;", "nothing would be measured"},
      {good + " Subject a { Only slope { to = 1; } }", "sweeps nothing"},
      {good + " Fix wight { value = 1; }", "no Param of the scene is called `wight`"},
      {"Vary restitution { from = 0.5; to = 1.5; } Objective fell { minimise; }", "1.5"},
  };
  for (const auto& [text, message] : wrong) {
    EXPECT_TRUE(plans(with(text)).empty()) << text;
    EXPECT_NE(told_.find(message), std::string::npos) << text << "\n" << told_;
  }
  EXPECT_EQ(plans(with(good)).size(), 1u) << told_;
}

/// A metric of the user's own, which the floor is to make 3 mm.
constexpr const char* wanted_sink = R"(
Tune sink_of_3_mm {
  scene = "scene.hook";
  settle = 3 s;
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Measure sink { of = -point.position.z; take = mean; unit = mm; }
  Objective sink { target = 3 mm; }
  Require sink { above = 1 mm; below = 5 mm; }
  method = cmaes; population = 8; generations = 12; seeds = 2; samples = 16;
}
)";

TEST_F(TuneFile, BringsAMetricOfTheUsersOwnToItsTarget) {
  const auto found = plans(wanted_sink);
  ASSERT_EQ(found.size(), 1u) << told_;
  const TunePlan& plan = found[0];
  EXPECT_EQ(plan.unit_of(plan.objectives[0]), "mm");
  EXPECT_EQ(plan.label_of(plan.objectives[0]), "distance of sink from 3 mm");
  EXPECT_EQ(plan.requirements[0].words, "sink is above 1 mm and is below 5 mm");
  const TuneResult result = run(plan, "out", 2);
  EXPECT_TRUE(result.holds(plan));
  // It rests m g/k deep.
  const double stiffness = 9.81 / 3e-3 / 1e3;  // [kN/m]
  EXPECT_NEAR(*result.best().values[0], stiffness, 2e-3 * stiffness);
  const double sink = 9.81 / *result.best().values[0];  // [mm]
  EXPECT_NEAR(*value_of(plan.objectives[0], result.best()), std::abs(sink - 3.), 1e-4);
  // The files' own 5 kN/m are 1.962 mm deep.
  EXPECT_NEAR(*result.references[0].comparisons[0].other, 3. - 1.962, 1e-4);
  EXPECT_EQ(result.references[0].comparisons[0].verdict, ObjectiveComparison::Verdict::better);
  const std::string json = place_.read("out/recommended.json");
  for (const char* part : {R"("unit": "mm")", R"("direction": "target")", R"("target": 3)",
                           R"("distance": )", R"("of": "distance of sink from 3 mm")"})
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  EXPECT_NE(place_.read("out/evaluations.csv")
                .find("sink [mm],sink_error [mm],sink_seeds [mm],sink_distance [mm],"
                      "sink_distance_error [mm]"),
            std::string::npos);
  EXPECT_NE(place_.read("out/pareto.csv")
                .find("sink [mm],sink_error [mm],sink_distance [mm],sink_distance_error [mm]"),
            std::string::npos);
  const std::string page = place_.read("out/report.html");
  for (const char* part : {"sink = 3 mm", " off", "distance of sink from 3 mm"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(TuneFile, AnotherDefinitionOfAMeasureIsAnotherRun) {
  const auto one = plans(wanted_sink);
  std::string text = wanted_sink;
  text.replace(text.find("take = mean"), 11, "take = last");
  const auto other = plans(text);
  ASSERT_EQ(one.size() + other.size(), 2u) << told_;
  EXPECT_NE(one[0].runs_hash, other[0].runs_hash);
}

TEST_F(TuneFile, AnEvenFunctionAndAFactorOfZeroMayBeVaried) {
  std::string scene = point_scene;
  scene.replace(scene.find("Param height = 0 m;"), 19,
                "Param height = 0 m; Param tilt = 0; Param part = 0; Param turn = 0;");
  scene.replace(scene.find("location = 0, 0, height"), 23,
                "location = tilt^2 * 1 m, tilt * part * 1 m, height + sin(2 * pi * turn) * 1 m");
  place_.file("even.hook", scene);
  const auto found = plans(R"(
Tune even {
  scene = "even.hook";
  Vary tilt { from = -1; to = 1; }
  Vary part { from = -1; to = 1; }
  Vary turn { from = -1; to = 1; }
  Objective penetration_max { minimise; }
}
)");
  EXPECT_EQ(found.size(), 1u) << told_;
}

TEST_F(TuneFile, TunesEachSubjectByItself) {
  const auto found = plans(R"(
Tune both {
  scene = "scene.hook";
  Vary normal_stiffness { from = 1 kN/m; to = 9 kN/m; }
  Objective penetration_max { minimise; }
  Subject ours { contact = nominal; }
  Subject theirs { engine = ode; settings = matched; }
}
)");
  ASSERT_EQ(found.size(), 2u) << told_;
  EXPECT_EQ(found[0].label, "both_ours");
  EXPECT_EQ(found[0].runs.subjects[0].info.law, "nominal");
  EXPECT_EQ(found[1].runs.subjects[0].info.engine, "ode");
  EXPECT_EQ(found[1].runs.subjects[0].info.settings, "matched");
  EXPECT_NE(found[0].runs_hash, found[1].runs_hash);
}

}  // namespace
}  // namespace hookpoint::studies
