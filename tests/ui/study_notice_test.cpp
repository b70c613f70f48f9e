// What an engine has to say in a row of a study reaches the user: once, and with the row's name.
#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::count;
using testing::Workplace;

/// A study of a block that slides on 2 m of ground, at each of `speeds`.
testing::CommandResult slides(const Workplace& work, const std::string& speeds) {
  work.file("slide.hook",
            "Param v0 = 1 m/s; World w { deltat = 0.2 ms; Terrain.Flat g { size = 2; } Robot block "
            "{ Base.mobile { rest_on = g; velocity = v0, 0, 0; Shape.Box { dimensions = .2, .2, "
            ".1; mass = 1; } } } }");
  work.file("study.hook",
            "Study slides { scene = \"slide.hook\"; duration = 1 s; settle = 0 s; Sweep v0 { "
            "values = " +
                speeds + "; } Measure slip_distance; Subject ours { engine = dts; } }");
  return work.hookpoint("study study.hook --jobs 2 --out here");
}

TEST(StudyNotices, AreToldOnceWithTheRowsName) {
  const Workplace work;
  const auto result = slides(work, "0.5 m/s, 9 m/s");
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string note = "hookpoint: note: slides (ours, v0 = 9 m/s): block: a boundary point at";
  EXPECT_EQ(count(result.err, note), 1U) << result.err;
  EXPECT_EQ(count(result.err, "has left the terrain"), 1U) << result.err;
}

TEST(StudyNotices, OfSeveralRowsAreOne) {
  const Workplace work;
  const auto result = slides(work, "8 m/s, 9 m/s, 10 m/s");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(count(result.err, "has left the terrain"), 1U) << result.err;
  EXPECT_EQ(count(result.err, "slides (ours, v0 = 8 m/s): "), 1U) << result.err;
  EXPECT_EQ(count(result.err, " (so do 2 more runs)"), 1U) << result.err;
}

// Metrics that no run has a value of, and values at the end of all numbers.
TEST(StudyFigures, OfNoValueAreNoEmptyFilesAndOfHugeOnesHaveAxes) {
  const Workplace work;
  work.file("slide.hook",
            "Param far = 1; Param v = 0.1; World w { deltat = 1 ms; Terrain.Flat g { } Robot block "
            "{ Base.mobile { "
            "rest_on = g; velocity = v, 0, 0; Shape.Box { dimensions = .2, .2, .1; mass = 1; } } } "
            "Expression size { formula = \"previous\"; initial = far; } }");
  work.file(
      "study.hook",
      "Study slides { scene = \"slide.hook\"; duration = 10 ms; Sweep far { values = 1e-300, 1, "
      "1e300; } Sweep v { values = 0.1, 0.2; } Measure impacts; Measure huge { of = w.size.output; "
      "} Subject ours { }\n"
      "Plot none { x = far; y = impacts; scale = log_x; may_be_empty = true; }\n"
      "Plot panels { x = far; y = impacts; panels = v; may_be_empty = true; }\n"
      "Plot linear { x = far; y = huge; }\n"
      "Plot decades { x = far; y = huge; scale = log_log; } }\n");
  const auto result = work.hookpoint("study study.hook --jobs 1 --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  for (const std::string name : {"none", "panels"}) {
    EXPECT_FALSE(std::filesystem::exists(work.folder() / "here" / (name + ".svg"))) << name;
    EXPECT_EQ(count(work.read("here/" + name + ".csv"), "\n"), 1U) << "titles alone: " << name;
  }
  EXPECT_EQ(count(work.read("here/report.html"), "No run has a value to draw."), 2U);
  for (const std::string name : {"linear", "decades"}) {
    EXPECT_GT(work.read("here/" + name + ".svg").size(), 1000U) << name;
    for (const char* none : {"nan", "inf"})
      EXPECT_EQ(count(work.read("here/" + name + ".gp"), none), 0U) << name;
  }
}

