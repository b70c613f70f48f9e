// The program as a user meets it: what it prints, writes and returns, above all when the input is
// wrong.
#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/derived_file.h"
#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::config;
using testing::Workplace;

const std::string block = config("scenes/sloped_block.hook");

struct WrongInput {
  std::string arguments;
  std::string says;  // part of the message
};

class WrongInputTest : public ::testing::TestWithParam<WrongInput> {};

TEST_P(WrongInputTest, IsToldAndNothingIsWritten) {
  const Workplace work;
  work.file("empty.hook", "");
  work.file("text.hook", "this is no experiment");
  work.file("binary.hook", std::string("World w {\0\1\2\xff}", 14));
  const std::size_t before = work.entries();
  const CommandResult result = work.hookpoint(GetParam().arguments);
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << result.err;
  EXPECT_EQ(work.entries(), before);
}

INSTANTIATE_TEST_SUITE_P(
    CommandLine, WrongInputTest,
    ::testing::Values(
        WrongInput{"rn " + block, "there is no command `rn`; did you mean `run`?"},
        WrongInput{"run", "run takes a FILE, or --resume MOVIE"},
        WrongInput{"run nowhere.hook", "nowhere.hook: error: there is no such file"},
        WrongInput{"run .", "this is a folder"},
        WrongInput{"run empty.hook", "empty.hook: error: the file describes nothing"},
        WrongInput{"check text.hook", "text.hook:1:"},
        WrongInput{"check binary.hook", "not a text file"},
        WrongInput{"run " + block + " --set world.deltt=1ms", "did you mean `deltat`?"},
        WrongInput{"run " + block + " --set slope", "--set takes TRAIL=VALUE, not `slope`"},
        WrongInput{"run " + block + " --set slope='15 kg'", "takes a value in rad, not in kg"},
        WrongInput{"run " + block + " --for '10 kg'", "`duration` takes a value in s, not in kg"},
        WrongInput{"run " + block + " --for -1s", "must be greater than 0 s"},
        WrongInput{"run " + block + " --record block.base.locatoin.x",
                   "did you mean `block.base.location.x`?"},
        WrongInput{"run " + block + " --set world.contact=impulse --set world.integrator=rk4",
                   "cannot be paired with rk4"},
        WrongInput{"run " + block + " --set world.constraint_mixing=0",
                   "constraint_mixing is a constant of ODE, and the engine is dts"},
        WrongInput{"engines nowhere.hook", "there is no file nowhere.hook"},
        WrongInput{"study " + block, "holds no Study, no Wall and no Matrix"},
        WrongInput{"study " + config("studies/creep.hook") + " --jobs 0",
                   "--jobs takes a whole number"},
        WrongInput{"study " + config("studies/creep.hook") + " --only nobody", "nobody"},
        WrongInput{"describe Base.mobil", "did you mean `Base.mobile`?"},
        WrongInput{"describe creep", "it is part of creep_"},
        WrongInput{"new robt walker", "KIND is one of robot, study, controller, not `robt`"},
        WrongInput{"replay run.h5 --film a.webm --quality best",
                   "--quality is one of low, medium, high"}));

// A file of another kind is wrong as a whole, not in each of its lines.
TEST(CommandLine, AFileOfAnotherKindHasOneError) {
  const Workplace work;
  work.file("notes.md", "\n# Notes\n\n| a | b |\n|---|---|\n| 1 | 2 |\n");
  const CommandResult result = work.hookpoint("check notes.md");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("notes.md:2:1: error: this is no configuration"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.err.find("error"), result.err.rfind("error")) << result.err;
}

TEST(CommandLine, ALawOrAnIntegratorForAnotherEngineIsNotedAsUnread) {
  const Workplace work;
  for (const auto& [option, field] :
       {std::pair{" --contact lugre", "`contact`"}, {" --integrator rk4", "`integrator`"}}) {
    const std::string note = std::string(field) + " is not read: it is of engine dts";
    const std::string command = "run " + block + " --for 5ms" + option;
    const CommandResult other = work.hookpoint(command + " --engine ode");
    EXPECT_EQ(other.status, 0) << other.err;
    EXPECT_NE(other.err.find(note), std::string::npos) << other.err;
    EXPECT_EQ(work.hookpoint(command).err.find(note), std::string::npos);
  }
  EXPECT_EQ(work.hookpoint("run " + block + " --for 5ms --engine ode").err.find("is not read"),
            std::string::npos);
}

