// Calibrations from their files: what a Calibrate says, which constants a subject has, cases and
// folds, and the same answer however it is run.
// ctest: released
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "output/files/csv.h"
#include "studies/calibrate/outputs.h"
#include "studies/calibrate/subject_name.h"
#include "studies/report/page_parts.h"
#include "tests/support/command.h"
#include "tests/support/planned.h"

namespace hookpoint::studies {
namespace {

using testing::Workplace;

constexpr double gravity = 9.81, stiffness = 8e3, damping = 18.;

/// A unit mass on one point, at rest on the ground's surface.
constexpr const char* point_scene = R"(
Param height = 0 m;
Param weight_factor = 1;
World world {
  gravity = 9.81 * weight_factor;
  deltat = 1 ms;
  integrator = rk4;
  Material floor { normal_stiffness = 10 kN/m; normal_damping = 10 N.s/m; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { location = 0, 0, height; mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)";

constexpr const char* two_constants = R"(
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Vary normal_damping { from = 1 N.s/m; to = 100 N.s/m; scale = log; }
)";

/// z'' = -factor g - k z - c z' from rest, with a ripple in the place of noise.
double height_at(double time, double factor, double k) {  // [m]
  const double depth = factor * gravity / k, rate = 0.5 * damping;
  const double frequency = std::sqrt(k - rate * rate);
  const double wave = std::cos(frequency * time) + rate / frequency * std::sin(frequency * time);
  return -depth + depth * std::exp(-rate * time) * wave;
}

std::string oscillation(double factor, int samples = 60, double ripple = 0., double k = stiffness) {
  std::string text = "time [s],z [mm],v [m/s]\n";
  for (int i = 0; i <= samples; ++i) {
    // Between two steps, too.
    const double time = 2.5e-3 * i;
    const double wobble = ripple * std::sin(1.7 * i * i + factor);
    text += std::to_string(time) + "," + std::to_string(1e3 * height_at(time, factor, k) + wobble) +
            ",0\n";
  }
  return text;
}

class CalibrateFile : public ::testing::Test {
 protected:
  CalibrateFile() : application_({}, [this](const language::Diagnostics& found) { tell(found); }) {
    place_.file("scene.hook", point_scene);
    place_.file("drop.csv", oscillation(1., 60, 0.01));
  }

  static std::string trace(const std::string& more = "", const std::string& file = "drop.csv",
                           const std::string& name = "drop") {
    return "Trace " + name + " { file = \"" + file +
           "\"; column = \"z\"; of = point.base.location.z; weight = 1 / (0.01 mm); " + more +
           "}\n";
  }
  static std::string block(const std::string& inside) {
    return "Calibrate floor {\n  scene = \"scene.hook\";\n  starts = 4;\n" + inside + "}\n";
  }

  std::optional<CalibrationPlan> plan(const std::string& text) {
    told_.clear();
    warned_.clear();
    const std::string name = "calibrate" + std::to_string(++files_) + ".hook";
    auto found = planned_calibrations(application_, place_.file(name, text));
    if (found.size() != 1) return std::nullopt;
    return std::move(found.front());
  }

  CalibrationResult run(const CalibrationPlan& plan, const std::string& folder, int jobs = 2,
                        bool resume = false, std::size_t stop_after = 0) {
    std::atomic<bool> stop = false;
    CalibrationOptions options;
    options.run.jobs = jobs;
    options.run.resume = resume;
    options.run.folder = place_.folder() / folder;
    options.run.progress = [&](const Progress& progress) {
      if (stop_after > 0 && progress.done >= stop_after) stop = true;
    };
    const CalibrationRun run = run_calibration(plan, application_.engines(), options, stop);
    undrawn_ = undrawn(write_calibration(*run.files, plan, run, "hookpoint tune calibrate.hook"));
    return run.result;
  }

  void tell(const language::Diagnostics& found) {
    for (const language::Diagnostic& diagnostic : found.all())
      (diagnostic.severity == language::Severity::error ? told_ : warned_) +=
          diagnostic.message + "\n";
  }
  bool refused(const std::string& inside, const std::string& why) {
    return !plan(block(inside)) && told_.find(why) != std::string::npos;
  }

  Workplace place_;
  std::string told_, warned_;
  std::vector<std::string> undrawn_;
  application::Application application_;
  int files_ = 0;
};

TEST_F(CalibrateFile, AnEvenFunctionOfAConstantIsNoneThatChangesNothing) {
  place_.file("even.hook", R"(
Param tilt = 0.2;
World world {
  gravity = 9.81 * (0.75 + tilt^2);
  deltat = 1 ms;
  integrator = rk4;
  Material floor { normal_stiffness = 8 kN/m; normal_damping = 18 N.s/m; }
  Terrain.Flat ground { material = floor; }
  Robot point { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } }
}
)");
  const auto found =
      plan("Calibrate even {\n  scene = \"even.hook\"; starts = 4; resamples = 0;\n" + trace() +
           "Vary tilt { from = -1; to = 1; }\n}\n");
  ASSERT_TRUE(found) << told_;
  const CalibrationResult result = run(*found, "even");
  EXPECT_TRUE(result.subjects[0].left_out.empty());
  ASSERT_EQ(result.subjects[0].constants.size(), 1U);
  // Gravity is 9.81 at 0.5 and at -0.5.
  EXPECT_NEAR(std::abs(found->varied[0].at(result.subjects[0].constants[0].share)), 0.5, 0.01);
}

TEST_F(CalibrateFile, TheSameForAnyNumberOfThreadsAndWhenItIsResumed) {
  const auto found = plan(block(std::string("resamples = 40;\n") + trace() + two_constants));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult one = run(*found, "one", 1);
  ASSERT_EQ(one.subjects.size(), 1U);
  ASSERT_EQ(one.subjects[0].constants.size(), 2U);
  const auto value = [&](std::size_t i) {
    return found->varied[i].at(one.subjects[0].constants[i].share);
  };
  EXPECT_NEAR(value(0), 8., 0.02);  // [kN/m]
  EXPECT_NEAR(value(1), 18., 0.2);  // [N s/m]
  EXPECT_LT(*one.subjects[0].error, 1.);
  EXPECT_GT(*one.subjects[0].own_error, 10.);
  EXPECT_TRUE(one.subjects[0].constants[0].identifiable);
  run(*found, "three", 3);
  const CalibrationResult cut = run(*found, "cut", 2, false, 20);
  EXPECT_TRUE(cut.interrupted);
  EXPECT_FALSE(cut.subjects[0].constants.empty());
  EXPECT_FALSE(cut.subjects[0].constants[0].identifiable);
  EXPECT_NE(place_.read("cut/report.html").find("Interrupted"), std::string::npos);
  EXPECT_FALSE(run(*found, "cut", 2, true).interrupted);
  for (const char* file : {"calibration.csv", "correlations.csv", "evaluations.csv", "curves.csv",
                           "own_curves.csv", "materials/floor_scene.hook", "trace_drop.svg"}) {
    const std::string whole = place_.read(std::filesystem::path("one") / file);
    EXPECT_FALSE(whole.empty()) << file;
    EXPECT_EQ(whole, place_.read(std::filesystem::path("three") / file)) << file;
    EXPECT_EQ(whole, place_.read(std::filesystem::path("cut") / file)) << file;
  }
}

TEST_F(CalibrateFile, ConstantsThatASubjectDoesNotReadAreLeftOut) {
  // An impulse law advances time itself.
  std::string scene = point_scene;
  scene.erase(scene.find("  integrator = rk4;\n"), 20);
  place_.file("scene.hook", scene);
  const auto found =
      plan(block(std::string("subjects = hookpoint, hunt_crossley, impulse;\n"
                             "resamples = 10;\n") +
                 trace() + two_constants + "Vary static_friction { from = 0.8; to = 2; }\n"));
  ASSERT_TRUE(found) << told_;
  ASSERT_EQ(found->subjects.size(), 3U);
  const CalibrationResult result = run(*found, "out");
  const auto& hookpoint = result.subjects[0];
  ASSERT_EQ(hookpoint.constants.size(), 2U);
  ASSERT_EQ(hookpoint.left_out.size(), 1U);
  EXPECT_EQ(hookpoint.left_out[0].reason, "no trace changes with it");
  // Hunt and Crossley's damping is another constant.
  const auto& crossley = result.subjects[1];
  ASSERT_EQ(crossley.constants.size(), 1U);
  EXPECT_EQ(crossley.left_out.front().reason, "the law hunt_crossley does not read it");
  EXPECT_GT(*crossley.error, *hookpoint.error);
  // An impulse law has neither.
  EXPECT_EQ(result.subjects[2].status, "none of the constants changes a trace");
  EXPECT_TRUE(result.subjects[2].constants.empty());
  const std::string table = place_.read("out/calibration.csv");
  EXPECT_NE(table.find("impulse,normal_stiffness,kN/m,,,,no,,left out"), std::string::npos)
      << table;
}

TEST_F(CalibrateFile, TracesWithSettingsOfTheirOwnAreCasesThatFoldsHoldOut) {
  std::string traces = "folds = 3;\nresamples = 40;\nbootstrap = one_step;\n";
  for (int i = 0; i < 6; ++i) {
    const double factor = 0.7 + 0.1 * i;
    const std::string number = std::to_string(i);
    place_.file("drop" + number + ".csv", oscillation(factor, 30, 0.01));
    traces += trace("Fix weight_factor { value = " + std::to_string(factor) + "; } ",
                    "drop" + number + ".csv", "drop" + number);
  }
  const auto found = plan(block(traces + two_constants));
  ASSERT_TRUE(found) << told_;
  EXPECT_EQ(found->cases.size(), 6U);
  EXPECT_TRUE(found->resamples_cases());
  const CalibrationResult result = run(*found, "out");
  const SubjectCalibration& subject = result.subjects[0];
  EXPECT_NEAR(found->varied[0].at(subject.constants[0].share), 8., 0.02);
  ASSERT_EQ(subject.folds.size(), 3U);
  std::size_t held = 0;
  for (const FoldResult& fold : subject.folds) {
    held += fold.held_out.size();
    EXPECT_NEAR(*fold.held / *fold.training, 1., 0.3);
  }
  EXPECT_EQ(held, 6U);
  EXPECT_EQ(subject.resamples, 40U);
  EXPECT_NE(place_.read("out/folds.csv").find("drop3"), std::string::npos);
}

// Least squares do not see the sign of a residual; the curves that are drawn do.
TEST_F(CalibrateFile, TheModelledCurveIsTheModelsAndNotTheMeasuredOneMirroredInIt) {
  const auto found = plan(block("resamples = 0;\n" + trace() + two_constants));
  ASSERT_TRUE(found) << told_;
  run(*found, "out");
  const auto table = output::parse_csv(place_.read("out/curves.csv"));
  ASSERT_TRUE(table);
  const auto column = [&](const char* title) {
    return static_cast<std::size_t>(std::ranges::find(table->header, title) -
                                    table->header.begin());
  };
  const std::size_t time = column("time [s]"), measured = column("measured"),
                    modelled = column("scene");
  ASSERT_LT(std::max({time, measured, modelled}), table->header.size())
      << place_.read("out/curves.csv");
  ASSERT_EQ(table->rows.size(), 61U);
  double farthest = 0., ripple = 0.;  // [m]
  for (const auto& row : table->rows) {
    const double truth = height_at(std::stod(row[time]), 1., stiffness);
    farthest = std::max(farthest, std::abs(std::stod(row[modelled]) - truth));
    ripple = std::max(ripple, std::abs(std::stod(row[measured]) - truth));
  }
  EXPECT_GT(ripple, 9e-6);
  EXPECT_LT(farthest, 5e-6);
}

// One ground of the three is another: whoever holds it out must not have seen it.
TEST_F(CalibrateFile, AFoldIsFittedWithoutWhatItHoldsOut) {
  std::string traces = "folds = 3;\nresamples = 0;\n";
  for (int i = 0; i < 3; ++i) {
    const double factor = 0.8 + 0.2 * i;
    const std::string number = std::to_string(i);
    place_.file("drop" + number + ".csv",
                oscillation(factor, 30, 0.01, i == 1 ? 1.5 * stiffness : stiffness));
    traces += trace("Fix weight_factor { value = " + std::to_string(factor) + "; } ",
                    "drop" + number + ".csv", "drop" + number);
  }
  const auto found = plan(block(traces + two_constants));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult result = run(*found, "out");
  ASSERT_EQ(result.subjects[0].folds.size(), 3U);
  for (const FoldResult& fold : result.subjects[0].folds) {
    if (fold.held_out != std::vector<std::size_t>{1}) continue;
    EXPECT_NEAR(found->varied[0].at(fold.point[0]), 8., 0.03);  // [kN/m]
    EXPECT_LT(*fold.training, 1.);
    EXPECT_GT(*fold.held, 10.);
    return;
  }
  FAIL() << "no fold holds out the second case alone";
}

TEST_F(CalibrateFile, AConstantAtTheEndOfItsRangeIsNotToldAsANumber) {
  const auto found = plan(block("resamples = 40;\n" + trace() +
                                "Vary normal_stiffness { from = 20 kN/m; to = 100 kN/m; }\n"));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult result = run(*found, "out");
  EXPECT_FALSE(result.subjects[0].constants[0].identifiable);
  const std::string table = place_.read("out/calibration.csv");
  EXPECT_NE(table.find("scene,normal_stiffness,kN/m,,"), std::string::npos) << table;
  EXPECT_NE(table.find("no,lower,the fit ends at the lower end of its range"), std::string::npos)
      << table;
  EXPECT_NE(place_.read("out/report.html").find("would continue beyond it"), std::string::npos);
}

// A plain spring has a scale: where two constants are seen as a product alone, neither is known.
TEST_F(CalibrateFile, ConstantsOfWhichOnlyACombinationIsSeenAreNotIdentifiable) {
  std::string scene = point_scene;
  scene.insert(0, "Param factor = 1;\nParam base_stiffness = 10 kN/m;\n");
  const std::string given = "normal_stiffness = 10 kN/m;";
  scene.replace(scene.find(given), given.size(), "normal_stiffness = factor * base_stiffness;");
  place_.file("scene.hook", scene);
  for (const char* bootstrap : {"one_step", "refits"}) {
    const auto found =
        plan(block(std::string("resamples = 40; bootstrap = ") + bootstrap + ";\n" + trace() +
                   "Vary factor { from = 0.1; to = 10; scale = log; }\n"
                   "Vary base_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }\n"
                   "Vary normal_damping { from = 1 N.s/m; to = 100 N.s/m; scale = log; }\n"));
    ASSERT_TRUE(found) << told_;
    const CalibrationResult result = run(*found, std::string("product_") + bootstrap);
    const auto& constants = result.subjects[0].constants;
    ASSERT_EQ(constants.size(), 3U);
    EXPECT_LT(*result.subjects[0].error, 1.);
    EXPECT_FALSE(constants[0].identifiable) << bootstrap;
    EXPECT_FALSE(constants[1].identifiable) << bootstrap;
    EXPECT_TRUE(constants[2].identifiable) << bootstrap << constants[2].reason;
    EXPECT_NEAR(found->varied[2].at(constants[2].share), 18., 0.3);
  }
}

// The weight is 1 + b^2 times as much: b and -b explain the drop equally well.
TEST_F(CalibrateFile, AnEvenFunctionIsReadAndItsTwoOptimaAreNotOneConstant) {
  std::string scene = point_scene;
  scene.insert(0, "Param b = 0.1;\n");
  const std::string given = "gravity = 9.81 * weight_factor;";
  scene.replace(scene.find(given), given.size(), "gravity = 9.81 * (1 + b^2);");
  place_.file("scene.hook", scene);
  place_.file("heavy.csv", oscillation(1.25, 60, 0.01));
  for (const char* bootstrap : {"one_step", "refits"}) {
    const auto found =
        plan(block(std::string("resamples = 40; bootstrap = ") + bootstrap + ";\n" +
                   trace("", "heavy.csv") + "Vary b { from = -1; to = 1; }\n" + two_constants));
    ASSERT_TRUE(found) << told_;
    const CalibrationResult result = run(*found, std::string("even_") + bootstrap);
    const SubjectCalibration& subject = result.subjects[0];
    EXPECT_TRUE(subject.left_out.empty());
    ASSERT_EQ(subject.constants.size(), 3U) << subject.status;
    EXPECT_LT(*subject.error, 1.);
    EXPECT_FALSE(subject.constants[0].identifiable);
    EXPECT_LE(*subject.constants[0].low, 0.25 + 0.01);
    EXPECT_GE(*subject.constants[0].high, 0.75 - 0.01);
    EXPECT_NE(subject.constants[0].reason.find("explain the data equally well"), std::string::npos)
        << subject.constants[0].reason;
    // Of half of the range it is one.
    EXPECT_TRUE(subject.constants[1].identifiable) << subject.constants[1].reason;
  }
  const auto half = plan(block("resamples = 40;\n" + trace("", "heavy.csv") +
                               "Vary b { from = -0.1; to = 1; }\n" + two_constants));
  ASSERT_TRUE(half) << told_;
  const CalibrationResult one = run(*half, "half");
  EXPECT_TRUE(one.subjects[0].constants[0].identifiable) << one.subjects[0].constants[0].reason;
  EXPECT_NEAR(half->varied[0].at(one.subjects[0].constants[0].share), 0.5, 0.01);
}

TEST_F(CalibrateFile, AFitThatMissesItsOwnWeightsSaysSo) {
  const std::string one = "Vary normal_damping { from = 1 N.s/m; to = 2 N.s/m; }\n";
  const auto found = plan(block("resamples = 40;\n" + trace() + one));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult result = run(*found, "out");
  EXPECT_GT(*result.subjects[0].error, 10.);
  const auto sentences = misfits(*found, result);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences[0].find("scene misses its own weights: error "), std::string::npos);
  EXPECT_NE(sentences[0].find("a wider range of normal_damping"), std::string::npos);
  EXPECT_NE(place_.read("out/report.html").find("misses its own weights"), std::string::npos);
  EXPECT_NE(place_.read("out/calibration.json").find("misses its own weights"), std::string::npos);
  const auto good = plan(block("resamples = 40;\n" + trace() + two_constants));
  ASSERT_TRUE(good) << told_;
  EXPECT_TRUE(misfits(*good, run(*good, "good")).empty());
  EXPECT_EQ(place_.read("good/report.html").find("misses its own weights"), std::string::npos);
}

/// The drop by a clock that reads 12.25 s when it begins.
std::string late_drop() {
  std::string text = "Time (s);z (mm)\n";
  for (int i = 0; i <= 60; ++i) {
    const double time = 2.5e-3 * i;
    text += std::to_string(12.25 + time) + ";" +
            std::to_string(1e3 * height_at(time, 1., stiffness) + 0.01 * std::sin(1.7 * i * i)) +
            "\n";
  }
  return text;
}

TEST_F(CalibrateFile, AClockThatBeginsLateIsReportedAndItsOffsetGivenOrFitted) {
  place_.file("late.csv", late_drop());
  // Compared as it stands the whole drop is over; that is said.
  ASSERT_TRUE(plan(block("resamples = 0;\n" + trace("", "late.csv") + two_constants))) << told_;
  EXPECT_NE(warned_.find("begins at 12.25 s"), std::string::npos) << warned_;
  EXPECT_NE(warned_.find("`offset = 12.25 s;`"), std::string::npos) << warned_;
  const auto given =
      plan(block("resamples = 0;\n" + trace("offset = 12.25 s;", "late.csv") + two_constants));
  ASSERT_TRUE(given) << told_;
  EXPECT_EQ(warned_, "");
  const CalibrationResult known = run(*given, "given");
  EXPECT_NEAR(given->varied[0].at(known.subjects[0].constants[0].share), 8., 0.03);
  EXPECT_LT(*known.subjects[0].error, 1.);
  const auto fitted = plan(
      block("resamples = 40;\n" +
            trace("Vary offset { from = 12.21 s; to = 12.28 s; }", "late.csv") + two_constants));
  ASSERT_TRUE(fitted) << told_;
  EXPECT_EQ(warned_, "");
  ASSERT_EQ(fitted->varied.size(), 3U);
  EXPECT_EQ(fitted->varied[2].name, "drop.offset");
  const CalibrationResult found = run(*fitted, "fitted");
  const auto& constants = found.subjects[0].constants;
  EXPECT_NEAR(fitted->varied[2].at(constants[2].share), 12.25, 2e-4);
  EXPECT_NEAR(fitted->varied[0].at(constants[0].share), 8., 0.05);
  EXPECT_LT(*found.subjects[0].error, 1.);
  EXPECT_TRUE(constants[2].identifiable) << constants[2].reason;
  // It is no constant of the material.
  EXPECT_NE(place_.read("fitted/materials/floor_scene.hook").find("drop.offset = "),
            std::string::npos);
  // Where the clock of the start leaves nothing of the drop to see, the constants are read still.
  const auto blind =
      plan(block("resamples = 0;\n" +
                 trace("offset = 14 s; Vary offset { from = 12.2 s; to = 14 s; }", "late.csv") +
                 two_constants));
  ASSERT_TRUE(blind) << told_;
  EXPECT_TRUE(run(*blind, "blind").subjects[0].left_out.empty());
  EXPECT_TRUE(refused(trace("Vary height { from = 1 m; to = 2 m; }") + two_constants,
                      "a Trace has no number `height` to vary"))
      << told_;
  EXPECT_TRUE(refused(trace("Vary offset { from = 1 m; to = 2 m; }") + two_constants,
                      "an offset is a time"))
      << told_;
}

TEST_F(CalibrateFile, WeightsAndSamplesThatCannotBeSquaredAreErrors) {
  const auto weighing = [](const std::string& weight, const std::string& file) {
    return "Trace drop { file = \"" + file +
           "\"; column = \"z\"; of = point.base.location.z; weight = " + weight + "; }\n" +
           two_constants;
  };
  EXPECT_TRUE(refused(weighing("1e300 / (1 m)", "drop.csv"), "too large to be squared")) << told_;
  place_.file("huge.csv", "time [s],z [m]\n0,0\n0.1,1e308\n");
  EXPECT_TRUE(refused(weighing("1 / (1 mm)", "huge.csv"), "too large to be squared")) << told_;
  place_.file("long.csv", "time [ms],z [m]\n0,0\n1e300,0\n");
  EXPECT_TRUE(refused(weighing("1 / (1 mm)", "long.csv"), "row 3")) << told_;
}

TEST_F(CalibrateFile, WhatCannotBeCalibratedIsToldBeforeAnythingRuns) {
  const std::string good = trace();
  EXPECT_TRUE(refused(good, "needs a Vary")) << told_;
  EXPECT_TRUE(refused(two_constants, "needs a Trace")) << told_;
  EXPECT_TRUE(refused(trace("", "none.csv") + two_constants, "no file \"none.csv\"")) << told_;
  EXPECT_TRUE(refused("subjects = hookpoint, newton;\n" + good + two_constants, "`newton`"))
      << told_;
  EXPECT_TRUE(refused("subjects = hookpoint, hookpoint;\n" + good + two_constants, "there already"))
      << told_;
  EXPECT_TRUE(refused(good + "Vary gravitas { from = 1; to = 2; }\n", "`gravitas`")) << told_;
  const auto with = [](const std::string& fields) {
    return "Trace drop { file = \"drop.csv\"; " + fields + " }\n" + two_constants;
  };
  EXPECT_TRUE(refused(with("column = \"v\"; of = point.base.location.z; weight = 1 / (1 mm);"),
                      "is in m/s"))
      << told_;
  EXPECT_TRUE(refused(with("column = \"z\"; of = point.base.location.z; weight = 2 mm;"),
                      "1 over what one takes for an error"))
      << told_;
  EXPECT_TRUE(
      refused(with("column = \"z\"; of = point.base.place.z; weight = 1 / (1 mm);"), "place"))
      << told_;
  EXPECT_TRUE(refused(trace("Fix normal_stiffness { value = 1 kN/m; }") + two_constants,
                      "it cannot be fixed as well"))
      << told_;
}

/// Six drops of the point in two tables, one of them on ground of its own.
class CalibrateCases : public CalibrateFile {
 protected:
  CalibrateCases() {
    std::string states = "drop,weight_factor,ball [kg]\n", curves = "drop,time [s],z [mm]\n";
    for (int i = 0; i < 6; ++i) {
      const std::string name = std::to_string(i);
      const double factor = 0.7 + 0.1 * i;
      states += name + "," + std::to_string(factor) + ",1\n";
      for (int sample = 0; sample <= 40; ++sample) {
        const double time = 2.5e-3 * sample;
        curves += name + "," + std::to_string(time) + "," +
                  std::to_string(1e3 * height_at(time, factor, stiffness)) + "\n";
      }
    }
    place_.file("states.csv", states);
    place_.file("curves.csv", curves);
  }
  static std::string cases(const std::string& only = "", const std::string& file = "states.csv",
                           const std::string& of_case = "drop") {
    return "Cases drop { file = \"" + file + "\"; case = " + of_case + "; " + only +
           " Trace height { file = \"curves.csv\"; column = z; time = \"time\"; "
           "of = point.base.location.z; weight = 1 / (0.01 mm); } }\n";
  }
};

TEST_F(CalibrateCases, ARowOfTheTableIsACaseThatItsColumnsSet) {
  const auto found =
      plan(block(cases("Only weight_factor { from = 0.75; to = 1.15; }") + two_constants));
  ASSERT_TRUE(found) << told_;
  ASSERT_EQ(found->cases.size(), 4U);
  EXPECT_EQ(found->cases[0].name, "drop_1");
  ASSERT_EQ(found->cases[0].settings.size(), 1U);
  EXPECT_EQ(found->cases[0].settings[0].name, "weight_factor");
  EXPECT_EQ(found->cases[0].settings[0].text, "0.800000");
  EXPECT_EQ(found->cases[0].traces[0].name, "drop_1_height");
  EXPECT_EQ(found->residuals(), 4U * 41U);
  const CalibrationResult result = run(*found, "squares");
  EXPECT_NEAR(found->varied[0].at(result.subjects[0].constants[0].share), 8., 0.01);
  // Without a Vary it is told how well the scene does as it is.
  const auto as_it_is = plan(block(cases()));
  ASSERT_TRUE(as_it_is) << told_;
  const CalibrationResult plain = run(*as_it_is, "plain");
  EXPECT_EQ(plain.subjects[0].status, "ok");
  EXPECT_GT(*plain.subjects[0].error, 1.);
  EXPECT_EQ(plain.subjects[0].residuals.size(), 6U * 41U);
}

TEST_F(CalibrateCases, DistancesByCmaesAreTheSameHoweverTheyAreRun) {
  const auto found = plan(block(
      cases() + "method = cmaes; generations = 12; most_cases = 4; folds = 3;\n" + two_constants));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult one = run(*found, "one", 1);
  const SubjectCalibration& subject = one.subjects[0];
  ASSERT_EQ(subject.constants.size(), 2U);
  EXPECT_NEAR(found->varied[0].at(subject.constants[0].share), 8., 0.4);
  EXPECT_LT(*subject.error, *subject.own_error);
  EXPECT_LE(*subject.constants[0].low, subject.constants[0].share + 0.05);
  ASSERT_EQ(subject.folds.size(), 3U);
  std::size_t held = 0;
  for (const FoldResult& fold : subject.folds) {
    held += fold.held_out.size();
    EXPECT_TRUE(fold.held);
  }
  EXPECT_EQ(held, 6U);
  EXPECT_EQ(subject.residuals.size(), 6U * 41U);
  run(*found, "three", 3);
  EXPECT_TRUE(run(*found, "cut", 2, false, 60).interrupted);
  EXPECT_FALSE(run(*found, "cut", 2, true).interrupted);
  for (const char* file : {"calibration.csv", "correlations.csv", "evaluations.csv", "folds.csv",
                           "curves.csv", "materials/floor_scene.hook"}) {
    const std::string whole = place_.read(std::filesystem::path("one") / file);
    EXPECT_FALSE(whole.empty()) << file;
    EXPECT_EQ(whole, place_.read(std::filesystem::path("three") / file)) << file;
    EXPECT_EQ(whole, place_.read(std::filesystem::path("cut") / file)) << file;
  }
}

// Up to 0.8 of its range it changes nothing: where the search ends there it is not known.
TEST_F(CalibrateCases, AConstantThatActsBeyondAThresholdIsNotIdentifiableByEitherMethod) {
  std::string scene = point_scene;
  scene.insert(0, "Param b = 0.3;\n");
  const std::string given = "gravity = 9.81 * weight_factor;";
  scene.replace(scene.find(given), given.size(),
                "gravity = 9.81 * weight_factor * (1 + max(0, b - 0.8));");
  place_.file("scene.hook", scene);
  for (const char* method : {"least_squares", "cmaes"}) {
    const auto found =
        plan(block(cases() + "folds = 0; resamples = 40; generations = 12; method = " + method +
                   ";\nVary b { from = 0; to = 1; }\n" + two_constants));
    ASSERT_TRUE(found) << told_;
    const CalibrationResult result = run(*found, std::string("threshold_") + method);
    const auto& constants = result.subjects[0].constants;
    ASSERT_EQ(constants.size(), 3U) << result.subjects[0].status;
    EXPECT_FALSE(constants[0].identifiable) << method;
    EXPECT_LT(*constants[0].low, 0.1) << method;
    EXPECT_GT(*constants[0].high, 0.7) << method;
    EXPECT_LT(*constants[0].high, 0.9) << method;
    EXPECT_TRUE(constants[1].identifiable) << method << constants[1].reason;
  }
}

// The case that the first search looked at is held out by no fold: it has no prediction, and its
// figure of residuals nothing to show.
TEST_F(CalibrateCases, ACaseThatNoFoldHoldsOutHasNoFigureOfResiduals) {
  const auto found = plan(block(cases("Only drop { to = 2; }") +
                                "method = cmaes; population = 8; generations = 2; most_cases = 1; "
                                "folds = 3; resamples = 0;\n" +
                                two_constants));
  ASSERT_TRUE(found) << told_;
  const CalibrationResult result = run(*found, "out");
  std::vector<bool> held(3, false);
  for (const FoldResult& fold : result.subjects[0].folds)
    for (const std::size_t one : fold.held_out) held[one] = true;
  EXPECT_EQ(std::ranges::count(held, false), 1);
  EXPECT_TRUE(undrawn_.empty()) << undrawn_.front();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "drop_" + std::to_string(i) + "_height.svg";
    EXPECT_FALSE(place_.read("out/trace_" + name).empty());
    EXPECT_EQ(place_.read("out/residuals_" + name).empty(), !held[i]) << name;
  }
}

