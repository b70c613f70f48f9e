// Engines that are programs, as a user meets them: who may start one, what a run in one shows, what is
// said of each that does wrong, and that a study goes on.
// ctest: long, released
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::has;
using testing::Workplace;
namespace fs = std::filesystem;

const fs::path engines = fs::path(testing::source_folder()) / "tests/support/engines";

/// A ball of 1 kg on a slope of 15 deg, on whose normal's foot it rests.
constexpr const char* ball_on_slope = R"(Include "engines.hook";
Param engine = dts;
Param mass = 1 kg;
World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.5 s; engine = engine;
  Material felt { normal_stiffness = 20 kN/m; normal_damping = 100; tangential_stiffness = 20 kN/m; tangential_damping = 100; static_friction = 0.8; }
  Terrain.Slope ground { angle = 15 deg; material = felt; }
  Robot ball { Base.mobile { location = 0.02588, 0, 0.09659; mass = mass; Shape.Sphere { radius = 0.1; } } }
}
)";

class EngineProgram : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("HOOKPOINT_TRUSTED_ENGINES"); }
  void TearDown() override { unsetenv("HOOKPOINT_TRUSTED_ENGINES"); }

  /// An Engine block of the test's program.
  static std::string block(const std::string& name, const std::string& words,
                           const std::string& more = "") {
    std::string command = "\"python3\", \"" + (engines / "ball.py").string() + "\"";
    std::istringstream list(words);
    for (std::string word; list >> word;) command += ", \"" + word + "\"";
    return "Engine " + name + " { command = " + command + "; " + more + " }\n";
  }
  /// A run of the ball in the engine that `words` describe.
  CommandResult run(const std::string& words, const std::string& more = "") const {
    place.file("engines.hook", block("mine", words, more));
    place.file("run.hook", ball_on_slope);
    return place.hookpoint("run run.hook --engine mine --for 100ms --allow-engines");
  }
  std::string here() const { return fs::canonical(place.folder()).string(); }

  Workplace place;
};

TEST_F(EngineProgram, NoneIsStartedWithoutPermission) {
  const std::string started = here() + "/started";
  place.file("engines.hook", block("mine", "starts 0 " + started));
  place.file("run.hook", ball_on_slope);
  const std::string refusal =
      "is refused, since it would run with all of your rights: allow it with --allow-engines, or put "
      "its folder `" +
      here() + "` into HOOKPOINT_TRUSTED_ENGINES";
  for (const char* command : {"run run.hook --engine mine", "run.hook --engine mine"}) {
    const CommandResult result = place.hookpoint(command);
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_TRUE(has(result.err, "engine mine: it is a program, which " + refusal))
        << command << result.err;
  }
  EXPECT_TRUE(has(place.hookpoint("engines run.hook").out, refusal));
  EXPECT_FALSE(fs::exists(started));
  EXPECT_EQ(place.hookpoint("run run.hook --for 5ms").status, 0) << "it names no such engine";
  EXPECT_FALSE(fs::exists(started));

  EXPECT_EQ(place.hookpoint("run run.hook --engine mine --for 5ms --allow-engines").status, 0);
  EXPECT_TRUE(fs::exists(started));
  setenv("HOOKPOINT_TRUSTED_ENGINES", here().c_str(), 1);
  EXPECT_EQ(place.hookpoint("run run.hook --engine mine --for 5ms").status, 0);
}

