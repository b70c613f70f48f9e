// Options that make the command short to write, and what it says of itself.
// ctest: long
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <functional>
#include <set>
#include <sstream>

#include "apps/cli/described.h"
#include "apps/shared/application.h"
#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "studies/measure/metric.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/message_rules.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::config;
using testing::count;
using testing::has;
using testing::Workplace;
namespace fs = std::filesystem;

const std::string block = config("scenes/sloped_block.hook");

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(ShortForms, AreTheSettingsThatTheyStandFor) {
  const Workplace work;
  const auto printed = [&](const std::string& settings) {
    const CommandResult result = work.hookpoint("print " + block + settings);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_EQ(printed(" --engine bullet --settings recommended --dt '2 ms'"),
            printed(" --set world.engine=bullet --set world.settings=recommended --set "
                    "world.deltat='2 ms'"));
  EXPECT_EQ(printed(" --contact lugre --integrator rk4"),
            printed(" --set world.contact=lugre --set world.integrator=rk4"));
  const CommandResult run = work.hookpoint("run " + block + " --for 2ms --contact nominal");
  EXPECT_TRUE(has(run.out, "contact nominal")) << run.out << run.err;
  for (const char* command : {"dynamics", "advise", "ports"})
    EXPECT_EQ(work.hookpoint(std::string(command) + " " + block + " --dt 1ms").status, 0);
  const CommandResult wrong = work.hookpoint("run " + block + " --contact lugr");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "did you mean `lugre`?")) << wrong.err;
}

/// A World of a ball with these fields of its base; `more` stands in the World.
std::string ball(const std::string& base = "", const std::string& more = "") {
  return "World w { deltat = 1 ms; Robot ball { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, "
         "0; " +
         base + "} } " + more + "}\n";
}

TEST(ShortForms, CountInAFileThatNeedsASetting) {
  const Workplace work;
  work.file("ball.hook", "Param height;\n" + ball("location = 0, 0, height; "));
  for (const char* command : {"run ", ""}) {
    const CommandResult run =
        work.hookpoint(command + std::string("ball.hook --set height='3 m' --for 2ms"));
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(has(run.out, "w at 0.002 s")) << run.out;
  }
  const CommandResult without = work.hookpoint("ball.hook --for 2ms");
  EXPECT_EQ(without.status, 2);
  EXPECT_EQ(count(without.err, "the Param `height` has no value"), 1U) << without.err;
}