TEST(CommandLine, RunRecordsARowAtTimeZeroThenOneAStep) {
  const Workplace work;
  const CommandResult result = work.hookpoint(
      "run " + block + " --for 5ms --record world.block.base.location.x,time --out here");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string trace = work.read("here/trace.csv");
  EXPECT_EQ(trace.substr(0, trace.find('\n')), "time [s],world.block.base.location.x [m],time [s]");
  EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 1 + 6);
  EXPECT_NE(result.err.find("largest stable step"), std::string::npos);
  EXPECT_FALSE(work.read("here/experiment.hook").empty());
}

TEST(CommandLine, ThePrintedExperimentGivesTheSameBytes) {
  const Workplace work;
  const std::string record =
      " --for 50ms --record block.base.location.x,block.base.location.z,block.base.orientation.y "
      "--out ";
  ASSERT_EQ(work.hookpoint("run " + block + " --set slope='23 deg'" + record + "a").status, 0);
  ASSERT_EQ(work.hookpoint("run a/experiment.hook" + record + "b").status, 0);
  EXPECT_EQ(work.read("a/trace.csv"), work.read("b/trace.csv"));
  EXPECT_EQ(work.read("a/experiment.hook"), work.read("b/experiment.hook"));
}

// In the same words wherever it shows.
TEST(CommandLine, AStepAboveTheBoundIsWarnedOf) {
  const Workplace work;
  work.file("box.hook",
            "World w { deltat = 5 ms; duration = 20 ms; Terrain.Flat f; Robot r { Base.mobile { "
            "rest_on = f; Shape.Cube { dimensions = .1, .1, .1; mass = 1 kg; } } } Movie m; }");
  const std::string said =
      "warning: deltat 0.005 s is above the largest stable step 0.000434 s of "
      "semi_implicit_euler under the law hookpoint: what springs back gains "
      "energy; make the step smaller (deltat = auto) or the ground softer, or "
      "choose another integrator";
  for (const std::string& command :
       {std::string("check box.hook"), std::string("run box.hook --out a"),
        std::string("run --resume a/m.h5 --at 10ms --for 10ms --out b")}) {
    const CommandResult result = work.hookpoint(command);
    EXPECT_EQ(result.status, 0) << command << result.err;
    EXPECT_NE(result.err.find(said), std::string::npos) << command << result.err;
  }
}

// With the default step nothing is to be warned of, and the step stands in what is printed.
TEST(CommandLine, TheDefaultStepIsStableAndWritten) {
  const Workplace work;
  work.file("box.hook",
            "World w { duration = 20 ms; Terrain.Flat f; Robot r { Base.mobile { rest_on = f; "
            "Shape.Cube { dimensions = .1, .1, .1; mass = 1 kg; } } } }");
  const std::string record = " --record w.r.base.location --out ";
  const CommandResult first = work.hookpoint("run box.hook" + record + "a");
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.err.find("warning"), std::string::npos) << first.err;
  EXPECT_NE(work.read("a/experiment.hook").find("deltat = 2e-04;"), std::string::npos)
      << work.read("a/experiment.hook");
  EXPECT_EQ(work.hookpoint("run a/experiment.hook" + record + "b").status, 0);
  EXPECT_EQ(work.read("a/trace.csv"), work.read("b/trace.csv"));
  EXPECT_EQ(work.read("a/experiment.hook"), work.read("b/experiment.hook"));
  EXPECT_EQ(work.hookpoint("run box.hook --dt 0.2ms" + record + "c").status, 0);
  EXPECT_EQ(work.read("a/trace.csv"), work.read("c/trace.csv"));
}

