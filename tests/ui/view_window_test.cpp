// A live run in the window, seen by a client that is no browser: what is asked is carried out in
// its order, whatever the run is doing, and what was done repeats.
// ctest: clock
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <memory>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/window_client.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::WindowClient;
using testing::Workplace;
using Leaves = std::map<std::string, std::string>;

/// A block of 1 kg held by four hooks on a slope, and a force on it.
constexpr const char* pushed_block = R"(
Param slope = 20 deg;
World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.3 s;
  Material clay { normal_stiffness = 20 kN/m; tangential_stiffness = 20 kN/m;
                  normal_damping = 100 N.s/m; tangential_damping = 100 N.s/m;
                  static_friction = .8; kinetic_friction = .8; }
  Terrain.Slope ground { angle = slope; material = clay; }
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = .2, .2, .1; mass = 1 kg; } } }
  Force push { body = block.base; }
}
Window {
  Valuator.Slider sideways { range = -5 N, 5 N; Wire TO w.push.force.y; }
  Plot way { show = w.block.base.location; }
}
)";

class ViewWindow : public ::testing::Test {
 protected:
  ViewWindow() { place.file("scene.hook", pushed_block); }

  void open(std::vector<std::string> options = {}, const std::string& file = "scene.hook") {
    std::vector<std::string> words{"view", file, "--no-open"};
    words.insert(words.end(), options.begin(), options.end());
    program = std::make_unique<ChildProcess>(place.folder(), words);
    ASSERT_TRUE(program->wait_until([&] { return program->out().find('\n') != std::string::npos; }))
        << program->err();
    const std::string out = program->out();
    client = std::make_unique<WindowClient>(out.substr(0, out.find('\n')));
    ASSERT_TRUE(client->connected()) << out;
  }
  int say(const std::string& name, const std::string& members = "") {
    client->say("{\"id\": " + std::to_string(++last) + ", \"do\": \"" + name + "\"" +
                (members.empty() ? "" : ", " + members) + "}");
    return last;
  }
  /// What is answered to request `id`; what comes before it is dropped.
  Leaves hear(int id) {
    while (const auto message = client->hear()) {
      const auto leaves = text::json_leaves(*message);
      if (!leaves) continue;
      Leaves read(leaves->begin(), leaves->end());
      if (read["id"] == std::to_string(id)) return read;
    }
    ADD_FAILURE() << "no answer to " << id << "; " << program->err();
    return {};
  }
  Leaves ask(const std::string& name, const std::string& members = "") {
    return hear(say(name, members));
  }
  double read(const std::string& trail) {
    const Leaves answer = ask("read", "\"trails\": [\"" + trail + "\"]");
    const auto value = answer.find("values[0].value");
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (value == answer.end()) return unknown;
    return value->second == "null" ? unknown : std::stod(value->second);
  }
  void step(int count) {
    EXPECT_EQ(ask("step", "\"count\": " + std::to_string(count))["error"], "");
  }
  void push(double force) {
    EXPECT_EQ(
        ask("set", "\"values\": {\"sideways.value\": " + std::to_string(force) + "}")["error"], "");
  }
  Leaves edit(const std::string& trail, const std::string& value) {
    return ask("edit", "\"trail\": \"" + trail + "\", \"value\": \"" + value + "\"");
  }
  /// The next notice in which `text` stands.
  bool told(const std::string& text) {
    while (const auto message = client->hear())
      if (message->find("\"notice\"") != std::string::npos &&
          message->find(text) != std::string::npos)
        return true;
    return false;
  }
  int ends() {
    client.reset();
    return program->wait();
  }
  /// `run --changes` of what was left leaves the same bytes.
  void expect_repeats() {
    const auto again = place.hookpoint(
        "run scene.hook --for '100 s' --changes live/changes.csv --out again --record "
        "'w.block.base.*'");
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_FALSE(place.read("live/trace.csv").empty());
    EXPECT_EQ(place.read("live/trace.csv"), place.read("again/trace.csv"));
    EXPECT_EQ(place.read("live/changes.csv"), place.read("again/changes.csv"));
  }

