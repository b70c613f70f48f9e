// A formula names as many ports as it needs: a sum of n of them, each with a weight of its own, is
// the torque of a joint, whose acceleration says whether each has reached its place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "reference/engines.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

/// sum over i of (i + 1) port_i, port_i = 1/(i + 1)^2: the harmonic number of n.
std::string weighted_sum(int n) {
  std::string sum;
  for (int i = 0; i < n; ++i) sum += fmt::format("{}{} * e{}", i == 0 ? "" : " + ", i + 1, i);
  return sum;
}
double harmonic(int n) {
  double sum = 0.;
  for (int i = 0; i < n; ++i) sum += 1. / (i + 1);
  return sum;
}

std::string world(int n, const std::string& component) {
  std::string text =
      "World w { gravity = 0; deltat = 1 ms; Robot r { Base.fixed; Chain c { Link l { mass = 1; "
      "inertia = .5,.5,.5,0,0,0; } } } ";
  for (int i = 0; i < n; ++i)
    text += fmt::format("Expression e{} {{ formula = \"1 / {}.\"; }} ", i, (i + 1) * (i + 1));
  return text + component + " Wire FROM f.output TO r.c.l.torque; }";
}

void expect_sum(int n, const std::string& text, simulation::EngineFactory make) {
  Running run(text, make);
  run.step(10);
  EXPECT_NEAR(run["f.output"], harmonic(n), 1e-12 * harmonic(n));
  EXPECT_NEAR(run["r.c.l.acceleration"], harmonic(n) / 0.5, 1e-4 * harmonic(n));
}

template <class Check>
void in_ours_and_a_peer(const Check& check) {
  check(simulation::make_dts);
  check(reference::peers()[0].make);
}

TEST(FormulaPorts, AreAsManyAsAnExpressionNames) {
  in_ours_and_a_peer([](simulation::EngineFactory make) {
    for (const int n : {1, 2, 3, 16, 17, 100, 300}) {
      SCOPED_TRACE(n);
      expect_sum(n, world(n, "Expression f { formula = \"" + weighted_sum(n) + "\"; }"), make);
    }
  });
}

TEST(FormulaPorts, AreAsManyAsAStateMachineNames) {
  in_ours_and_a_peer([](simulation::EngineFactory make) {
    for (const int n : {1, 17, 100}) {
      SCOPED_TRACE(n);
      expect_sum(n,
                 world(n, fmt::format("StateMachine f {{ State a {{ output = \"0\"; }} State b {{ "
                                      "output = \"{}\"; }} Transition t {{ from = a; to = b; when "
                                      "= \"e{} > 0\"; }} }}",
                                      weighted_sum(n), n - 1)),
                 make);
    }
  });
}

// A wire of its own in between keeps its place too.
TEST(FormulaPorts, MayHaveWiresOfTheirOwn) {
  std::string inputs;
  for (int i = 0; i < 40; ++i) inputs += fmt::format("Input e{0} {{ Wire FROM w.e{0}; }} ", i);
  in_ours_and_a_peer([&](simulation::EngineFactory make) {
    expect_sum(40,
               world(40, "Expression f { formula = \"" + weighted_sum(40) + "\"; " + inputs + "}"),
               make);
  });
}

}  // namespace
}  // namespace hookpoint
