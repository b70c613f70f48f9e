// What flows along wires: when a row of the record sees it, and what adding a wire leaves alone.
#include <gtest/gtest.h>

#include <cmath>

#include "control/registry.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using namespace control;
using Values = std::vector<double>;

/// output = the number of its update; echo = its input.
class Counter final : public Component {
 public:
  Input input{*this, "input", "?", "anything"};
  Output output{*this, "output", "", "updates before this one"};
  Output echo{*this, "echo", "?", "the input"};
  Output twice{*this, "twice", "", "the count and its double", 2};
  void update(const Tick& tick) override {
    output = static_cast<double>(tick.count);
    echo = input;
    twice.set(0, output);
    twice.set(1, 2. * output);
  }
};
HOOKPOINT_REGISTER_COMPONENT(Counter, "Test.Counter", "counts", Attachment::none, "input")

class Switch final : public Component {
 public:
  Parameter at{*this, "at", "s", 0., "when it goes from 1 to 0"};
  Output on{*this, "on", "", "1 before"};
  Output off{*this, "off", "", "1 after"};
  void update(const Tick& tick) override {
    on = tick.time < at ? 1. : 0.;
    off = 1. - on;
  }
};
HOOKPOINT_REGISTER_COMPONENT(Switch, "Test.Switch", "switches", Attachment::none, "", "on")

/// A mass of 2 kg on a horizontal slide, or whatever `inside` says.
std::string slide(const std::string& rest, const std::string& world = "") {
  return "World w { gravity = 0; deltat = 10 ms; " + world +
         " Robot bot { Base.fixed { } Chain c { Link l { joint = prismatic; mass = 2; } } } }\n" +
         rest;
}

TEST(WiringRows, ARowHoldsWhatIsVisibleAtItsTime) {
  // The torque of row k is the count k; it acts in the step after that row (semi-implicit Euler).
  Running run(slide("Test.Counter n { Wire TO w.bot.c.l.torque; }"));
  double rate = 0.;
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(run["n.output"], k);
    EXPECT_EQ(run["w.bot.c.l.torque"], k);
    EXPECT_EQ(run["w.step"], k);
    EXPECT_NEAR(run["bot.c.l.rate"], rate, 1e-15);
    rate += k / 2. * 0.01;
    run.step();
  }
}

TEST(WiringRows, ValuesPassAlongAChainWithinAStepInAnyOrderOfTheFile) {
  Running run(
      slide("Test.Counter c { Wire FROM b.echo; } Test.Counter b { Wire FROM a.output; } "
            "Test.Counter a;"));
  EXPECT_EQ(run.record("c.echo", 3), (Values{0, 1, 2, 3}));
}

TEST(WiringRows, AWireReadsWhatAnotherHasJustWritten) {
  Running run(
      slide("Test.Counter r { Wire FROM w.bot.c.l.torque; } Test.Counter n { Wire TO "
            "w.bot.c.l.torque; }"));
  EXPECT_EQ(run.record("r.echo", 3), (Values{0, 1, 2, 3}));
}

TEST(WiringRows, RateAndDelayOfTheWire) {
  Running run(
      slide("Test.Counter n; Test.Counter m { input = 7; Wire FROM n.output { rate = 50 Hz; "
            "delay = 30 ms; } }"));
  EXPECT_EQ(run.record("m.echo", 8), (Values{7, 7, 7, 0, 0, 2, 2, 4, 4}));
}

TEST(WiringRows, DelayBreaksALoop) {
  Running run(
      slide("Test.Counter a { input = 3; Wire FROM b.echo { delay = 20 ms; } } Test.Counter "
            "b { Wire FROM a.echo; }"));
  EXPECT_EQ(run.record("b.echo", 4), (Values{3, 3, 3, 3, 3}));
}

