// What stands on many runs: `compare` of two folders, the page of a `Matrix`.
// ctest: long, released
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "tests/support/falling_ball.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::falling;
using testing::run_into;
using testing::Workplace;

constexpr double pi = 3.14159265358979323846;

std::map<std::string, std::string> leaves(const std::string& json) {
  const auto all = text::json_leaves(json);
  EXPECT_TRUE(all.has_value()) << json;
  return all ? std::map<std::string, std::string>(all->begin(), all->end())
             : std::map<std::string, std::string>();
}

TEST(Compare, ARunIsTheSameAsItself) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  ASSERT_EQ(run_into(work, "b", falling("9.81")).status, 0);
  const CommandResult result = work.hookpoint("compare a b --tolerance 0");
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_NE(result.out.find("settings: the same"), std::string::npos) << result.out;
  EXPECT_EQ(result.out, work.hookpoint("compare a b --tolerance 0").out);
}

// (g2 - g1) t^2/2 passes 1e-5 of 100 m at sqrt(2e-3/0.01) = 0.44721 s.
TEST(Compare, TrajectoriesPartWhereTheClosedFormSays) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  ASSERT_EQ(run_into(work, "b", falling("9.82")).status, 0);
  const CommandResult result = work.hookpoint("compare a b --tolerance 1e-5 --json");
  EXPECT_EQ(result.status, 1) << result.err;
  auto found = leaves(result.out);
  EXPECT_EQ(found["settings.experiment[0].trail"], "w.gravity");
  EXPECT_EQ(found["settings.experiment[0].second"], "9.82");
  EXPECT_EQ(found.count("settings.experiment[1].trail"), 0u) << "nothing else differs";
  const std::string channel = "trajectories[0].channels[0].";
  EXPECT_EQ(found[channel + "channel"], "w.ball.base.location.z [m]");
  EXPECT_DOUBLE_EQ(std::stod(found[channel + "parts_at"]), 0.448);
  EXPECT_NEAR(std::stod(found[channel + "greatest"]), 0.005, 1e-12);
  EXPECT_DOUBLE_EQ(std::stod(found[channel + "greatest_at"]), 1.);
  EXPECT_EQ(work.hookpoint("compare a b --tolerance 1e-4").status, 0);
}

// Steps of 3 ms and 10 ms meet at 0 and every 30 ms.
TEST(Compare, RowsOfOtherStepsMeetWhereTheirTimesDo) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81", "", "3 ms")).status, 0);
  ASSERT_EQ(run_into(work, "b", falling("9.81", "", "10 ms")).status, 0);
  auto found = leaves(work.hookpoint("compare a b --json").out);
  EXPECT_EQ(found["trajectories[0].instants"], "34");
  EXPECT_EQ(found["trajectories[0].interpolated"], "false");
  EXPECT_EQ(found["trajectories[0].channels[0].parts_at"], "null");
}

// Linear between the rows of the second at 0 and 0.7 s, the parabola lies below by g/2 t (0.7 - t).
TEST(Compare, WithoutCommonTimesTheSecondIsTakenLinearly) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81", "", "0.2 s")).status, 0);
  ASSERT_EQ(run_into(work, "b", falling("9.81", "", "0.7 s")).status, 0);
  auto found = leaves(work.hookpoint("compare a b --json").out);
  EXPECT_EQ(found["trajectories[0].interpolated"], "true");
  EXPECT_EQ(found["trajectories[0].instants"], "4");
  EXPECT_NEAR(std::stod(found["trajectories[0].channels[0].greatest"]), 9.81 / 2. * 0.4 * 0.3,
              1e-12);
}

TEST(Compare, SettingsAreComparedByTrailNotByLine) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  std::string moved = falling("9.81");
  moved.replace(moved.find("gravity = 9.81; "), 16, "");
  moved.insert(moved.find("integrator"), "gravity = 9.81;\n");
  ASSERT_EQ(run_into(work, "b", "// the same in another order\n" + moved).status, 0);
  const CommandResult result = work.hookpoint("compare a b");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("settings: the same"), std::string::npos) << result.out;
}