  const std::vector<std::string> recorded{"--for", "100 s",    "--out",
                                          "live",  "--record", "w.block.base.*"};
  Workplace place;
  std::unique_ptr<ChildProcess> program;
  std::unique_ptr<WindowClient> client;
  int last = 0;
};

TEST_F(ViewWindow, ARobotsFileIsShownOnAPlane) {
  std::filesystem::copy_file(testing::source_folder() + "/configs/robots/quadruped.urdf",
                             place.folder() / "quadruped.urdf");
  open({}, "quadruped.urdf");
  const auto description = client->hear();
  ASSERT_TRUE(description);
  EXPECT_NE(description->find("world.quadruped.front_left.front_left_hip"), std::string::npos);
  step(200);
  EXPECT_GT(read("world.ground.contact.normal_load"), 50.);
}

TEST_F(ViewWindow, FieldsAreEditedWhileItPlaysAndPlots) {
  open();
  ask("speed", "\"factor\": 0");
  for (int i = 0; i < 60; ++i)
    EXPECT_EQ(edit("w.clay.normal_stiffness", std::to_string(20 + i % 5) + " kN/m")["ok"], "true");
  // Within the file's own frame of time, the block stands on its four corners.
  ask("pause");
  step(500);
  EXPECT_NEAR(read("w.block.contact.force.z"), 9.81, 1e-3);
  program->signal(SIGTERM);
  EXPECT_EQ(ends(), 0) << program->err();
}

TEST_F(ViewWindow, WhatIsReadAfterASetIsWhatWasSet) {
  open();
  ask("speed", "\"factor\": 0");
  for (int i = 1; i <= 40; ++i) {
    const std::string value = std::to_string(0.01 * i);
    const int set = say("set", "\"values\": {\"sideways.value\": " + value + "}");
    const int after = say("read", "\"trails\": [\"sideways.value\"]");
    EXPECT_EQ(hear(set)["ok"], "true");
    EXPECT_DOUBLE_EQ(std::stod(hear(after)["values[0].value"]), std::stod(value));
  }
}

TEST_F(ViewWindow, StartsAgainFromAPoseAndWaitsThere) {
  open(recorded);
  ask("pause");
  step(50);
  EXPECT_EQ(ask("start_from",
                "\"values\": {\"w.block.base.location\": [0, 0, 2], "
                "\"w.block.base.location.x\": 0.25}")["ok"],
            "true");
  EXPECT_EQ(read("w.time"), 0.);
  EXPECT_EQ(read("w.block.base.location.x"), 0.25);
  EXPECT_EQ(read("w.block.base.location.z"), 2.);
  step(100);
  EXPECT_NEAR(read("w.block.base.location.z"), 2. - 9.81e-6 * 100. * 101. / 2., 1e-12);
  EXPECT_NE(ask("start_from", "\"values\": {}")["error"].find("initial state"), std::string::npos);
  EXPECT_NE(ask("start_from", "\"values\": {\"w.block.base.location\": [0, \"high\"]}")["error"],
            "");
  EXPECT_NE(ask("start_from", "\"values\": {\"w.block.base.location\": [0, 1]}")["error"].find(
                "takes 3 numbers"),
            std::string::npos);
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
  expect_repeats();
}