// Without a spring along the ground the ball creeps where the damper bears its weight's part along
// the slope: v = m g sin(a)/c_t, 25.4 mm/s.
TEST_F(EngineProgram, CreepsAsItsClosedFormSays) {
  place.file("engines.hook", "Engine particle { command = \"python3\", \"" +
                                 testing::source_folder() + "/examples/engines/particle.py\"; }\n");
  place.file("run.hook", ball_on_slope);
  place.file("study.hook", R"(Include "engines.hook";
Study creep {
  scene = "run.hook"; settle = 0.3 s; duration = 0.5 s;
  Subject particle { engine = particle; }
  Measure creep_speed;
}
)");
  const CommandResult result = place.hookpoint("study study.hook --out out --allow-engines");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string table = place.read("out/results.csv");
  const double expected = 9.81 * std::sin(15. * M_PI / 180.) / 100.;
  std::istringstream lines(table);
  std::string title, row;
  std::getline(lines, title);
  std::getline(lines, row);
  const auto cell = [&](const std::string& name) {
    std::istringstream titles(title), cells(row);
    std::string head, value;
    while (std::getline(titles, head, ',') && std::getline(cells, value, ','))
      if (head.starts_with(name)) return std::stod(value);
    ADD_FAILURE() << name << " is no column of " << title;
    return 0.;
  };
  EXPECT_NEAR(cell("creep_speed"), expected, 1e-6 * expected) << table;
  EXPECT_TRUE(has(place.read("out/provenance.json"), "particle")) << "it says who ran";
}

TEST_F(EngineProgram, WhatGoesWrongIsSaidWithTheProgramsLastWords) {
  const struct {
    const char *words, *more, *said;
  } cases[] = {
      {"crash 5", "", "the program has ended (exit status 3); its last words: no more balls"},
      {"kill 5", "", "the program has ended (signal 9)"},
      {"hang 5", "deadline = 0.5 s;", "the program has not answered for 0.5 s"},
      {"print 5", "", "answers with what is no frame: does it print to its standard output?"},
      {"short 5", "", "the program's answer to a step ends too early"},
      {"fail 5", "", "the program ends the run: the ball is lost"},
      {"nan 5", "", "the state is not finite"},
  };
  for (const auto& each : cases) {
    const CommandResult result = run(each.words, each.more);
    EXPECT_EQ(result.status, 1) << each.words << result.err;
    EXPECT_TRUE(has(result.err, each.said)) << each.words << ": " << result.err;
  }
}

TEST_F(EngineProgram, ItsWordsAreNoticesOfTheRun) {
  const CommandResult result = run("talk 5");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(has(result.out + result.err, "engine mine: the ball is warm")) << result.err;
}

TEST_F(EngineProgram, OneThatDoesNotStartIsNotFound) {
  place.file("engines.hook",
             "Engine none { command = \"no-such-program\"; install = \"install the package "
             "nothing\"; }\nEngine broken { command = \"python3\", \"missing.py\"; }\n");
  place.file("run.hook", ball_on_slope);
  const CommandResult listed = place.hookpoint("engines run.hook --allow-engines");
  EXPECT_EQ(listed.status, 0);
  EXPECT_TRUE(has(listed.out, "there is no program `no-such-program`: install the package nothing"))
      << listed.out;
  EXPECT_TRUE(has(listed.out, "the program has ended (exit status 2); its last words: "))
      << listed.out;
  EXPECT_TRUE(has(listed.out, "can't open file")) << listed.out;
  const CommandResult ran = place.hookpoint("run run.hook --engine none --allow-engines");
  EXPECT_EQ(ran.status, 2);
  EXPECT_TRUE(has(ran.err, "engine none: there is no program `no-such-program`")) << ran.err;
}

TEST_F(EngineProgram, AStudyGoesOnPastARunThatFails) {
  place.file("engines.hook", block("good", "honest") + block("bad", "crash 200"));
  place.file("run.hook", ball_on_slope);
  place.file("study.hook", R"(Include "engines.hook";
Study creep {
  scene = "run.hook"; settle = 0.1 s; duration = 0.5 s;
  Subject bad { engine = bad; }
  Subject good { engine = good; }
  Measure creep_speed;
}
)");
  const CommandResult result =
      place.hookpoint("study study.hook --out out --jobs 1 --allow-engines");
  const std::string table = place.read("out/results.csv");
  EXPECT_TRUE(has(table, "no more balls")) << table << result.err;
  EXPECT_TRUE(has(table, "ok")) << table;
}