// 2^53 = 9007199254740992: above it, not every whole number of steps has a double of its own.
TEST(StepCounts, BeyondADoublesWholeNumbersAreRefusedAtTheirPlace) {
  const Workplace work;
  work.file("ball.hook", ball());
  work.file("long.hook",
            "World w { deltat = 1 ms;\n  duration = 1e300 s; Robot ball { Base.mobile { "
            "mass = 1; inertia = 1, 1, 1, 0, 0, 0; } } }\n");
  work.file("cases.csv", "drop\na\nb\n");
  work.file("curves.csv", "drop,t [s],z [m]\na,0.01,1\na,0.02,1\nb,0.01,1\nb,1e297,1\n");
  const std::string cases =
      "Cases drop { file = \"cases.csv\"; case = drop; Trace z { file = \"curves.csv\"; column = "
      "z; "
      "time = \"t\"; of = w.ball.base.location.z; } } ";
  work.file("study.hook",
            "Study s { scene = \"ball.hook\"; Subject ours { } Measure fell;\n"
            "  duration = 1e300 s; }\n");
  work.file("cases.hook",
            "Study s { scene = \"ball.hook\"; Subject ours { } Measure fell;\n  " + cases + "}\n");
  work.file("tune.hook",
            "Tune t { scene = \"ground.hook\"; Vary k { from = 1; to = 2; } Objective "
            "penetration_max { minimise; }\n  duration = 1e300 s; }\n");
  work.file("ground.hook",
            "Param k = 1; World w { deltat = 1 ms; duration = 1 s; Material m { "
            "normal_stiffness = k * 1 kN/m; } Terrain.Flat g { material = m; } Robot "
            "ball { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, 0; } } }\n");
  work.file("wall.hook", "Wall all { Scene long { file = \"long.hook\"; } Subject ours { } }\n");
  const struct {
    const char *arguments, *place;
  } table[] = {
      {"run ball.hook --for 1e17s --out out", "1e+17 s in steps of 0.001 s are more steps than"},
      {"run ball.hook --for 9.1e12s --out out",
       "9.1e+12 s in steps of 0.001 s are more steps than"},
      {"run long.hook --out out", "long.hook:2:"},
      {"check long.hook", "long.hook:2:"},
      {"dynamics long.hook", "long.hook:2:"},
      {"view long.hook --no-open --out out", "long.hook:2:"},
      {"study study.hook --out out", "study.hook:2:"},
      {"study study.hook --quick --out out", "study.hook:2:"},
      {"study wall.hook --out out", "are more steps than"},
      {"tune tune.hook --out out", "tune.hook:2:"},
  };
  for (const auto& [arguments, place] : table) {
    const CommandResult result = work.hookpoint(arguments);
    EXPECT_EQ(result.status, 2) << arguments << result.out << result.err;
    EXPECT_TRUE(has(result.err, place)) << arguments << ": " << result.err;
    EXPECT_TRUE(has(result.err, "are more steps than a run can count (9007199254740992)"))
        << arguments << ": " << result.err;
    EXPECT_FALSE(fs::exists(work.folder() / "out")) << arguments;
  }
  const CommandResult late = work.hookpoint("study cases.hook --out out");
  EXPECT_EQ(late.status, 2) << late.out << late.err;
  EXPECT_TRUE(has(late.err, "curves.csv, row 5: its time, 1e+297 s, is beyond 1e+09 s"))
      << late.err;
  const CommandResult days = work.hookpoint("check ball.hook");
  EXPECT_EQ(days.err, "");
  work.file("days.hook", "World w { deltat = 1 ms; duration = 1e9 s; }\n");
  EXPECT_TRUE(has(work.hookpoint("check days.hook").err,
                  "are 1e+12 steps: at a million steps a second they take 12 days"));
}

TEST(SweptTerrain, LoadsNoPlugin) {
  const Workplace work;
  work.file("library.so", "");
  work.file("scene.hook",
            "World w { deltat = 1 ms; Terrain.Flat g { } Robot ball { Base.mobile { mass = "
            "1; inertia = 1, 1, 1, 0, 0, 0; } } }\n");
  work.file("ground.hook", "Plugin \"library.so\"; Terrain.Flat laid { }\n");
  work.file("study.hook",
            "Study s { scene = \"scene.hook\"; duration = 10 ms; Subject ours { } Measure "
            "fell; Sweep terrain { values = \"ground.hook\"; } }\n");
  const CommandResult result = work.hookpoint("study study.hook --out out");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err,
                  "ground.hook:1:1: error: a terrain's file holds a Terrain and Materials "
                  "alone: its Plugin "))
      << result.err;
  EXPECT_FALSE(fs::exists(work.folder() / "out"));
}