/// A link of moment of inertia J, spring k and damper c by a PD controller that takes differences:
/// the step h is stable up to c = 2 J / h - h k / 2, here 2 x 0.25 / 1 ms - 1 ms x 100 / 2.
TEST_F(ViewWindow, SlidersHaveMarksWhereTheStepIsUnstable) {
  place.file("arm.hook", R"(
World w { gravity = 0; deltat = 1 ms;
  Robot arm { Base.fixed {} Chain c { Link l { mass = 1; center_of_mass = 0.5, 0, 0; inertia = 0, 0, 0, 0, 0, 0; } } } }
Controller.PD pd { pconstant = 100; dconstant = 10; Wire FROM w.arm.c.l.angle TO current; Wire FROM output TO w.arm.c.l.torque; }
Window {
  Valuator.Slider damping { range = 10, 1000; Wire TO pd.dconstant; }
  Valuator.Slider aim { range = -1, 1; Wire TO pd.goal; }
})");
  open({}, "arm.hook");
  ask("pause");
  const double most = 2. * 0.25 / 1e-3 - 1e-3 * 100. / 2.;
  Leaves answer = ask("unstable");
  EXPECT_EQ(answer["unstable[0].port"], "damping.value");
  EXPECT_NEAR(std::stod(answer["unstable[0].from"]), most, 990. / 2048. + 1e-9);
  EXPECT_EQ(std::stod(answer["unstable[0].to"]), 1000.);
  EXPECT_FALSE(answer.contains("unstable[1].port"));
  // A stiffer spring leaves less.
  EXPECT_EQ(ask("edit", "\"trail\": \"pd.pconstant\", \"value\": \"400000\"")["ok"], "true");
  answer = ask("unstable");
  EXPECT_NEAR(std::stod(answer["unstable[0].from"]), most - 1e-3 * 399900. / 2.,
              990. / 2048. + 1e-9);
}

TEST_F(ViewWindow, WhatHasEndedIsNotChanged) {
  open({"--for", "0.1 s", "--out", "live", "--record", "w.block.base.*"});
  ask("speed", "\"factor\": 0");
  ASSERT_TRUE(told("come to its end"));
  const std::string whole = place.read("live/trace.csv");
  EXPECT_EQ(ask("seek", "\"time\": 0.05")["ok"], "true");
  for (const Leaves& answer : {ask("set", "\"values\": {\"sideways.value\": 1}"),
                               edit("slope", "10 deg"), ask("step"), ask("run")})
    EXPECT_EQ(answer.at("error"), "the run has ended; reset starts it again");
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
  EXPECT_FALSE(whole.empty());
  EXPECT_EQ(place.read("live/trace.csv"), whole);
}

TEST_F(ViewWindow, ARunThatWasChangedRepeatsUpToWhereItWasQuit) {
  open(recorded);
  ask("pause");
  step(50);
  push(2.);
  step(70);
  EXPECT_EQ(edit("w.clay.tangential_stiffness", "10 kN/m")["ok"], "true");
  step(30);
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
  EXPECT_NE(place.read("live/changes.csv").find("Simulator.quit"), std::string::npos);
  expect_repeats();
}

TEST_F(ViewWindow, ARunThatEndsInThePastEndsWhereItHadCome) {
  open(recorded);
  ask("pause");
  step(40);
  push(2.);
  step(60);
  EXPECT_EQ(ask("seek", "\"time\": 0.03")["ok"], "true");
  EXPECT_NEAR(read("w.time"), 0.03, 1e-12);
  program->signal(SIGTERM);
  EXPECT_EQ(ends(), 0) << program->err();
  EXPECT_NE(place.read("live/changes.csv").find("Simulator.quit"), std::string::npos);
  expect_repeats();
}

TEST_F(ViewWindow, AMillionStepsAreEndedByASignal) {
  open();
  ask("pause");
  say("step", "\"count\": 1000000");
  const int after = say("read", "\"trails\": [\"w.time\"]");
  program->signal(SIGTERM);
  EXPECT_EQ(program->wait(), 0) << program->err();
  while (const auto message = client->hear())
    EXPECT_EQ(message->find("\"id\": " + std::to_string(after)), std::string::npos) << *message;
}