TEST(WiringStub, ItsRateIsTheScheduleAndItsDelayHoldsForEachWire) {
  Running run(
      slide("Test.Counter n; Test.Counter m { rate = 50 Hz; delay = 10 ms; Wire FROM n.output; "
            "Wire FROM echo TO r.input; } Test.Counter r;"));
  EXPECT_EQ(run.record("m.echo", 6), (Values{0, 0, 0, 0, 2, 2, 4}));
  Running again(
      slide("Test.Counter n; Test.Counter m { rate = 50 Hz; delay = 10 ms; Wire FROM n.output; "
            "Wire FROM echo TO r.input; } Test.Counter r;"));
  EXPECT_EQ(again.record("r.echo", 6), (Values{0, 0, 0, 0, 0, 2, 2}));
}

TEST(WiringStub, TheWiresOwnWins) {
  Running run(
      slide("Test.Counter n; Test.Counter m { delay = 50 ms; Wire FROM n.output { delay = 10 "
            "ms; } }"));
  EXPECT_EQ(run.record("m.echo", 3), (Values{0, 0, 1, 2}));
}

TEST(WiringStub, NoiseWithAUnitHoldsForTheWiresThatCarryIt) {
  Running run(
      slide("Controller.PD p { noise = 2 mm; pconstant = 1; Wire FROM w.bot.c.l.angle TO "
            "current; Wire TO w.bot.c.l.torque; }"));
  EXPECT_NE(run["p.current"], 0.);
  EXPECT_EQ(run["w.bot.c.l.torque"], run["p.output"]);
}

TEST(WiringPorts, ListsGoWholeAndByElement) {
  Running run(slide("Test.Counter n { input = 4; } Test.Counter m { Wire FROM n.twice[1]; }"));
  run.step(3);
  EXPECT_EQ(run["m.echo"], 6.);
  EXPECT_EQ(run["n.twice.y"], 6.);
  EXPECT_EQ(run["n.twice[1]"], 6.);
}

TEST(WiringPorts, EveryNumberOfTheFileCanBeRead) {
  Running run(slide("Test.Counter n { Wire FROM w.clay.normal_stiffness; }",
                    "Material clay normal_stiffness = 30 kN/m;"));
  EXPECT_EQ(run["clay.normal_stiffness"], 30000.);
  EXPECT_EQ(run["n.echo"], 30000.);
  EXPECT_EQ(run["bot.c.l.mass"], 2.);
  EXPECT_EQ(run["w.deltat"], 0.01);
  EXPECT_EQ(run.port("bot.c.l.torque").unit, "N");
  EXPECT_EQ(run.port("bot.c.l.mass").writable, nullptr);
}

TEST(WiringPorts, AMisspeltOneIsAnsweredWithTheNearest) {
  Running run(slide("Test.Counter counter;"));
  try {
    run.port("counter.outptu");
    FAIL();
  } catch (const simulation::ExperimentError& error) {
    EXPECT_STREQ(error.what(), "there is no port `counter.outptu`; did you mean `counter.output`?");
  }
}

TEST(WiringNoise, AnotherWireChangesNoneOfIt) {
  const std::string noisy =
      "Test.Counter a { Wire FROM w.bot.c.l.angle { noise = 0.001; rate = 50 Hz; } }";
  const std::string other =
      "Test.Counter b { Wire FROM w.bot.c.l.rate { noise = 3; } } Test.Counter c { Wire FROM "
      "w.bot.c.l.angle { noise = 0.002; } }";
  const Values alone = Running(slide(noisy)).record("a.echo", 50);
  EXPECT_EQ(Running(slide(other + noisy)).record("a.echo", 50), alone);
  EXPECT_EQ(Running(slide(noisy + other)).record("a.echo", 50), alone);
  EXPECT_NE(Running(slide(noisy, "seed = 2;")).record("a.echo", 50), alone);
  EXPECT_NE(alone[0], alone[2]);
  EXPECT_EQ(alone[0], alone[1]);
}