TEST_F(CalibrateCases, WhatIsWrongWithATableIsToldBeforeAnythingRuns) {
  EXPECT_TRUE(refused(cases("", "none.csv") + two_constants, "no file \"none.csv\"")) << told_;
  EXPECT_TRUE(refused(cases("", "states.csv", "toss") + two_constants, "no column `toss`"))
      << told_;
  EXPECT_TRUE(refused(cases("Only weight { to = 1; }") + two_constants, "no column `weight`"))
      << told_;
  EXPECT_TRUE(refused(cases("Only drop { from = 9; }") + two_constants, "no row of")) << told_;
  EXPECT_TRUE(refused(cases() + "Vary weight_factor { from = 0.5; to = 2; }\n",
                      "`weight_factor` is varied"))
      << told_;
  place_.file("twice.csv", "drop,weight_factor\n1,1\n1,2\n");
  EXPECT_TRUE(refused(cases("", "twice.csv") + two_constants, "row 3: `1` is there already"))
      << told_;
  place_.file("word.csv", "drop,weight_factor\n1,heavy\n");
  EXPECT_TRUE(refused(cases("", "word.csv") + two_constants, "row 2: `heavy`")) << told_;
  place_.file("more.csv", "drop,weight_factor\n1,1\n77,1\n");
  EXPECT_TRUE(refused(cases("", "more.csv") + two_constants, "no row is of drop 77")) << told_;
  EXPECT_TRUE(
      refused("Cases drop { file = \"states.csv\"; case = drop; }\n" + std::string(two_constants),
              "Cases need a Trace"))
      << told_;
  const std::string weight = "weight = 1 / (0.01 mm);";
  std::string bare = cases();
  EXPECT_TRUE(refused(bare.erase(bare.find(weight), weight.size()) + two_constants,
                      "needs the `weight` of a Trace"))
      << told_;
}

