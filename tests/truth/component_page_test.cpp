// The controller of docs/adding_a_component.md, compiled as it stands there: built in, where its
// linear form is that of its updates and sets the step that it bears, and as a plugin.
// ctest: alone
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulation/analysis/stability.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/linear_form.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using testing::ComponentBench;

TEST(LeadCompensatorOfThePage, LeadsASineByItsFormula) {
  const double period = 1e-4, gain = 3., lead = 0.2, ratio = 0.1, w = 7.;
  ComponentBench bench("Controller.Lead", period);
  bench["gain"] = gain;
  bench["lead"] = lead;
  bench["ratio"] = ratio;
  bench.start();
  double most = 0.;
  for (int k = 0; k < 60000; ++k) {
    bench["angle"] = std::sin(w * k * period);
    bench.tick();
    if (k > 40000) most = std::max(most, std::abs(bench["torque"]));
  }
  const double expected = gain * std::hypot(1., w * lead) / std::hypot(1., w * ratio * lead);
  EXPECT_NEAR(most / expected, 1., 1e-3);
}

TEST(LeadCompensatorOfThePage, SaysOfItselfWhatItDoes) {
  const double period = 2e-3;
  ComponentBench bench("Controller.Lead", period);
  bench["gain"] = 40.;
  bench.start();
  EXPECT_LT(testing::linear_form_error(bench, period), 1e-12);
}

std::string held_arm(const std::string& integrator, double dt, const std::string& more) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {1}; integrator = {0}; Robot bot {{ Base.fixed {{ }} "
      "Chain c {{ Link l {{ angle = 1e-3; mass = 1; center_of_mass = 0.3,0,0; inertia = "
      "0.01,0.01,0.01,0,0,0; }} }} }} }}\nController.Lead hold {{ joint = w.bot.c.l; gain = 300; "
      "lead = 0.05; {2} }}",
      integrator, dt, more);
}

simulation::StabilityBound bound(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return simulation::stability_bound(*loaded.experiment);
}

/// How much faster the joint moves in the last tenth of 2000 steps than in the fifth.
double unrest(Running run) {
  const std::vector<double> rates = run.record("bot.c.l.rate", 2000);
  double early = 0., late = 0.;
  for (std::size_t k = 0; k < 200; ++k) {
    early = std::max(early, std::abs(rates[800 + k]));
    late = std::max(late, std::abs(rates[1800 + k]));
  }
  return late / early;
}

TEST(LeadCompensatorOfThePage, BearsTheStepThatItsLinearFormGives) {
  for (const std::string integrator : {"explicit_euler", "semi_implicit_euler", "rk4"}) {
    const simulation::StabilityBound found = bound(held_arm(integrator, 1e-3, ""));
    EXPECT_EQ(found.left_out.size(), 0u);
    EXPECT_EQ(found.controllers, std::vector<std::string>{"hold"});
    ASSERT_GT(found.step, 1e-4) << integrator;
    ASSERT_LT(found.step, 0.1) << integrator;
    const auto moves = [&](double part) {
      const double dt = std::round(part * found.step * 1e9) * 1e-9;
      return unrest(Running(held_arm(integrator, dt, "")));
    };
    EXPECT_LT(moves(0.99), 1.) << integrator;
    EXPECT_GT(moves(1.01), 1.) << integrator;
  }
}

// The program, which does not know the class, takes its linear form from the plugin.
TEST(LeadCompensatorOfThePage, AsAPluginIsBoundAlike) {
  const testing::Workplace place;
  std::filesystem::copy_file(testing::build_folder() + "/tests/libplugin_of_page.so",
                             place.folder() / "libmine.so");
  const std::string text = held_arm("rk4", 1e-3, "");
  place.file("arm.hook", "Plugin \"libmine.so\";\n" + text);
  const testing::CommandResult result = place.hookpoint("dynamics arm.hook --json --allow-plugins");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string key = "\"largest_stable_step\": ";
  const std::size_t at = result.out.find(key);
  ASSERT_NE(at, std::string::npos) << result.out;
  EXPECT_EQ(std::stod(result.out.substr(at + key.size())), bound(text).step);
}

}  // namespace
}  // namespace hookpoint