// A variable of a script that is not set.
TEST(EmptyArguments, NameNothing) {
  const Workplace work;
  work.file("ball.hook", ball());
  work.file("study.hook",
            "Study s { scene = \"ball.hook\"; Subject ours { } Measure fell; duration = "
            "1 s; }\n");
  const std::size_t before = work.entries();
  for (const char* option :
       {"--out", "--record", "--movie", "--resume", "--at", "--changes", "--for", "--engine",
        "--dt", "--bind", "--token", "--with", "--set", "--port"}) {
    const std::string message = "the value of " + std::string(option) + " is empty";
    for (const char* written : {" ''", "="}) {
      const CommandResult run = work.hookpoint("run ball.hook " + std::string(option) + written);
      EXPECT_EQ(run.status, 2) << option << written;
      EXPECT_TRUE(has(run.err, message)) << option << written << run.err;
    }
  }
  for (const char* arguments :
       {"study study.hook --out ''", "study study.hook --only ''",
        "study study.hook --slurm "
        "--partition ''",
        "tune study.hook --out ''", "replay movie.h5 --film ''", "replay movie.h5 --at ''",
        "runs list.json --journal ''", "compare a b --tolerance ''", "describe --plugin ''",
        "run ''", "check ''", "''", "fmt ball.hook ''"}) {
    const CommandResult result = work.hookpoint(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(has(result.err, " is empty: give it one, or leave it out"))
        << arguments << result.err;
  }
  EXPECT_EQ(work.entries(), before);
  EXPECT_EQ(work.hookpoint("print ball.hook --set=w.deltat=2ms").status, 0);
}

TEST(RecordOption, TakesVectorsAndGlobs) {
  const Workplace work;
  const auto header = [&](const std::string& trails) {
    const CommandResult result =
        work.hookpoint("run " + block + " --for 1ms --out here --record " + trails);
    EXPECT_EQ(result.status, 0) << result.err;
    return first_line(work.read("here/trace.csv"));
  };
  EXPECT_EQ(header("block.position"),
            "time [s],block.position.x [m],block.position.y [m],block.position.z [m]");
  EXPECT_EQ(header("'**.base.contact.force'"),
            "time [s],world.block.base.contact.force.x [N],world.block.base.contact.force.y [N],"
            "world.block.base.contact.force.z [N]");
  EXPECT_EQ(
      header("'block.*_energy'"),
      "time [s],block.kinetic_energy [J],block.potential_energy [J],block.numerical_energy [J]");
  const CommandResult none = work.hookpoint("run " + block + " --record 'block.bsae.*' --out no");
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(has(none.err, "did you mean `block.base.*`?")) << none.err;
  EXPECT_FALSE(fs::exists(work.folder() / "no"));
}

TEST(PortsCommand, ListsTrailUnitKindValueAndMeaning) {
  const Workplace work;
  work.file("ball.hook", ball("location = 1, 2, 3; ",
                              "Push kick { body = ball.base; force = 5, 0, 0; duration = 1 s; } "));
  const CommandResult all = work.hookpoint("ports ball.hook");
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_TRUE(has(all.out, "w.ball.base.location ")) << all.out;
  EXPECT_TRUE(has(all.out, "simulated time")) << all.out;
  EXPECT_FALSE(has(all.out, "constant")) << all.out;
  EXPECT_EQ(work.hookpoint("ports ball.hook ball.base.location").out,
            "ball.base.location  m  out       1, 2, 3  of the base frame's origin, world axes\n");
  EXPECT_TRUE(has(work.hookpoint("ports ball.hook kick.force").out, "N  in        5, 0, 0"));
  EXPECT_TRUE(has(work.hookpoint("ports ball.hook '**.mass'").out, "kg  constant  1"));
  const std::string json = work.hookpoint("ports ball.hook ball.base.location.y --json").out;
  EXPECT_TRUE(has(json, "\"trail\": \"ball.base.location.y\"")) << json;
  EXPECT_TRUE(has(json, "\"initial\": 2")) << json;
  const CommandResult wrong = work.hookpoint("ports ball.hook ball.bse.location");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "did you mean `ball.base.location`?")) << wrong.err;
}

TEST(PortsCommand, KnowsNamesThatBeginWithAnothers) {
  const Workplace work;
  const std::string record = "Record steps { trails = w.integrator.";
  work.file("ball.hook", ball() + record + "steps; }\n");
  const CommandResult ports = work.hookpoint("ports ball.hook '**.integrator.*'");
  EXPECT_EQ(ports.status, 0) << ports.err;
  EXPECT_TRUE(has(ports.out, "w.integrator.steps ")) << ports.out;
  EXPECT_TRUE(has(ports.out, "steps so far, of an adaptive integrator its internal ones"))
      << ports.out;
  const CommandResult run = work.hookpoint("run ball.hook --for 3ms --out here");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(work.read("here/steps.csv"), "\n0.003,3\n")) << work.read("here/steps.csv");
  work.file("wrong.hook", ball() + record + "stps; }\n");
  const CommandResult wrong = work.hookpoint("run wrong.hook --for 3ms");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(has(wrong.err, "did you mean `integrator.steps`?")) << wrong.err;
}

