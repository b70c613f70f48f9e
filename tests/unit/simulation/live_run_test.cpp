// A run that people change: what they set reaches its inputs, what they edit is what the physics
// goes on with, and the files are those that `run --changes` leaves, byte for byte, gone back in
// time or not.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/shared/live_loader.h"
#include "apps/view/session/history.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/command.h"
#include "tests/support/text.h"
#include "text/number.h"

namespace hookpoint {
namespace {

using simulation::Change;
using simulation::LiveRun;
using simulation::Moment;
using simulation::PortValue;

constexpr double weight = 9.81, stiffness = 20e3;

/// A block of 1 kg on four springs, a force that a slider sets at once and one that hears it late,
/// noisily and seldom, a pause and a push button.
const std::string block = R"(World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.6 s;
  Material clay { normal_stiffness = 20 kN/m; tangential_stiffness = 20 kN/m;
                  normal_damping = 100 N.s/m; tangential_damping = 100 N.s/m;
                  static_friction = .5; kinetic_friction = .5; }
  Terrain.Flat ground { material = clay; }
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = .2, .2, .1; mass = 1 kg; } } }
  Force wind { body = block.base; }
  Force late { body = block.base; }
  Record places { file = "places.csv"; rate = 250 Hz; trails = block.base.location, wind.force; }
}
Window controls {
  Valuator.Slider east { range = -5, 5; Wire TO w.wind.force.x; }
  Valuator.Slider north { range = -5, 5; Wire TO w.late.force.y { rate = 90 Hz; delay = 7 ms; noise = 10 mN; } }
  Button.Light go { Wire TO w.running; }
  Button.Light heard {}
  Button kick { Wire TO heard.value { rate = 50 Hz; } }
  Button stop { Wire TO Simulator.quit; }
}
)";

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRun& start(const std::string& text = block, const std::string& folder = "live",
                 std::vector<Change> script = {}) {
    place.file("scene.hook", text);
    loader = std::make_unique<application::LiveLoader>(
        place.folder() / "scene.hook", application::Settings(), application::Consent(),
        std::filesystem::path());
    const auto load = [this](const std::vector<std::string>& overrides, std::string& problem) {
      return loader->load(overrides, problem);
    };
    run = std::make_unique<LiveRun>(
        load,
        simulation::LiveRunRequest{place.folder() / folder, {"w.block.base.*", "w.late.**"}, true},
        std::move(script));
    return *run;
  }
  void to(std::int64_t step) {
    while (run->world().state().step < step) {
      const simulation::StepStatus status = run->step();
      ASSERT_TRUE(status.ok()) << status.body << ": " << status.advice;
    }
  }
  void set(const std::string& trail, double value) {
    EXPECT_EQ(run->set(std::vector<PortValue>{{trail, value}}), "");
  }
  double operator[](const std::string& trail) {
    return *simulation::find_port(run->experiment(), run->world().ports(), trail).value;
  }
  /// The run is over; `run --changes` of what it left is the same run.
  void expect_repeats() {
    run->close();
    run.reset();
    const auto repeated = place.hookpoint(
        "run scene.hook --changes live/changes.csv --out again --record 'w.block.base.*,w.late.**' "
        "--movie");
    ASSERT_EQ(repeated.status, 0) << repeated.err;
    for (const char* name :
         {"changes.csv", "places.csv", "trace.csv", "movie.h5", "experiment.hook"})
      EXPECT_TRUE(bytes("live", name) == bytes("again", name)) << name;
    EXPECT_GT(bytes("live", "movie.h5").size(), 1000u);
  }
  std::string bytes(const std::string& folder, const std::string& name) const {
    return testing::read_file(place.folder() / folder / name);
  }

  testing::Workplace place;
  std::unique_ptr<application::LiveLoader> loader;
  std::unique_ptr<LiveRun> run;
};

TEST_F(LiveRunTest, WhatIsSetRepeatsByteForByte) {
  start();
  set("controls.north.value", -1.);
  to(50);
  set("controls.east.value", 2.25);
  set("controls.north.value", 1. / 3.);
  to(51);
  set("controls.kick.value", 1.);
  to(300);
  EXPECT_EQ(
      run->set(std::vector<PortValue>{{"controls.east.value", -1.}, {"controls.north.value", 0.}}),
      "");
  to(420);
  set("controls.stop.value", 1.);
  EXPECT_EQ(run->ended(), "Simulator.quit is true");
  expect_repeats();
  EXPECT_EQ(bytes("live", "changes.csv"),
            "step,time [s],trail,value\n"
            "0,0,controls.north.value,-1\n"
            "50,0.05,controls.east.value,2.25\n"
            "50,0.05,controls.north.value,0.3333333333333333\n"
            "51,0.051000000000000004,controls.kick.value,1\n"
            "60,0.06,controls.kick.value,0\n"
            "300,0.3,controls.east.value,-1\n"
            "300,0.3,controls.north.value,0\n"
            "420,0.42,controls.stop.value,1\n");
}