TEST_F(CalibrateFile, SubjectsByTheirNames) {
  const auto found = plan(block(trace() + two_constants));
  ASSERT_TRUE(found) << told_;
  const language::ClassSchema& world = found->subjects[0].scene->world_schema();
  const auto peer = subject_named(world, "mujoco_matched");
  ASSERT_TRUE(peer);
  EXPECT_EQ(peer->engine, "mujoco");
  EXPECT_EQ(peer->settings, "matched");
  const auto law = subject_named(world, "hunt_crossley_rk4");
  ASSERT_TRUE(law);
  EXPECT_EQ(law->engine, "dts");
  EXPECT_EQ(law->contact, "hunt_crossley");
  EXPECT_EQ(law->integrator, "rk4");
  EXPECT_EQ(subject_named(world, "hookpoint_reset")->contact, "hookpoint_reset");
  EXPECT_FALSE(subject_named(world, "hunt"));
  EXPECT_FALSE(subject_named(world, "hookpoint_hunt_crossley"));
}

// Every method says that a fit misses its own weights.
TEST_F(CalibrateFile, AFitByCmaesThatMissesItsOwnWeightsSaysSo) {
  const std::string search = "method = cmaes; generations = 4; resamples = 0;\n" + trace();
  const auto wrong =
      plan(block(search + "Vary normal_damping { from = 1 N.s/m; to = 2 N.s/m; }\n"));
  ASSERT_TRUE(wrong) << told_;
  const auto sentences = misfits(*wrong, run(*wrong, "wrong"));
  ASSERT_EQ(sentences.size(), 1U);
  // The mean length of a normal error of one part is sqrt(2/pi).
  EXPECT_NE(sentences[0].find("where 0.8 is expected"), std::string::npos) << sentences[0];
  EXPECT_NE(place_.read("wrong/calibration.json").find("misses its own weights"),
            std::string::npos);
}

}  // namespace
}  // namespace hookpoint::studies
