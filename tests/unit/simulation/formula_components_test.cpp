// Expression and StateMachine: what they compute against closed forms and conservation, what they
// refuse, and where they say so.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// A mass in free flight, and what else the text says.
std::string flight(const std::string& more) {
  return "World lab { gravity = 9.81; deltat = 1 ms; integrator = rk4; Robot ball { Base.mobile { "
         "location = 0, 0, 5; velocity = 1, 0, 3; mass = 2 kg; "
         "inertia = 0.01, 0.01, 0.01, 0, 0, 0; } } }\n" +
         more;
}

TEST(Expression, ComputesWhatIsConserved) {
  // E/m = g z + v^2/2 of a body in flight.
  Running run(
      flight("Expression e { formula = \"9.81 m/s^2 * lab.ball.position.z + "
             "(lab.ball.velocity.x^2 + lab.ball.velocity.z^2) / 2\"; }"));
  const std::vector<double> energy = run.record("e.output", 800);
  for (std::size_t k = 1; k < energy.size(); ++k) EXPECT_NEAR(energy[k], 9.81 * 5. + 5., 1e-9) << k;
}

TEST(Expression, RemembersItsLastValue) {
  // y_k = a y_(k-1) + (1 - a) u from y_-1 = y0: u + (y0 - u) a^(k+1).
  Running run(
      flight("Signal.Step u { initial = 3; final = 3; }\n"
             "Expression y { formula = \"0.9 * previous + 0.1 * u\"; initial = 7; }"));
  const std::vector<double> y = run.record("y.output", 100);
  for (std::size_t k = 0; k < y.size(); ++k)
    EXPECT_NEAR(y[k], 3. + 4. * std::pow(0.9, static_cast<double>(k + 1)), 1e-13) << k;
}

TEST(Expression, ReadsNamedInputsThroughTheirWires) {
  // A time that arrives 20 ms late, and one sampled every 10 ms.
  Running run(
      flight("Signal.Ramp clock { final = 1; duration = 1 s; }\n"
             "Expression d { formula = \"clock - late > 0.015 ? sampled : -1\"; "
             "Input late { Wire FROM clock.output { delay = 20 ms; } } "
             "Input sampled { Wire FROM clock.output { rate = 100 Hz; } } }"));
  const std::vector<double> d = run.record("d.output", 60);
  EXPECT_DOUBLE_EQ(d[10], -1.);
  for (std::size_t k = 20; k < d.size(); ++k)
    EXPECT_NEAR(d[k], static_cast<double>(k / 10) * 0.01, 1e-12) << k;
}

TEST(Expression, RunsAtItsRate) {
  // Integral of the period, at 300 Hz on steps of 1 ms: the time of the last update.
  Running run(
      flight("Expression t { rate = 300 Hz; formula = \"previous + period\"; unit = \"s\"; "
             "initial = 0 s; }"));
  run.step(1000);
  EXPECT_NEAR(run["t.output"], 301. / 300., 1e-12);  // updates 0 to 300, each a period of 1/300 s
}

TEST(Formula, RefusesWhatIsWrongAtItsPlace) {
  struct Case {
    const char *formula, *wrong, *message;  // `wrong`: what the place points at
  };
  for (const Case& one :
       {Case{"1 + lab.bal.position.z", "lab.bal", "`lab.bal.position.z`"},
        Case{"2 * lab.ball.position.z + lab.ball.velocity.z", "+ lab.ball.velocity", "m and m/s"},
        Case{"sin(lab.ball.position.z)", "sin", "sin takes an angle"},
        Case{"sine(1)", "sine", "unknown function `sine`"},
        Case{"lab.ball.position", "lab", "holds 3 numbers"}, Case{"1 +", "", "expected a value"},
        Case{"lab.ball.position.z", "\"lab", "the formula is in m, `unit` says s"}}) {
    const std::string line =
        std::string("Expression e { unit = \"s\"; formula = \"") + one.formula + "\"; }";
    const Loaded loaded = load_text(flight(line));
    EXPECT_FALSE(loaded.experiment) << one.formula;
    EXPECT_NE(loaded.diagnostics.find(one.message), std::string::npos) << loaded.diagnostics;
    if (*one.wrong == '\0') continue;
    const std::string place = "error 2:" + std::to_string(line.find(one.wrong) + 1) + " ";
    EXPECT_NE(loaded.diagnostics.find(place), std::string::npos) << place << loaded.diagnostics;
  }
}

TEST(StateMachine, RefusesAGuardThatIsANumberAndOutputsOfTwoUnits) {
  const Loaded loaded = load_text(
      flight("StateMachine m { State a { output = \"1 N\"; } State b { output = \"1 m\"; } "
             "Transition go { from = a; to = b; when = \"time_in_state\"; } }"));
  EXPECT_NE(loaded.diagnostics.find("a guard is true or false"), std::string::npos);
  EXPECT_NE(loaded.diagnostics.find("this output is in m, the others in N"), std::string::npos)
      << loaded.diagnostics;
}

TEST(StateMachine, StaysAsLongAsItsGuardsSay) {
  // 30 ms in one, 70 ms in the other, and the way to `never` is shut.
  Running run(
      flight("StateMachine m { initial = b; State never { output = \"9\"; } "
             "State a { output = \"1 + time_in_state / 1 s\"; } State b { output = \"2\"; } "
             "Transition x { from = a; to = never; when = \"time < 0 s\"; } "
             "Transition y { from = a; to = b; when = \"time_in_state >= 30 ms\"; } "
             "Transition z { from = b; to = a; when = \"time_in_state >= 70 ms\"; } }"));
  const auto state = run.port("m.state"), output = run.port("m.output");
  for (int k = 0; k < 1000; ++k) {
    const int within = k % 100;
    EXPECT_EQ(*state.value, within < 70 ? 2. : 1.) << k;
    EXPECT_NEAR(*output.value, within < 70 ? 2. : 1. + (within - 70) * 1e-3, 1e-12) << k;
    run.step();
  }
}

TEST(StateMachine, OfTheManualDoesTheWorkThatItSays) {
  std::ifstream file(std::filesystem::path(testing::source_folder()) / "docs/controllers.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::string text;
  for (const testing::PageBlock& block : testing::blocks_of(page)) {
    if (block.language == "hook" && block.text.find("StateMachine") != std::string::npos)
      text = block.text;
  }
  Running run(text);
  // It falls freely until it is faster than 1 m/s: at g t > 1.
  run.step(101);
  EXPECT_EQ(run["engine.state"], 0.);
  run.step(3);
  EXPECT_EQ(run["engine.state"], 1.);
  const double before = run["energy.output"] - run["work.output"];
  run.step(1800);
  EXPECT_GT(std::abs(run["work.output"]), 10.);
  // The energy is that of the start and the work of the thrust, by sums over the speed of at most
  // 2 ms before: of each push 40 N 10.2 m/s^2 2 ms 0.25 s at most.
  EXPECT_NEAR(run["energy.output"] - run["work.output"], before, 5 * 0.204);
}

}  // namespace
}  // namespace hookpoint