TEST(FormatCommand, WaitsForNoPipe) {
  const Workplace work;
  ASSERT_EQ(mkfifo((work.folder() / "pipe.hook").c_str(), 0600), 0);
  const CommandResult result = work.hookpoint("fmt pipe.hook");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(has(result.err, "cannot read pipe.hook")) << result.err;
}

TEST(RunCommand, SaysWhereItWrote) {
  const Workplace work;
  const CommandResult run = work.hookpoint("run " + block + " --for 1ms --out here --record time");
  EXPECT_TRUE(has(run.err, "wrote here: experiment.hook, trace.csv")) << run.err;
  EXPECT_FALSE(has(work.hookpoint("run " + block + " --for 1ms").err, "wrote"));
}

TEST(RunCommand, FindsInstalledScenes) {
  const Workplace work;
  const CommandResult run = work.hookpoint("run scenes/sloped_block.hook --for 1ms");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.err, "scenes/sloped_block.hook is /")) << run.err;
  const CommandResult opened = work.hookpoint("scenes/sloped_block.hook --for 1ms");
  EXPECT_EQ(opened.status, 0);
  EXPECT_EQ(count(opened.err, "scenes/sloped_block.hook is /"), 1U) << opened.err;
  EXPECT_EQ(work.hookpoint("check studies/creep.hook").status, 0);
  // One's own comes first.
  work.file("mine.hook", ball());
  EXPECT_FALSE(has(work.hookpoint("run mine.hook --for 1ms").err, "note"));
}

TEST(RunCommand, SaysOnceThatWindowsAreNotShown) {
  const Workplace work;
  const CommandResult run =
      work.hookpoint("run " + config("paper/fig7_two_joint_arm.hook") + " --for 1ms");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(count(run.err, "windows are not shown"), 1U) << run.err;
  EXPECT_FALSE(has(work.hookpoint("run " + block + " --for 1ms").err, "windows"));
}

TEST(ReplayCommand, OfAMomentIsShortUnlessPortsAreAskedFor) {
  const Workplace work;
  ASSERT_EQ(work.hookpoint("run " + block + " --for 10ms --movie m.h5").status, 0);
  const CommandResult moment = work.hookpoint("replay m.h5 --at 5ms");
  EXPECT_EQ(moment.status, 0) << moment.err;
  EXPECT_TRUE(has(moment.out, "block.base ")) << moment.out;
  EXPECT_LT(count(moment.out, "\n"), 5U) << moment.out;
  EXPECT_EQ(work.hookpoint("replay m.h5 --at 5ms --record block.position").out.substr(0, 18),
            "time 0.005 s, step");
  EXPECT_GT(count(work.hookpoint("replay m.h5 --at 5ms --record '**'").out, "\n"), 40U);
}

/// A short study of the block.
std::string study_of(const std::string& rest) {
  return "Param seconds = 0.02;\nStudy s { scene = \"scenes/sloped_block.hook\"; duration = "
         "seconds "
         "* 1 s; settle = 0.01 s; Measure slip_distance;\n" +
         rest + "}\n";
}