// Wherever the program is killed, the study ends, the run says why, and --resume makes up for it.
TEST_F(EngineProgram, AResumedStudyHasTheBytesOfOneThatNothingDisturbed) {
  const std::string flag = here() + "/flag";
  place.file("run.hook", ball_on_slope);
  place.file("study.hook", R"(Include "engines.hook";
Study creep {
  scene = "run.hook"; settle = 0.02 s; duration = 0.05 s;
  Subject mine { engine = mine; }
  Sweep mass { values = 1 kg, 2 kg, 3 kg; }
  Measure creep_speed;
}
)");
  for (const int step : {1, 2, 30, 51, 75, 100, 101, 149}) {
    const std::string number = std::to_string(step);
    place.file("engines.hook", block("mine", "kill_once " + number + " " + flag));
    const std::string command = "study study.hook --jobs 1 --allow-engines --out ";
    ASSERT_EQ(place.hookpoint(command + "whole" + number).status, 0);
    place.file("flag", "");
    EXPECT_EQ(place.hookpoint(command + "cut" + number).status, 1) << step;
    EXPECT_TRUE(has(place.read("cut" + number + "/results.csv"), "engine_lost at"))
        << step << place.read("cut" + number + "/results.csv");
    EXPECT_TRUE(
        has(place.read("cut" + number + "/results.csv"), "the program has ended (signal 9)"));
    ASSERT_EQ(place.hookpoint(command + "cut" + number + " --resume").status, 0) << step;
    EXPECT_EQ(place.read("cut" + number + "/results.csv"),
              place.read("whole" + number + "/results.csv"))
        << step;
  }
}

// What a run leaves runs again: its experiment includes the file of the Engine block, wherever it lies.
TEST_F(EngineProgram, WhatARunLeftRunsAgain) {
  place.file("engines.hook", block("mine", "honest"));
  place.file("run.hook", ball_on_slope);
  const std::string options =
      " --engine mine --for 50ms --allow-engines --record ball.base.location.x,ball.contact.force.z";
  ASSERT_EQ(place.hookpoint("run run.hook --out one --movie" + options).status, 0);
  const CommandResult again = place.hookpoint("run one/experiment.hook --out two" + options);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(place.read("two/trace.csv"), place.read("one/trace.csv"));
  EXPECT_EQ(place.read("two/experiment.hook"), place.read("one/experiment.hook"));
  const CommandResult moment = place.hookpoint("replay one/movie.h5 --at 0.03 --allow-engines");
  EXPECT_EQ(moment.status, 0) << moment.err;
  EXPECT_EQ(place.hookpoint("replay one/movie.h5 --at 0.03").status, 2) << "without consent";
}

// Where nothing acts on the ball several steps are one exchange, and the states are the same.
TEST_F(EngineProgram, StepsUnderTheSameInputsShareAnExchange) {
  const std::string exchanges = here() + "/exchanges";
  const auto steps = [&](const std::string& scene, const std::string& out) {
    place.file("engines.hook", block("mine", "exchanges 0 " + exchanges));
    place.file("run.hook", scene);
    fs::remove(exchanges);
    const CommandResult result = place.hookpoint(
        "run run.hook --engine mine --for 250ms --allow-engines --record ball.base.location.x --out " +
        out);
    EXPECT_EQ(result.status, 0) << result.err;
    return place.read("exchanges");
  };
  EXPECT_EQ(steps(ball_on_slope, "free"), "100\n100\n50\n");
  std::string driven = ball_on_slope;
  driven.insert(driven.find("  Robot"), "  Force push { body = ball.base; }\n");
  driven +=
      "Expression none { formula = \"0 * w.ball.base.location.x\"; Wire FROM output TO w.push.force.x; }\n";
  const std::string single = steps(driven, "driven");
  EXPECT_EQ(single.size(), std::string("1\n").size() * 250) << single;
  EXPECT_EQ(place.read("free/trace.csv"), place.read("driven/trace.csv"));
}