TEST(WiringPush, ActsFromTheFirstStepOfItsWindowToItsEnd) {
  // 4 N for 30 ms on 2 kg from 20 ms on: 2 m/s^2 in steps 2, 3, 4.
  Running run(
      "World w { gravity = 0; deltat = 10 ms; Robot b { Base.mobile { mass = 2; Shape.Sphere "
      "radius = "
      "1; } } Push p { body = b.base; force = 4,0,0; from = 20 ms; duration = 30 ms; } }");
  const Values speed = run.record("b.velocity.x", 7);
  const Values expected{0., 0., 0., 0.02, 0.04, 0.06, 0.06, 0.06};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(speed[k], expected[k], 1e-15) << k;
}

TEST(WiringPush, SmoothEdgesGiveTheSameImpulseAsAWindowThatIsAnEdgeShorter) {
  Running run(
      "World w { gravity = 0; deltat = 1 ms; Robot b { Base.mobile { mass = 2; Shape.Sphere radius "
      "= "
      "1; } } Push p { body = b.base; force = 4,0,0; from = 20 ms; to = 120 ms; edge = 40 ms; } }");
  run.step(70);
  EXPECT_EQ(run["p.envelope"], 1.);
  run.step(100);
  EXPECT_NEAR(run["b.velocity.x"], 2. * (0.1 - 0.04), 1e-12);
}

TEST(WiringForce, ActsInTheStepInWhichItIsWired) {
  Running run(
      "World w { gravity = 0; deltat = 10 ms; Robot b { Base.mobile { mass = 2; Shape.Sphere "
      "radius = "
      "1; } } Force f { body = b.base; } }\nTest.Counter n { Wire TO w.f.force.x; }");
  const Values speed = run.record("b.velocity.x", 4);
  const Values expected{0., 0., 0.005, 0.015, 0.03};
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(speed[k], expected[k], 1e-15) << k;
}

TEST(WiringRun, QuitEndsIt) {
  Running run(slide("Test.Switch s { at = 30 ms; Wire FROM off TO Simulator.quit; }"));
  run.step(2);
  EXPECT_EQ(run.world().ended(), "");
  run.step();
  EXPECT_EQ(run.world().ended(), "Simulator.quit is true");
}

TEST(WiringRun, TimeStandsStillWhileItIsPaused) {
  Running run(slide("Test.Switch s { at = 20 ms; Wire TO w.running; }"));
  run.step(5);
  EXPECT_EQ(run["w.time"], 0.02);
  EXPECT_EQ(run.world().ended(),
            "World.running is false, and nothing can set it true again while time stands still");
}

TEST(WiringRun, ASliderWithoutAValueStandsWhereItsInputDoes) {
  Running run(
      slide("Controller.PD p { goal = 0.7; } Window { Valuator.Slider a Wire TO p.goal; "
            "Valuator.Slider b { value = 3; Wire TO p.pconstant; } Button.Light pause Wire TO "
            "w.running; }"));
  EXPECT_EQ(run["p.goal"], 0.7);
  EXPECT_EQ(run["a.value"], 0.7);
  EXPECT_EQ(run["p.pconstant"], 3.);
  EXPECT_EQ(run.world().ended(), "");
}

TEST(WiringPrint, ThePrintedFileGivesTheSameRunBitForBit) {
  const std::string text = slide(
      "Let k = 40;\nFor i in 0..1 { Controller.PD p[i] { rate = 70 Hz; goal = 0.1 * i; pconstant "
      "= k; dconstant = 3; Wire FROM w.bot.c.l.angle { noise = 0.001; delay = 15 ms; } } }\nGain g "
      "{ "
      "Wire FROM p[1]; Wire TO w.bot.c.l.torque; }");
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("hookpoint_print_" + std::to_string(getpid()) + ".hook");
  std::ofstream(file) << text;
  language::Library library(experiment_schema(), {});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(file, {}, diagnostics);
  ASSERT_TRUE(root);
  std::filesystem::remove(file);
  EXPECT_EQ(Running(language::print(*root)).record("bot.c.l.angle", 300),
            Running(text).record("bot.c.l.angle", 300));
}

}  // namespace
}  // namespace hookpoint