TEST(StudySet, HoldsForTheScenesAndTheFile) {
  const Workplace work;
  work.file("s.hook", study_of("Subject ours { engine = dts; } Fix mu { value = 0.5; }"));
  const auto run = [&](const std::string& settings, const std::string& folder) {
    const CommandResult result = work.hookpoint("study s.hook --out " + folder + settings);
    EXPECT_EQ(result.status, 0) << result.err;
    return result;
  };
  run("", "plain");
  run(" --set mu=0.7 --set seconds=0.03 --set world.surface.normal_damping='50 N.s/m' --dt '0.5 "
      "ms'",
      "set");
  const std::string scene = work.read("set/scene.hook");
  EXPECT_TRUE(has(scene, "static_friction = 0.7")) << scene;
  EXPECT_TRUE(has(scene, "normal_damping = 50")) << scene;
  EXPECT_TRUE(has(scene, "deltat = 5e-04") || has(scene, "deltat = 0.0005")) << scene;
  EXPECT_TRUE(has(work.read("set/experiment.hook"), "duration = 0.03"));
  const auto hash = [&](const std::string& folder) {
    const std::string text = work.read(folder + "/provenance.json");
    return text.substr(text.find("\"hash\""), 40);
  };
  EXPECT_NE(hash("plain"), hash("set"));
  EXPECT_TRUE(has(work.read("set/report.html"), "--dt")) << "the command that runs it again";
}

TEST(StudySet, IsRefusedWhereTheStudyDecides) {
  const Workplace work;
  work.file("s.hook",
            study_of("Subject ours { engine = dts; contact = lugre; Fix azimuth { value = 0 deg; } "
                     "} Sweep slope { values = 5 deg, 10 deg; }"));
  const auto refused = [&](const std::string& setting, const std::string& says) {
    const CommandResult result = work.hookpoint("study s.hook --out no --set " + setting);
    EXPECT_EQ(result.status, 2) << setting;
    EXPECT_TRUE(has(result.err, says)) << result.err;
    EXPECT_FALSE(fs::exists(work.folder() / "no"));
  };
  refused("slope='3 deg'", "`slope` is swept: it cannot be set as well");
  refused("azimuth='3 deg'", "subject ours fixes `azimuth`");
  refused("world.contact=nominal", "subject ours says its contact itself");
  refused("world.duration='1 s'", "set `s.duration`");
  refused("wrld.deltat='1 ms'", "did you mean `world`?");
  refused("world.deltt='1 ms'", "did you mean `deltat`?");
}

TEST(StudySet, IsRefusedForAFieldThatHangsOnASweep) {
  const Workplace work;
  const std::string step = " Sweep dt { values = 1 ms, 0.1 ms; }";
  work.file("swept.hook", study_of("Subject ours { engine = dts; }" + step));
  work.file("fixed.hook", study_of("Subject ours { engine = dts; Fix dt { value = 2 ms; } }"));
  for (const char* file : {"swept.hook", "fixed.hook"}) {
    for (const char* setting : {"--dt '0.5 ms'", "--set world.deltat='0.5 ms'"}) {
      const CommandResult result =
          work.hookpoint("study " + std::string(file) + " --out no " + setting);
      EXPECT_EQ(result.status, 2) << file << setting;
      EXPECT_TRUE(result.err.starts_with(
          file + std::string(":2:1: error: the study decides of `world.deltat`: it cannot be set")))
          << result.err;
      EXPECT_EQ(count(result.err, "error:"), 1U) << result.err;
      EXPECT_FALSE(fs::exists(work.folder() / "no"));
    }
  }
  // What hangs on another Param may be set.
  EXPECT_EQ(work.hookpoint("study swept.hook --out yes --set world.seed=7").status, 0);
}

TEST(StudyWarnings, AreToldOnceAndNotOfWhatASubjectChose) {
  const Workplace work;
  work.file("block.hook",
            "Param tolerance = 1e-6;\nParam mu = 0.8;\nWorld w { relative_tolerance = tolerance; "
            "Terrain.Flat g; Robot b { Base.mobile { rest_on = g; Shape.Box { dimensions = .2, .2, "
            ".1; mass = 1; } } } }");
  const std::string study =
      " { scene = \"block.hook\"; duration = 2 ms; settle = 1 ms; Measure slip_distance; Subject ";
  work.file("chosen.hook", "Study one" + study + "ours { integrator = rk4; } }");
  const std::string says = "relative_tolerance says nothing to";
  EXPECT_FALSE(has(work.hookpoint("study chosen.hook --out a").err, says));
  work.file("plain.hook", "Study one" + study + "ours { engine = dts; } }\nStudy two" + study +
                              "ours { engine = dts; } }");
  EXPECT_EQ(count(work.hookpoint("study plain.hook --out b").err, says), 1U);
}