// A process is started once for the description and for all runs of a thread.
TEST_F(EngineProgram, OneProcessRunsManyExperiments) {
  const std::string started = here() + "/started";
  place.file("engines.hook", block("mine", "starts 0 " + started));
  place.file("run.hook", ball_on_slope);
  place.file("study.hook", R"(Include "engines.hook";
Study creep {
  scene = "run.hook"; settle = 0.1 s; duration = 0.2 s;
  Subject mine { engine = mine; }
  Sweep mass { values = 1 kg, 2 kg, 3 kg, 4 kg; }
  Measure creep_speed;
}
)");
  const CommandResult result =
      place.hookpoint("study study.hook --out out --jobs 1 --allow-engines");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(place.read("started"), "started\n");
}

TEST_F(EngineProgram, AnEngineStandsInAFileOfItsOwn) {
  place.file("both.hook", block("mine", "honest") + "World w { duration = 1 s; }\n");
  const CommandResult both = place.hookpoint("check both.hook");
  EXPECT_EQ(both.status, 2);
  EXPECT_TRUE(has(both.err, "an Engine stands in a file of its own")) << both.err;

  place.file("engines.hook", block("dts", "honest"));
  place.file("run.hook", ball_on_slope);
  const CommandResult twice = place.hookpoint("check run.hook");
  EXPECT_EQ(twice.status, 2);
  EXPECT_TRUE(has(twice.err, "engines.hook:1:1: error: there is an engine `dts` already"))
      << twice.err;
}