/// The slider's wire copies: the force acts over the very step that follows, held as it is set.
TEST_F(LiveRunTest, AForceThatIsSetActsOverTheNextStep) {
  start(
      "World w { gravity = 0; deltat = 1 ms; Robot block { Base.mobile { mass = 2; Shape.Sphere "
      "radius "
      "= 1; } } Force late { body = block.base; } Force wind { body = block.base; } }\n"
      "Window c { Valuator.Slider east { Wire TO w.wind.force.x; } }\n");
  to(10);
  set("c.east.value", 3.);
  to(11);
  EXPECT_NEAR((*this)["w.block.velocity.x"], 3. / 2. * 1e-3, 1e-15);
  set("c.east.value", 0.);
  to(20);
  EXPECT_NEAR((*this)["w.block.velocity.x"], 3. / 2. * 1e-3, 1e-15);
}

TEST_F(LiveRunTest, PausesAndGoesOnByTheFilesOwnButton) {
  start();
  to(20);
  set("controls.go.value", 0.);
  EXPECT_FALSE(run->world().running());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(run->step().ok());
  EXPECT_EQ(run->world().state().step, 20);
  set("controls.go.value", 1.);
  EXPECT_TRUE(run->world().running());
  to(25);
  set("controls.stop.value", 1.);
  expect_repeats();
}

TEST_F(LiveRunTest, RefusesWhatNobodyMaySet) {
  start();
  const auto refusal = [&](const std::string& trail, double value) {
    return run->set(std::vector<PortValue>{{"controls.east.value", 1.}, {trail, value}});
  };
  EXPECT_EQ(refusal("w.wind.force.x", 1.),
            "`w.wind.force.x` is set by the wire from `controls.east.value`: set that instead");
  EXPECT_EQ(refusal("w.time", 1.), "`w.time` follows from the run: nobody sets it");
  EXPECT_EQ(refusal("controls.nort.value", 1.),
            "there is no port `controls.nort.value`; did you mean `controls.north.value`?");
  EXPECT_EQ(refusal("controls.north.value", std::nan("")),
            "`controls.north.value` takes a finite number");
  EXPECT_EQ(refusal("Simulator.pull.body", 1.),
            "`Simulator.pull.body` takes numbers from -1 to 0, not 1");
  EXPECT_EQ((*this)["w.wind.force.x"], 0.);  // all or none
  EXPECT_TRUE(run->changes().empty());
  EXPECT_EQ(bytes("live", "changes.csv"), "");
}

// On four springs the block is m g / (4 k) deep, whatever k is at the time.
TEST_F(LiveRunTest, AnEditOfTheGroundIsWhatTheBlockStandsOn) {
  start();
  to(300);
  EXPECT_NEAR((*this)["w.block.base.location.z"], 0.05 - weight / (4. * stiffness), 1e-9);
  EXPECT_EQ(run->edit("w.clay.normal_stiffness", "5 kN/m"), "");
  EXPECT_EQ(run->world().state().step, 300);
  EXPECT_NEAR((*this)["w.block.base.location.z"], 0.05 - weight / (4. * stiffness), 1e-9);
  to(600);
  EXPECT_NEAR((*this)["w.block.base.location.z"], 0.05 - weight / (4. * 5e3), 1e-8);
  EXPECT_EQ(run->overrides(), std::vector<std::string>{"w.clay.normal_stiffness=5 kN/m"});
  expect_repeats();
}

TEST_F(LiveRunTest, WhatIsSetOutlivesAnEditAndAnEditedInputIsTheEditsOwn) {
  start();
  to(10);
  set("controls.east.value", 2.);
  EXPECT_EQ(run->edit("w.late.force", "0, 0, 1 N"), "");
  EXPECT_EQ((*this)["controls.east.value"], 2.);
  EXPECT_EQ((*this)["w.wind.force.x"], 2.);
  EXPECT_EQ((*this)["w.late.force.z"], 1.);
  EXPECT_EQ(run->edit("w.gravity", "4.905"), "");
  EXPECT_EQ((*this)["w.late.force.z"], 1.);
  to(600);
  expect_repeats();
}