TEST(CommandLine, WhatTheBoundHoldsAndLeavesOutIsTold) {
  const Workplace work;
  const std::string wheel =
      "World w { gravity = 0; duration = 1 ms; deltat = 1 ms; Robot r { Base.fixed; Chain c { Link "
      "l "
      "{ mass = 1; inertia = 1,1,1,0,0,0; } } } }\n"
      "Controller.PD held { pconstant = 400; dconstant = 10; Wire FROM w.r.c.l.angle TO current; "
      "Wire FROM w.r.c.l.rate TO rate_in; Wire TO w.r.c.l.torque; }\n"
      "Gain watching { Wire FROM w.r.c.l.rate TO input; Wire TO held.goal; }\n";
  work.file("wheel.hook", wheel);
  const auto run = work.hookpoint("run wheel.hook");
  EXPECT_EQ(run.status, 0) << run.err;
  // (sqrt(c^2 + 4 k) - c)/k.
  EXPECT_NE(run.err.find("largest stable step of semi_implicit_euler for r: 0.07808 s"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("not in it: watching: a Gain is not one of the PD and PID"),
            std::string::npos)
      << run.err;
  const auto biped = work.hookpoint("advise " + config("scenes/standing_biped.hook"));
  EXPECT_NE(biped.out.find("with the loops of world.hip[0].pd; "), std::string::npos) << biped.out;
  EXPECT_NE(biped.out.find("; and 7 more\n"), std::string::npos) << biped.out;
}

TEST(CommandLine, AdviceOfAWishWarnsOfNoConstantThatTheWishItselfStates) {
  const Workplace work;
  const CommandResult plain = work.hookpoint("advise " + block);
  const CommandResult wished =
      work.hookpoint("advise " + block + " --penetration 0.5mm --rebound 0.2");
  EXPECT_EQ(wished.status, 0) << wished.err;
  EXPECT_EQ(wished.err, plain.err);
  EXPECT_EQ(work.hookpoint("advise " + block + " --penetration=-1mm").status, 2);
}

TEST(CommandLine, ANonFiniteStateStopsTheRunWithTimeBodyAndAdvice) {
  const Workplace work;
  const CommandResult result =
      work.hookpoint("run " + block +
                     " --for 100s --set world.deltat=1s --set world.integrator=explicit_euler "
                     "--out here --record block.base.location.x");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("the run stopped at"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("block.base"), std::string::npos);
  EXPECT_NE(result.err.find("make the step smaller"), std::string::npos);
  EXPECT_FALSE(work.read("here/trace.csv").empty());
}

TEST(CommandLine, FigureSevenParsesChecksAndRuns) {
  const Workplace work;
  const std::string figure = config("paper/fig7_two_joint_arm.hook");
  EXPECT_EQ(work.hookpoint("check " + figure).status, 0);
  const CommandResult result = work.hookpoint("run " + figure + " --for 100ms");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("simplebot.leg1.link2"), std::string::npos);
}

TEST(CommandLine, DynamicsOfFreeFallIsGravity) {
  const Workplace work;
  const std::string file = work.file("fall.hook",
                                     "World w { Robot stone { Base.mobile { mass = 2; inertia = "
                                     "1,1,1,0,0,0; location = 0,0,5; } } }");
  const CommandResult result = work.hookpoint("dynamics fall.hook --json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("\"linear_acceleration\": [0, 0, -9.81"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("\"potential_energy\": 98.1"), std::string::npos) << result.out;
  // Nothing drives a body without joints.
  EXPECT_NE(result.out.find("\"B\": []"), std::string::npos) << result.out;
}

TEST(CommandLine, HelpAndListsSucceed) {
  const Workplace work;
  for (const char* arguments :
       {"--help", "run --help", "study --help", "--version", "engines", "engines --json",
        "describe", "describe World", "describe force_residual"}) {
    const CommandResult result = work.hookpoint(arguments);
    EXPECT_EQ(result.status, 0) << arguments;
    EXPECT_FALSE(result.out.empty()) << arguments;
  }
}

// docs/reference_language.md is what `hookpoint describe --markdown` prints.
TEST(CommandLine, TheManualsReferencePageIsCurrent) {
  const Workplace work;
  EXPECT_EQ(testing::stale("reference", testing::source_folder() + "/docs/reference_language.md",
                           work.hookpoint("describe --markdown").out),
            "");
}

// docs/parameters.md is what `hookpoint translate --parameters` prints.
TEST(CommandLine, TheManualsPageOfParametersIsCurrent) {
  const Workplace work;
  EXPECT_EQ(testing::stale("reference", testing::source_folder() + "/docs/parameters.md",
                           work.hookpoint("translate --parameters").out),
            "");
}

TEST(CommandLine, FmtIsIdempotent) {
  const Workplace work;
  work.file("a.hook", "World   w{deltat=1 ms; // the step\n}\n");
  EXPECT_EQ(work.hookpoint("fmt --check a.hook").status, 1);
  EXPECT_EQ(work.hookpoint("fmt a.hook").status, 0);
  const std::string once = work.read("a.hook");
  EXPECT_NE(once.find("// the step"), std::string::npos);
  EXPECT_EQ(work.hookpoint("fmt --check a.hook").status, 0);
  EXPECT_EQ(work.read("a.hook"), once);
}

}  // namespace
}  // namespace hookpoint