TEST(Version, NamesTheProgramAndItsEngines) {
  const Workplace work;
  const CommandResult version = work.hookpoint("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(version.out.starts_with("hookpoint ")) << version.out;
  EXPECT_TRUE(has(version.out, "engine dts ")) << version.out;
  EXPECT_TRUE(has(version.out, "engine ode ")) << version.out;
  EXPECT_EQ(work.hookpoint("-V").out, version.out);
}

TEST(Describe, SaysWhatAListTakes) {
  const Workplace work;
  EXPECT_TRUE(has(work.hookpoint("describe Sum").out, "in  1 or 8 numbers"));
  work.file("sum.hook", ball() + "Sum s { in = 1, 2, 3; }");
  EXPECT_EQ(work.hookpoint("check sum.hook").status, 2);
}

TEST(Describe, KnowsEveryNameOfItsTables) {
  const application::Application application;
  std::vector<std::string> names{"default", "recommended", "matched"};
  for (const auto& [name, entry] : application.schema().classes()) {
    names.push_back(name);
    names.push_back(entry.name);
  }
  for (const auto& law : contact::law_table()) names.emplace_back(law.name);
  for (const auto& stepper : integrators::stepper_table()) names.emplace_back(stepper.name);
  for (const auto& [name, engine] : application.engines()) names.push_back(name);
  for (const auto& metric : studies::metric_table()) names.emplace_back(metric.name);
  for (const auto& signal : studies::signal_table()) names.emplace_back(signal.name);
  for (const std::string& name : names) {
    std::string problem;
    const std::vector<std::string> texts = cli::described(application, name, problem);
    EXPECT_FALSE(texts.empty()) << name << ": " << problem;
  }
}

TEST(Describe, TakesShortNamesAndShowsAllThatAreCalledSo) {
  const Workplace work;
  EXPECT_TRUE(has(work.hookpoint("describe Claim").out, "Claim in Study\n"));
  EXPECT_TRUE(has(work.hookpoint("describe State").out, "State in StateMachine\n"));
  EXPECT_TRUE(has(work.hookpoint("describe Slope").out, "Terrain.Slope\n"));
  const std::string plots = work.hookpoint("describe Plot").out;
  EXPECT_TRUE(has(plots, "Plot in Study\n") && has(plots, "Plot\n  ")) << plots;
  const CommandResult feet = work.hookpoint("describe Foot");
  EXPECT_EQ(feet.status, 2);
  EXPECT_TRUE(has(feet.err, "Controller.Foot") && has(feet.err, "Sensor.Foot")) << feet.err;
  const std::string lugre = work.hookpoint("describe lugre").out;
  EXPECT_TRUE(has(lugre, "contact law") && has(lugre, "viscous_friction")) << lugre;
  EXPECT_TRUE(has(work.hookpoint("describe lurge").err, "did you mean `lugre`?"));
}

TEST(Options, AreNamedOnceInAMessage) {
  const Workplace work;
  for (const char* arguments :
       {"view a.hook --token short", "view a.hook --port 70000", "run a.hook --set x",
        "compare a b --tolerance x", "study a.hook --slurm --tasks 0"}) {
    const CommandResult result = work.hookpoint(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(testing::broken_rule(result.err), "") << result.err;
  }
}

/// The names of options ("--set") in a text of help.
std::set<std::string> options_in(const std::string& text) {
  std::set<std::string> found;
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
    std::size_t end = at + 2;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '-'))
      ++end;
    if (end > at + 2 && (at == 0 || text[at - 1] != '-')) found.insert(text.substr(at, end - at));
  }
  return found;
}