TEST_F(LiveRunTest, SaysWhatAnEditCannotDo) {
  start();
  to(5);
  EXPECT_NE(run->edit("w.clay.hardness", "3").find("hardness"), std::string::npos);
  EXPECT_NE(run->edit("w.deltat", "2 ms").find("the step would be 0.002 s instead of 0.001 s"),
            std::string::npos);
  const std::string other = run->edit("w.contact", "nominal");
  EXPECT_NE(other.find("cannot become"), std::string::npos) << other;
  EXPECT_TRUE(run->changes().empty());
  to(10);
}

TEST_F(LiveRunTest, GoesBackAndOnAndLeavesNothingOfTheFutureThatWas) {
  start();
  Moment first, pressed;
  run->save(first);
  to(100);
  set("controls.north.value", 1.);
  to(150);
  set("controls.kick.value", 1.);
  run->save(pressed);
  to(200);
  EXPECT_EQ(run->edit("w.clay.normal_stiffness", "5 kN/m"), "");
  to(400);
  const double then = (*this)["w.block.base.location.z"];
  // Shown, the past is as it was, and so is the present afterwards.
  EXPECT_EQ(run->seek(pressed, 399), "");
  EXPECT_EQ(run->newest(), 400);
  EXPECT_TRUE(run->step().ok());
  EXPECT_EQ((*this)["w.block.base.location.z"], then);
  EXPECT_EQ(run->take(), 0u);
  EXPECT_EQ(run->seek(first, 120), "");
  EXPECT_EQ(run->world().state().step, 120);
  EXPECT_EQ((*this)["controls.north.value"], 1.);
  EXPECT_TRUE(run->overrides().empty());
  // Going on from there gives up what followed.
  EXPECT_TRUE(run->step().ok());
  EXPECT_EQ(run->take(), 1u);
  EXPECT_EQ(run->newest(), 121);
  EXPECT_EQ(run->changes().size(), 1u);
  set("controls.east.value", -3.);
  to(500);
  set("controls.stop.value", 1.);
  expect_repeats();
  EXPECT_EQ(testing::count(bytes("live", "changes.csv"), "\n"), 4u);
}

TEST_F(LiveRunTest, GoingOnWithoutAChangeIsTheSameRun) {
  start();
  Moment moment;
  to(100);
  run->save(moment);
  to(200);
  EXPECT_EQ(run->seek(moment, 150), "");
  to(300);
  EXPECT_EQ(run->take(), 0u);
  set("controls.stop.value", 1.);
  EXPECT_EQ(run->seek(moment, 160), "");  // closed while the past is shown
  expect_repeats();
}

TEST_F(LiveRunTest, AResetIsANewTake) {
  start();
  to(100);
  set("controls.east.value", 3.);
  EXPECT_EQ(run->edit("w.gravity", "5"), "");
  EXPECT_EQ(run->reset(), "");
  EXPECT_EQ(run->world().state().step, 0);
  EXPECT_TRUE(run->changes().empty() && run->overrides().empty());
  EXPECT_EQ((*this)["controls.east.value"], 0.);
  to(40);
  set("controls.north.value", 3.);
  to(600);
  expect_repeats();
}

/// A drop from 0.2 m above the ground: free fall in steps of h, z - g h^2 n (n + 1) / 2.
TEST_F(LiveRunTest, StartsFromAPoseThatIsSetByHandAndRepeats) {
  start();
  set("controls.north.value", 0.5);
  to(100);
  EXPECT_EQ(run->edit("w.clay.normal_stiffness", "10 kN/m"), "");
  to(120);
  const double x = (*this)["w.block.base.location.x"];
  const std::uint64_t take = run->take();
  EXPECT_EQ(
      run->start_from(std::vector<simulation::StartValue>{{"w.block.base.location", {x, 0., 0.3}}}),
      "");
  EXPECT_GT(run->take(), take);
  EXPECT_EQ(run->state().time, 0.);
  EXPECT_EQ((*this)["w.block.base.location.z"], 0.3);
  EXPECT_EQ((*this)["w.block.base.velocity.y"], 0.);
  EXPECT_EQ((*this)["controls.north.value"], 0.5);
  EXPECT_EQ(run->overrides(), std::vector<std::string>{"w.clay.normal_stiffness=10 kN/m"});
  EXPECT_EQ(run->experiment().robots[0].location.z, 0.3);
  to(100);
  EXPECT_NEAR((*this)["w.block.base.location.z"], 0.3 - 9.81e-6 * 100. * 101. / 2., 1e-12);
  // A second time, from where it is now; and from a past moment of that, with other changes.
  EXPECT_EQ(run->start_from(std::vector<simulation::StartValue>{
                {"w.block.base.orientation", {0.1, 0., 0.}}, {"w.block.base.location.x", {0.5}}}),
            "");
  EXPECT_EQ((*this)["w.block.base.location.x"], 0.5);
  EXPECT_NEAR((*this)["w.block.base.location.z"], 0.3 - 9.81e-6 * 100. * 101. / 2., 1e-12);
  EXPECT_NEAR((*this)["w.block.base.orientation.x"], std::sin(0.05), 1e-15);
  Moment first;
  run->save(first);
  to(60);
  set("controls.east.value", 3.);
  to(90);
  EXPECT_EQ(run->seek(first, 40), "");
  set("controls.east.value", -2.);
  to(600);
  expect_repeats();
  EXPECT_TRUE(
      bytes("live", "changes.csv").starts_with("step,time [s],trail,value\n0,0,start:w.block."))
      << bytes("live", "changes.csv");
}