// Whose values --quick leaves out: it has no runs, and its engine is there.
TEST(StudyFigures, DoNotMissTheEngineOfASubjectWithoutRuns) {
  const Workplace work;
  work.file("slide.hook",
            "Param dt = 1 ms; World w { deltat = dt; gravity = 9.81; Material m { normal_stiffness "
            "= 1e4; } Terrain.Flat g { material = m; } Robot block { Base.mobile { rest_on = g; "
            "Shape.Box { dimensions = .2, .2, .1; mass = 1; } } } }");
  work.file(
      "study.hook",
      "Study s { scene = \"slide.hook\"; duration = 10 ms; Sweep dt { values = 0.1 ms, 1 ms; "
      "quick_values = 1 ms; } Measure penetration_max; Subject all { } Subject fine { Only dt "
      "{ values = 0.1 ms; } } Plot depth { x = dt; y = penetration_max; } }\n");
  const auto result = work.hookpoint("study study.hook --quick --jobs 1 --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(count(work.read("here/report.html"), "Not on this machine"), 0U);
}

TEST(WallNotices, AreToldWithTheSceneAndTheSubject) {
  const Workplace work;
  // Explicit Euler gives a pendulum energy.
  work.file("swing.hook",
            "World w { gravity = 0, 9.81, 0; deltat = 1 ms; duration = 10 s; Robot r { Base.fixed "
            "{ orientation = 0, 0, 90 deg; } Chain c { Link l { angle = 40 deg; mass = 0.2; "
            "center_of_mass = 0.25, 0, 0; inertia = 1e-3, 4e-3, 4e-3, 0, 0, 0; } } } }\n"
            "Expect end { of = w.time; take = maximum; equals = 10; within = 1e-9; }\n");
  work.file("wall.hook",
            "Wall w { Subject steady { engine = dts; integrator = rk4; } Subject euler { engine = "
            "dts; integrator = explicit_euler; } Scene swing { file = \"swing.hook\"; } }\n");
  const auto result = work.hookpoint("study wall.hook --jobs 1 --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string note = "its energy rose by more than was put in";
  EXPECT_EQ(count(result.err, "hookpoint: note: swing under euler: " + note), 1U) << result.err;
  EXPECT_EQ(count(result.err, note), 1U) << result.err;
}

/// A table on points a, b and c and a ball d, of radius `radius`, on a slope.
void make_table(const Workplace& work, const std::string& points) {
  work.file(
      "table.hook",
      "Param slope = 12 deg; World w { gravity = 9.81; deltat = 0.2 ms; duration = 3 s; Material "
      "m { normal_stiffness = 40 kN/m; normal_damping = 300 N.s/m; tangential_stiffness = 40 "
      "kN/m; tangential_damping = 300 N.s/m; kinetic_friction = 0.5; } Terrain.Slope hill { "
      "angle = slope; material = m; } Robot t { Base.mobile { rest_on = hill; mass = 2 kg; "
      "inertia = 0.02, 0.02, 0.03, 0, 0, 0; center_of_mass = 0, 0, 0.1; " +
          points + " } } }");
}

/// `hookpoint study` of the table, with more in the study.
testing::CommandResult study_table(const Workplace& work, const std::string& more) {
  work.file("study.hook",
            "Study s { scene = \"table.hook\"; duration = 3 s; settle = 1 s; Subject a { contact = "
            "hookpoint; } Subject h { contact = lugre; } Measure creep_speed; " +
                more + " }");
  return work.hookpoint("study study.hook --jobs 2 --out here");
}

constexpr const char* table_truth = "Truth creep_speed { equals = predicted; within = 1e-9; ";

TEST(StudyVerdicts, OfBallFeetThatCannotRollAreThoseOfPoints) {
  const Workplace work;
  for (const char* feet :
       {"ContactPoint a { location = 0.2, 0.1, 0; } ContactPoint b { location = -0.2, 0.1, 0; } "
        "ContactPoint c { location = 0.2, -0.1, 0; } ContactPoint d { location = -0.2, -0.1, 0; "
        "radius = 1 mm; }",
        "ContactPoint a { location = 0.2, 0.1, 0; radius = 1 cm; } ContactPoint b { location = "
        "-0.2, "
        "0.1, 0; radius = 1 cm; } ContactPoint c { location = 0.2, -0.1, 0; radius = 1 cm; } "
        "ContactPoint d { location = -0.2, -0.1, 0; radius = 1 cm; }"}) {
    make_table(work, feet);
    const auto result = study_table(work, std::string(table_truth) + "}");
    EXPECT_EQ(result.status, 0) << result.out;
    EXPECT_NE(result.out.find("2 of 2 verdicts hold"), std::string::npos) << result.out;
  }
}

TEST(StudyVerdicts, AreNotGreenWhereNothingWasJudged) {
  const Workplace work;
  make_table(work, "ContactPoint d { radius = 20 cm; }");
  const auto judged_nothing = study_table(work, std::string(table_truth) + "}");
  EXPECT_EQ(judged_nothing.status, 1);
  EXPECT_NE(judged_nothing.out.find("no verdict, 1 Truth judges nothing"), std::string::npos)
      << judged_nothing.out;
  EXPECT_NE(judged_nothing.out.find("contact point d is a ball"), std::string::npos);
  const std::string page = work.read("here/report.html");
  EXPECT_NE(page.find("1 Truth judges nothing"), std::string::npos);
  const auto expected = study_table(work, std::string(table_truth) +
                                              "may_be_empty = true; } Truth slow { metric = "
                                              "creep_speed; above = -1 m/s; }");
  EXPECT_EQ(expected.status, 0);
  EXPECT_NE(expected.out.find("2 of 2 verdicts hold, 1 Truth judges nothing, as it may"),
            std::string::npos)
      << expected.out;
  const auto none = study_table(work,
                                "Sweep slope { values = 4 deg, 12 deg; } Truth creep_speed { "
                                "below = 1 m/s; Only slope { values = 11 deg; } }");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("`11 deg` is no value of the Sweep `slope`; it has 4 deg, 12 deg"),
            std::string::npos)
      << none.err;
}

}  // namespace
}  // namespace hookpoint