std::string sliding(const std::string& slopes, double mu) {
  return "Study s { scene = \"scenes/sloped_block.hook\"; duration = 0.4 s; settle = 0.1 s;\n"
         "  Sweep slope { values = " +
         slopes + "; }\n  Fix mu { value = " + std::to_string(mu) +
         "; }\n  Measure slip_acceleration;\n"
         "  Subject ours { engine = dts; contact = hookpoint; }\n"
         "  Truth slip_acceleration { above = 2.2 m/s^2; }\n"
         "  Plot d { x = time; y = drift; }\n}\n";
}

void study(const Workplace& work, const std::string& name, const std::string& text) {
  work.file(name + ".hook", text);
  ASSERT_LE(work.hookpoint("study " + name + ".hook --jobs 1 --out " + name).status, 1);
}

TEST(Compare, StudiesAreJoinedByTheirSweepsNotByTheirRows) {
  const Workplace work;
  study(work, "a", sliding("20 deg, 25 deg", 0.2));
  study(work, "b", sliding("15 deg, 20 deg, 25 deg", 0.1));
  const CommandResult result = work.hookpoint("compare a b --json");
  EXPECT_EQ(result.status, 1) << result.err;
  auto found = leaves(result.out);
  EXPECT_EQ(found["metrics[0].metric"], "slip_acceleration [m/s^2]");
  EXPECT_EQ(found["metrics[0].rows"], "2");
  EXPECT_EQ(found["metrics[0].differences[0].row"], "slope = 20 deg, ours");
  // g cos(20 deg) (0.2 - 0.1), the laws' own error of 0.2 % allowed.
  EXPECT_NEAR(std::stod(found["metrics[0].differences[0].absolute"]),
              0.1 * 9.81 * std::cos(pi / 9.), 0.005);
  EXPECT_EQ(found["only_second[0]"], "row slope = 15 deg, ours");
  EXPECT_EQ(found["trajectories[0].trajectory"], "d, slope = 20 deg, ours");
  // At 20 deg g (sin - mu cos) is 1.51 with 0.2 and 2.43 with 0.1: the Truth holds with the latter.
  EXPECT_EQ(found["changed[0].what"], "slip_acceleration_ok");
  EXPECT_EQ(found["changed[0].first"], "false");
  EXPECT_EQ(found["changed[0].second"], "true");
  EXPECT_EQ(found.count("changed[1].what"), 0u) << "at 25 deg it holds with both";
}

// The block slides with other accelerations, whatever its metrics are called.
TEST(Compare, AMetricMayHaveTheNameOfAColumnOfAWall) {
  const Workplace work;
  const auto named = [](const std::string& name, double mu) {
    std::string text = sliding("20 deg", mu);
    return text.insert(text.find("  Truth"),
                       "  Measure " + name + " { of = world.block.base.velocity.x; }\n");
  };
  for (const char* name : {"error", "expected", "allowed", "unit", "way_ok"}) {
    study(work, "a", named(name, 0.2));
    study(work, "b", named(name, 0.1));
    const CommandResult result = work.hookpoint("compare a b");
    EXPECT_NE(result.out.find("  " + std::string(name) + " [m/s]"), std::string::npos)
        << result.out << result.err;
  }
}

TEST(Compare, WhatIsNoFileIsNoTrajectory) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  std::filesystem::create_directory(work.folder() / "a/folder.csv");
  ASSERT_EQ(mkfifo((work.folder() / "a/pipe.csv").c_str(), 0600), 0);
  const CommandResult same = work.hookpoint("compare a a");
  EXPECT_EQ(same.status, 0) << same.err;
  const CommandResult file = work.hookpoint("compare a/trace.csv a");
  EXPECT_EQ(file.status, 2);
  EXPECT_NE(file.err.find("a/trace.csv is a file"), std::string::npos) << file.err;
}