TEST_F(LiveRunTest, RefusesAPoseThatCannotBeAndStaysAsItWas) {
  start(
      "World w { deltat = 1 ms; Robot block { Base.fixed {} Chain c { Link l { joint = revolute; "
      "angle = 0.2; lower_limit = -1; upper_limit = 1; Shape.Box { dimensions = 1, .1, .1; mass = "
      "1; } } } } Force late { body = block.c.l; } }");
  to(10);
  const double angle = (*this)["w.block.c.l.angle"];
  const auto problem = [&](const std::string& trail, std::vector<double> values) {
    return run->start_from(std::vector<simulation::StartValue>{{trail, std::move(values)}});
  };
  EXPECT_NE(problem("w.block.c.l.angle", {2.}).find("limit"), std::string::npos);
  EXPECT_NE(problem("w.block.c.l.angle", {0., 1.}).find("takes 1 number"), std::string::npos);
  EXPECT_NE(problem("w.block.c.l.torque", {0.}).find("not part of an initial state"),
            std::string::npos);
  EXPECT_NE(problem("w.block.c.k.angle", {0.}).find("w.block.c.l.angle"), std::string::npos);
  EXPECT_EQ(run->state().step, 10);
  EXPECT_EQ((*this)["w.block.c.l.angle"], angle);
  EXPECT_TRUE(run->starts().empty());
  EXPECT_EQ(problem("w.block.c.l.angle", {-0.5}), "");
  EXPECT_EQ((*this)["w.block.c.l.angle"], -0.5);
  EXPECT_EQ(run->reset(), "");
  EXPECT_EQ((*this)["w.block.c.l.angle"], 0.2);
}

TEST_F(LiveRunTest, APeerIsSetAndPulledButNeitherEditedNorTakenBack) {
  std::string text = block;
  text.insert(text.find("gravity"), "engine = ode; ");
  text.erase(text.find("  Record"), text.find("\n", text.find("  Record")) - text.find("  Record"));
  place.file("scene.hook", text);
  loader = std::make_unique<application::LiveLoader>(
      place.folder() / "scene.hook", application::Settings(), application::Consent());
  run = std::make_unique<LiveRun>(
      [this](const std::vector<std::string>& overrides, std::string& problem) {
        return loader->load(overrides, problem);
      },
      simulation::LiveRunRequest{place.folder() / "live", {"w.block.base.*"}, true});
  to(10);
  set("controls.east.value", 4.);
  to(50);
  const std::string why =
      "engine `ode` cannot be saved and resumed exactly: its library hides what its solver remembers; "
      "with `engine = dts` it can be saved";
  EXPECT_EQ(run->no_history(), why);
  EXPECT_EQ(run->edit("w.clay.normal_stiffness", "5 kN/m"), why);
  Moment moment;
  EXPECT_THROW(run->save(moment), simulation::ExperimentError);
  EXPECT_EQ(run->reset(), "");
  to(20);
  set("controls.east.value", 1.);
  set("controls.stop.value", 1.);
  run->close();
  const auto repeated = place.hookpoint(
      "run scene.hook --changes live/changes.csv --out again --record 'w.block.base.*'");
  EXPECT_EQ(repeated.status, 0) << repeated.err;
  EXPECT_TRUE(bytes("live", "trace.csv") == bytes("again", "trace.csv"));
}

TEST_F(LiveRunTest, AStepAllocatesNothing) {
  start();
  set("controls.east.value", 1.);
  set("Simulator.pull.body", 0.);
  to(20);
  const long before = testing::allocation_count();
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(run->step().ok());
  EXPECT_EQ(testing::allocation_count() - before, 0);
}