/// Four springs k: the block gives m g sin / (4 k) along the slope, whichever way one has gone
/// through time, and goes on from there under another slope.
TEST_F(ViewWindow, DisplacementsAreSinceTheStartThroughHistoryAndChange) {
  const double weight = 9.81, stiffness = 4 * 20e3;
  const auto gives = [&](double degrees) {
    return weight * std::sin(degrees * M_PI / 180.) / stiffness;
  };
  // What pulls at it would be no part of the closed form.
  std::string alone = pushed_block;
  for (const char* line : {"  Force push", "  Valuator.Slider"}) {
    const std::size_t begin = alone.find(line);
    alone.erase(begin, alone.find('\n', begin) - begin);
  }
  alone.replace(alone.find("rest_on = ground;"), 17, "rest_on = ground; settled = false;");
  place.file("scene.hook", alone);
  open({"--with", "rk4"});
  ask("pause");
  step(2000);
  const double settled = read("Subjects[0].displacement"), way = read("Subjects[0].slip");
  EXPECT_NEAR(settled, gives(20.), 1e-3 * gives(20.));
  EXPECT_EQ(ask("seek", "\"time\": 0.5")["ok"], "true");
  EXPECT_GT(read("Subjects[0].displacement"), 0.5 * settled);
  EXPECT_EQ(ask("seek", "\"time\": 2")["ok"], "true");
  EXPECT_NEAR(read("Subjects[0].displacement"), settled, 1e-12);
  EXPECT_NEAR(read("Subjects[0].slip"), way, 1e-12);
  EXPECT_NEAR(read("Subjects[0].displacement_predicted"), gives(20.), 1e-9 * gives(20.));

  EXPECT_EQ(edit("w.clay.tangential_stiffness", "10 kN/m")["ok"], "true");
  step(3000);
  for (const char* subject : {"Subjects[0]", "Subjects[1]"}) {
    SCOPED_TRACE(subject);
    EXPECT_NEAR(read(std::string(subject) + ".displacement"), 2 * gives(20.), 2e-3 * gives(20.));
    EXPECT_NEAR(read(std::string(subject) + ".displacement_predicted"), 2 * gives(20.),
                1e-9 * gives(20.));
  }
}

TEST_F(ViewWindow, WarnsOfAnUnstableStep) {
  std::string coarse = pushed_block;
  coarse.replace(coarse.find("deltat = 1 ms"), 13, "deltat = 20 ms");
  place.file("scene.hook", coarse);
  open();
  EXPECT_TRUE(told("deltat 0.02 s is above the largest stable step"));
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
  EXPECT_NE(program->err().find("warning: deltat 0.02 s is above"), std::string::npos);
}

// The state of a run means nothing with another step: it stays as it was chosen, and is warned of.
TEST_F(ViewWindow, KeepsTheChosenStepUntilAReset) {
  std::string chosen = pushed_block;
  chosen.replace(chosen.find("deltat = 1 ms;"), 14, "");
  place.file("scene.hook", chosen);
  open();
  ask("pause");
  const double begun = read("w.time");
  step(20);
  EXPECT_NEAR(read("w.time"), begun + 0.01, 1e-12);
  EXPECT_EQ(edit("w.clay.normal_stiffness", "20 MN/m")["ok"], "true");
  EXPECT_TRUE(told("deltat 0.0005 s is above the largest stable step"));
  step(20);
  EXPECT_NEAR(read("w.time"), begun + 0.02, 1e-12);
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
}

TEST_F(ViewWindow, AFileThatIsSavedBrokenLeavesTheRunAsItWas) {
  open(recorded);
  ask("pause");
  step(20);
  const double before = read("w.time");
  std::string renamed = pushed_block;
  for (std::size_t at; (at = renamed.find("block")) != std::string::npos;)
    renamed.replace(at, 5, "crate");
  place.file("scene.hook", renamed);
  EXPECT_TRUE(told("the run continues as it was"));
  EXPECT_EQ(read("w.time"), before);
  place.file("scene.hook", "World w {");
  EXPECT_TRUE(told("the run continues as it was"));
  EXPECT_NE(ask("patch")["error"], "");
  step(20);
  EXPECT_NEAR(read("w.time"), before + 0.02, 1e-12);
  place.file("scene.hook", pushed_block);
  say("quit");
  EXPECT_EQ(ends(), 0) << program->err();
}

}  // namespace
}  // namespace hookpoint