TEST(Compare, WhatIsNoRunIsToldWithAdvice) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  study(work, "s", sliding("20 deg", 0.2));
  study(
      work, "t",
      "Study s { scene = \"scenes/sloped_block.hook\"; duration = 0.1 s;\n"
      "  Sweep mu { values = 0.1, 0.2; } Measure creep_speed; Subject ours { engine = dts; } }\n");
  work.file("tune.hook",
            "Tune t { scene = \"scenes/sloped_block.hook\"; duration = 0.1 s; settle = 0.05 s;\n"
            "  Vary mu { from = 0.1; to = 1; } Objective creep_speed { minimise; }\n"
            "  population = 8; generations = 1; seeds = 1; samples = 0; }\n");
  ASSERT_EQ(work.hookpoint("tune tune.hook --jobs 1 --out tune").status, 0);
  std::filesystem::create_directory(work.folder() / "empty");
  const std::pair<const char*, const char*> cases[] = {
      {"a nowhere", "there is no folder nowhere; compare takes the folder that"},
      {"a empty", "empty has no experiment.hook; compare takes the folder that"},
      {"a run.hook", "run.hook is a file"},
      {"a .", "holds several runs; compare one of ./a, ./s, ./t"},
      {"tune tune", "tune is neither a run nor a study; compare takes the folder that"},
      {"a s", "a is a single run and s a study"},
      {"s t", "one run has several with ours; it varies mu, subject, and both vary subject only"},
      {"a a --tolerance -1", "--tolerance takes a number from 0 on"}};
  for (const auto& [arguments, says] : cases) {
    const CommandResult result = work.hookpoint(std::string("compare ") + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
  }
}

/// A box in flight; and a block with a constant of ODE, which Bullet refuses.
const std::string flights =
    "Study box { scene = \"scenes/thrown_box.hook\"; duration = 0.1 s;\n"
    "  Measure energy_gain;\n"
    "  Subject ours { engine = dts; integrator = rk4; }\n"
    "  Subject ode { engine = ode; settings = default; }\n"
    "  Truth energy_gain { below = 1 J; }\n"
    "  Plot energy { x = time; y = energy; } }\n"
    "Study block { scene = \"scenes/ode_cfm_block.hook\"; duration = 0.1 s;\n"
    "  Measure penetration_max;\n"
    "  Subject ode { engine = ode; settings = default; }\n"
    "  Subject bullet { engine = bullet; settings = default; }\n"
    "  Truth penetration_max { below = 10 mm; } }\n";

const std::string matrix =
    "Matrix both { title = \"Both\"; Part flights { file = \"flights.hook\"; } Part creep { file = "
    "\"creep.hook\"; } }\n";

void write_matrix(const Workplace& work) {
  work.file("flights.hook", flights);
  work.file("creep.hook", sliding("20 deg", 0.2));
  work.file("matrix.hook", matrix);
}