TEST_F(LiveRunTest, AMovieOfItIsReplayedAcrossItsChanges) {
  start();
  to(50);
  set("controls.east.value", 4.);
  to(120);
  set("controls.east.value", 0.);
  to(130);
  const std::string x = text::shortest((*this)["w.block.base.location.x"]);
  run->close();
  run.reset();
  const auto replayed =
      place.hookpoint("replay live/movie.h5 --at '0.13 s' --record w.block.base.location.x --json");
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_NE(replayed.out.find(x.substr(0, 12)), std::string::npos) << x << replayed.out;
}

class ChangesFile : public LiveRunTest {
 protected:
  testing::CommandResult repeat(const std::string& rows) {
    place.file("scene.hook", block);
    place.file("c.csv", rows);
    return place.hookpoint("run scene.hook --changes c.csv");
  }
};

TEST_F(ChangesFile, SaysOnWhichLineSomethingIsWrong) {
  const std::string header = "step,time [s],trail,value\n";
  const std::pair<std::string, std::string> wrong[] = {
      {"", "c.csv, line 1: the header `step,time [s],trail,value` is missing"},
      {"step,time,trail,value\n", "c.csv, line 1: the header is not `step,time [s],trail,value`"},
      {header + "3,0.003,controls.east\n", "c.csv, line 2: has 3 fields instead of 4"},
      {header + "x,0.003,controls.east.value,1\n", "c.csv, line 2: `x` is no step"},
      {header + "3,0.003,controls.east.value,1\n2,0.002,controls.east.value,1\n",
       "c.csv, line 3: step 2 stands after step 3"},
      {header + "3,soon,controls.east.value,1\n", "c.csv, line 2: `soon` is no time"},
      {header + "3,0.003,\"controls.east,1\n", "c.csv, line 2: a quote is left open"},
      {header + "3,0.003,controls.east.value,\n", "c.csv, line 2: the value is missing"},
      {header + "3,0.3,controls.east.value,1\n",
       "c.csv, line 2: step 3 is at 0.003 s here, not at 0.3 s: the file is of a run with another "
       "deltat"},
      {header + "3,0.003,controls.east.value,1\n9,0.009,w.clay.hardness,1\n", "c.csv, line 3: "}};
  for (const auto& [rows, message] : wrong) {
    const testing::CommandResult result = repeat(rows);
    EXPECT_EQ(result.status, 2) << rows;
    EXPECT_NE(result.err.find(message), std::string::npos) << rows << result.err;
  }
  EXPECT_EQ(place.hookpoint("run scene.hook --changes none.csv").status, 2);
}

TEST_F(ChangesFile, StartsFromWhatStandsBeforeAllOtherChanges) {
  const std::string header = "step,time [s],trail,value\n";
  EXPECT_NE(
      repeat(header + "0,0,controls.east.value,1\n0,0,start:w.block.base.velocity,\"1,0,0\"\n")
          .err.find("line 3: what a run starts from stands before other changes"),
      std::string::npos);
  EXPECT_NE(repeat(header + "0,0,start:w.block.base.velocity,fast\n").err.find("takes numbers"),
            std::string::npos);
  EXPECT_NE(repeat(header + "0,0,start:w.block.base.mass,1\n").err.find("initial state"),
            std::string::npos);
  const auto started =
      repeat(header + "0,0,start:w.block.base.velocity,\"1,0,0\"\n0,0,controls.east.value,1\n");
  EXPECT_EQ(started.status, 0) << started.err;
}

TEST_F(ChangesFile, TellsOfAChangeAfterTheEnd) {
  place.file("scene.hook", block);
  place.file(
      "c.csv",
      "step,time [s],trail,value\n5,0.005,controls.east.value,1\n300,0.3,controls.east.value,2\n");
  const auto result = place.hookpoint("run scene.hook --changes c.csv --for 0.1");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("the last 1 of the changes in c.csv were not made"), std::string::npos)
      << result.err;
}

TEST_F(LiveRunTest, HistoryIsOfTheLastMoments) {
  start();
  view::History history(2, 10);
  for (std::int64_t step = 0; step <= 50; ++step) {
    to(step);
    if (history.due(step)) history.keep(*run, {});
  }
  EXPECT_EQ(history.first(), 32);
  EXPECT_EQ(history.before(20), nullptr);
  ASSERT_NE(history.before(41), nullptr);
  EXPECT_EQ(history.before(41)->step(), 40);
  // As many as fit into the room, where that is less.
  const std::size_t one =
      sizeof(view::History::Kept) + 8 * history.before(41)->moment.numbers.size();
  view::History small(2, 10, 3 * one);
  for (std::int64_t step = 52; step <= 70; ++step) {
    to(step);
    if (small.due(step)) small.keep(*run, {});
  }
  EXPECT_EQ(small.first(), 66);
}

}  // namespace
}  // namespace hookpoint