// A clone's configs have the engines of the installation too.
TEST_F(EngineProgram, AFolderOfHookpointPathMayHaveAnInstalledOne) {
  std::filesystem::create_directories(place.folder() / "clone/engines");
  place.file("clone/engines/jolt.hook", block("jolt", "honest"));
  place.file("engines.hook", block("mine", "honest"));
  place.file("run.hook", ball_on_slope);
  setenv("HOOKPOINT_PATH", (place.folder() / "clone").c_str(), 1);
  const CommandResult check = place.hookpoint("check run.hook");
  const CommandResult run = place.hookpoint("run run.hook --for 5ms --allow-engines --engine jolt");
  unsetenv("HOOKPOINT_PATH");
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(EngineProgram, AFileOfEnginesMayIncludeAnother) {
  place.file("more.hook", block("second", "honest"));
  place.file("engines.hook", "Include \"more.hook\";\n" + block("mine", "honest"));
  place.file("run.hook", ball_on_slope);
  for (const std::string engine : {"mine", "second"})
    EXPECT_EQ(place.hookpoint("run run.hook --for 5ms --allow-engines --engine " + engine).status,
              0)
        << engine;
}

// Other arguments are another engine: what was stored of the one is not taken for the other's.
TEST_F(EngineProgram, ACommandLineIsPartOfARunsIdentity) {
  place.file("run.hook", ball_on_slope);
  place.file("study.hook", R"(Include "engines.hook";
Study creep {
  scene = "run.hook"; settle = 0.1 s; duration = 0.2 s;
  Subject mine { engine = mine; }
  Measure creep_speed;
}
)");
  const std::string command = "study study.hook --out out --allow-engines --resume";
  place.file("engines.hook", block("mine", "honest"));
  ASSERT_EQ(place.hookpoint(command).status, 0);
  EXPECT_FALSE(has(place.hookpoint(command).err, "again")) << "nothing changed";
  place.file("engines.hook", block("mine", "honest 7"));
  EXPECT_TRUE(has(place.hookpoint(command).err, "it is run again"));
}

TEST_F(EngineProgram, AFolderOfEnginesBesideTheFileIsFound) {
  fs::create_directory(place.folder() / "engines");
  place.file("engines/mine.hook", block("mine", "honest"));
  const std::string scene = ball_on_slope;
  place.file("run.hook", scene.substr(scene.find("Param")));
  EXPECT_EQ(place.hookpoint("run run.hook --engine mine --for 5ms --allow-engines").status, 0);
}

// What the manual shows of a run is what is said.
TEST_F(EngineProgram, TheManualsTranscriptIsOfThisProgram) {
  const fs::path example = fs::path(testing::source_folder()) / "examples/engines";
  place.file("particle.hook", "Engine particle { command = \"python3\", \"" +
                                  (engines / "transcript.py").string() + "\", \"" + here() +
                                  "/transcript\"; }\n");
  place.file("landing.hook", testing::read_file(example / "landing.hook"));
  const CommandResult result = place.hookpoint(
      "run landing.hook --for 3ms --record ball.base.location.z --out out --allow-engines");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string manual =
      testing::read_file(fs::path(testing::source_folder()) / "docs/engine_protocol.md");
  const std::string transcript = place.read("transcript");
  EXPECT_TRUE(has(manual, "```\n" + transcript + "```\n"))
      << "docs/engine_protocol.md does not have this transcript:\n"
      << transcript;
}

// Scenes with all that the protocol has: chains, every shape, planes, triangles, stairs, obstacles.
TEST_F(EngineProgram, MessagesFitTheirJsonSchemas) {
  fs::create_directory(place.folder() / "engines");
  place.file("engines/any.hook", "Engine any { command = \"python3\", \"" +
                                     (engines / "transcript.py").string() + "\", \"" + here() +
                                     "/transcript\", \"any\"; }\n");
  std::string capsule = ball_on_slope;
  capsule.replace(capsule.find("Shape.Sphere"), 12,
                  "Shape.Capsule { radius = 0.1; length = 0.2; } Shape.Sphere");
  std::vector<std::string> scenes{capsule.substr(capsule.find("Param"))};
  for (const char* scene : {"standing_hexapod", "stairs_hexapod", "standing_tin", "rolling_wheel",
                            "tumbling_acrobat", "climbing_hound", "walking_rough"})
    scenes.push_back(std::string("Include \"scenes/") + scene + ".hook\";\n");
  for (const std::string& scene : scenes) {
    place.file("run.hook", scene);
    place.hookpoint("run run.hook --engine any --for 1ms --allow-engines");  // it refuses most
  }
  const fs::path schemas = fs::path(testing::source_folder()) / "docs/engine_protocol";
  const std::string command = "cd '" + here() + "' && python3 '" +
                              (engines / "validate.py").string() + "' transcript '" +
                              schemas.string() + "' >said 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << place.read("said");
  const std::string transcript = place.read("transcript");
  for (const char* word : {"\"revolute\"", "\"plane\"", "\"triangles\"", "\"box\"", "\"sphere\"",
                           "\"cylinder\"", "\"capsule\"", "\"point\""})
    EXPECT_TRUE(has(transcript, word)) << word << " is in no experiment";
}

TEST_F(EngineProgram, TheCheckPassesTheExample) {
  const CommandResult result = place.hookpoint("engine-check python3 '" + testing::source_folder() +
                                               "/examples/engines/particle.py'");
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_TRUE(has(result.out, "joint accelerations    not supported  robots with chains"))
      << result.out;
  EXPECT_TRUE(has(result.out, "0 of 14 checks failed")) << result.out;
}

TEST_F(EngineProgram, TheCheckNamesWhatAProgramDoesWrong) {
  const std::string program = "engine-check python3 '" + (engines / "ball.py").string() + "' ";
  const CommandResult honest = place.hookpoint(program + "honest");
  EXPECT_EQ(honest.status, 0) << honest.out;
  const struct {
    const char *lie, *check;
  } lies[] = {{"order", "quaternion order"},
              {"degrees", "units of angles"},
              {"forces", "contact forces"},
              {"unknown_gap", "hello"},
              {"crash 5", "free fall"}};
  for (const auto& [lie, check] : lies) {
    const CommandResult result = place.hookpoint(program + lie);
    EXPECT_EQ(result.status, 1) << lie;
    const std::string row = std::string(check) + std::string(22 - std::string(check).size(), ' ');
    EXPECT_TRUE(has(result.out, row + " FAILED")) << lie << '\n' << result.out;
  }
}

}  // namespace
}  // namespace hookpoint