TEST(Matrix, HoldsEveryStudysSubjectsByMetricsInOnePage) {
  const Workplace work;
  write_matrix(work);
  const CommandResult result = work.hookpoint("study matrix.hook --jobs 1 --out m");
  EXPECT_EQ(result.status, 1) << "the Truth of sliding() fails\n" << result.err;
  const std::string table = work.read("m/matrix.csv");
  EXPECT_NE(table.find("\nbox,,energy_gain,J,ours,dts,"), std::string::npos) << table;
  EXPECT_NE(table.find("\nbox,,energy_gain,J,ode,ode,"), std::string::npos);
  EXPECT_NE(table.find("\ns,slides,slip_acceleration,m/s^2,ours,dts,hookpoint,"),
            std::string::npos);
  // A row with the reason, neither passed nor failed.
  const std::string refused =
      "\nblock,friction holds,,,bullet,bullet,,,default,1,0,,,,,,0,0,\"refused: constraint_mixing ";
  EXPECT_NE(table.find(refused), std::string::npos) << table;
  const std::string page = work.read("m/matrix.html");
  EXPECT_NE(page.find("id=\"figure-box-energy\""), std::string::npos);
  EXPECT_NE(page.find("box/energy.svg"), std::string::npos);
  EXPECT_NE(page.find("Study box {"), std::string::npos) << "the file that makes it";
  for (const char* outside : {" src=", "@import", "url(http", "href=\"http"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  for (const char* file : {"m/box/report.html", "m/box/energy.svg", "m/block/results.csv"})
    EXPECT_FALSE(work.read(file).empty()) << file;
}

TEST(Matrix, HasTheSameTableForAnyNumberOfThreadsAndCompares) {
  const Workplace work;
  write_matrix(work);
  work.hookpoint("study matrix.hook --jobs 1 --out one");
  work.hookpoint("study matrix.hook --jobs 2 --out two");
  EXPECT_EQ(work.read("one/matrix.csv"), work.read("two/matrix.csv"));
  EXPECT_EQ(work.hookpoint("compare one two").status, 0);
}

/// A plate with a body on it in every engine, QuickStep where its iterations do not converge: its
/// rows show whether a world has random numbers of its own.
const std::string every_engine =
    "Study plate { scene = \"scenes/turntable.hook\"; duration = 1.5 s; settle = 1.2 s;\n"
    "  Fix dt { value = 1 ms; } Sweep ratio { values = 1, 10; }\n"
    "  Measure penetration_mean; Measure joint_gap; Measure unrest;\n"
    "  Subject ours { engine = dts; }\n"
    "  Subject ode { engine = ode; settings = default; }\n"
    "  Subject quickstep_recommended { engine = ode_quickstep; settings = recommended; }\n"
    "  Subject quickstep { engine = ode_quickstep; settings = default; }\n"
    "  Subject bullet { engine = bullet; settings = matched; }\n"
    "  Subject mujoco { engine = mujoco; settings = matched; }\n"
    "  Subject dart { engine = dart; settings = matched; }\n"
    "  Subject simbody { engine = simbody; settings = matched; }\n"
    "  Truth penetration_mean { equals = predicted; tolerance = 0.1 %; }\n"
    "  Truth joint_gap { below = 1e-10 m; subjects = ours, ode, bullet, mujoco, dart, simbody; } "
    "}\n";

// Whatever runs beside a row, and before it in the same process.
TEST(Repetition, EveryEnginesRowsAreTheSameBytes) {
  const Workplace work;
  work.file("plate.hook", every_engine);
  const CommandResult one = work.hookpoint("study plate.hook --jobs 1 --out one");
  EXPECT_EQ(one.status, 0) << one.out << one.err;
  EXPECT_EQ(work.hookpoint("study plate.hook --jobs 4 --out four").status, 0);
  const std::string table = work.read("one/results.csv");
  EXPECT_EQ(table, work.read("four/results.csv"));
  work.hookpoint("study plate.hook --jobs 1 --only quickstep --only ours --out alone");
  std::istringstream alone(work.read("alone/results.csv"));
  int lines = 0;
  for (std::string line; std::getline(alone, line); ++lines)
    EXPECT_NE(table.find(line + "\n"), std::string::npos) << line;
  EXPECT_EQ(lines, 5) << "a header and two rows of each";
}

TEST(Matrix, OnlyTakesTheSubjectFromThoseStudiesThatHaveIt) {
  const Workplace work;
  write_matrix(work);
  EXPECT_EQ(work.hookpoint("study matrix.hook --only ode --out m").status, 0);
  EXPECT_TRUE(std::filesystem::exists(work.folder() / "m/box"));
  EXPECT_FALSE(std::filesystem::exists(work.folder() / "m/s"));
  EXPECT_EQ(work.hookpoint("study matrix.hook --only nobody --out n").status, 2);
}

TEST(Matrix, WhatIsWrongIsToldAtItsPart) {
  const Workplace work;
  write_matrix(work);
  const std::pair<const char*, const char*> cases[] = {
      {"Part nowhere;", "no file \"studies/nowhere.hook\" beside the Matrix or in configs/"},
      {"Part a { file = \"flights.hook\"; } Part b { file = \"flights.hook\"; }",
       "a second study is called `box`"},
      {"Part a { file = \"scenes/thrown_box.hook\"; }", "holds no Study"},
      {"", "the Matrix has no Part"}};
  for (const auto& [parts, says] : cases) {
    work.file("wrong.hook", std::string("Matrix m { ") + parts + " }\n");
    const CommandResult result = work.hookpoint("study wrong.hook --out m");
    EXPECT_EQ(result.status, 2) << parts;
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("wrong.hook:1:"), std::string::npos) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(work.folder() / "m"));
}

// A Truth that names a subject claims that it can run; one that covers all does not.
TEST(Refusal, FailsOnlyATruthThatNamesTheSubject) {
  const Workplace work;
  const std::string named = "Truth penetration_max { below = 10 mm; subjects = bullet; }";
  const std::string all_subjects = flights.substr(flights.find("Study block"));
  std::string study = all_subjects;
  study.replace(study.rfind("Truth"), study.rfind("} }") - study.rfind("Truth") + 1, named);
  work.file("named.hook", study);
  work.file("all.hook", all_subjects);
  EXPECT_EQ(work.hookpoint("study named.hook --only bullet --out n").status, 1);
  const CommandResult all = work.hookpoint("study all.hook --only bullet --out a");
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_NE(all.out.find("refused"), std::string::npos) << all.out;
}

}  // namespace
}  // namespace hookpoint