/// The commands that --help lists.
std::vector<std::string> commands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    if (line.starts_with("  ") && line[2] != ' ' && words >> name) names.push_back(name);
  }
  return names;
}

TEST(Manual, PageCompletionAndDocumentationHaveEveryOptionOfHelp) {
  const Workplace work;
  std::string page = work.hookpoint("describe --man").out;
  for (std::size_t at = page.find("\\-"); at != std::string::npos; at = page.find("\\-", at))
    page.erase(at, 1);
  const std::string completion = work.hookpoint("describe --completion bash").out;
  const std::string manual = testing::read_file(testing::source_folder() + "/docs/command_line.md");
  const std::vector<std::string> names = commands(work.hookpoint("--help").out);
  EXPECT_GT(names.size(), 12U);
  const std::function<void(const std::string&)> look_for = [&](const std::string& command) {
    const std::string help = work.hookpoint(command + " --help").out;
    EXPECT_TRUE(has(page, ".SS " + command + " ")) << command;
    const std::string first = command.substr(0, command.find(' '));
    EXPECT_TRUE(has(completion, "    " + first + ") options=")) << command;
    EXPECT_TRUE(has(manual, "hookpoint " + command + " ")) << command;
    for (const std::string& option : options_in(help)) {
      EXPECT_TRUE(has(page, "\\fB" + option + "\\fR")) << command << ' ' << option;
      EXPECT_TRUE(has(completion, " " + option)) << command << ' ' << option;
      EXPECT_TRUE(has(manual, option)) << command << ' ' << option;
    }
    if (!has(help, "Subcommands:")) return;
    for (const std::string& part : commands(help)) look_for(command + " " + part);
  };
  for (const std::string& command : names) look_for(command);
  for (const char* status : {"0", "1", "2", "3", "130"})
    EXPECT_TRUE(has(page, std::string("\\fB") + status + "\\fR")) << status;
}

TEST(Manual, FilesOfTheBuildAreThoseThatTheProgramPrints) {
  const Workplace work;
  EXPECT_EQ(testing::read_file(testing::build_folder() + "/hookpoint.1"),
            work.hookpoint("describe --man").out);
  EXPECT_EQ(testing::read_file(testing::build_folder() + "/hookpoint.bash"),
            work.hookpoint("describe --completion bash").out);
}

TEST(Manual, BashCompletesCommandsOptionsAndTheirWords) {
  const Workplace work;
  work.file("mine.hook", "");
  const auto completed = [&](const std::string& words, int at) {
    const std::string script = "cd '" + work.folder().string() + "' && bash -c 'source " +
                               testing::build_folder() + "/hookpoint.bash; COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(at) +
                               "; _hookpoint; echo \"${COMPREPLY[*]}\"' > .out";
    EXPECT_EQ(std::system(script.c_str()), 0);
    return work.read(".out");
  };
  EXPECT_EQ(completed("hookpoint ru", 1), "run runs\n");
  EXPECT_EQ(completed("hookpoint mi", 1), "mine.hook\n");
  EXPECT_EQ(completed("hookpoint run --eng", 2), "--engine\n");
  EXPECT_EQ(completed("hookpoint run --engine bul", 3), "bullet\n");
  EXPECT_EQ(completed("hookpoint study --qu", 2), "--quick\n");
  EXPECT_EQ(completed("hookpoint mine.hook --qu", 2), "--quick\n");
  EXPECT_EQ(completed("hookpoint mine.hook --quick --rec", 3), "--record\n");
  EXPECT_EQ(completed("hookpoint mine.hook --engine bul", 3), "bullet\n");
  EXPECT_EQ(completed("hookpoint run mi", 2), "mine.hook\n");
  EXPECT_EQ(completed("hookpoint describe --completion b", 3), "bash\n");
  EXPECT_EQ(completed("hookpoint fixture ex", 2), "export\n");
  EXPECT_EQ(completed("hookpoint fixture run --re", 3), "--resume\n");
}

}  // namespace
}  // namespace hookpoint
