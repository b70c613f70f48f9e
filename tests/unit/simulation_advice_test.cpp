// Advice holds when the ground that it advises does what was wished for: run in the engine, or by
// the closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/predictions.h"
#include "simulation/advice.h"
#include "simulation/engine.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using simulation::Advice;
using simulation::ConstantAdvice;

std::string block(const std::string& world, const std::string& material) {
  return "World w { gravity = 9.81; duration = 1 s; " + world + " Material m { " + material +
         " } Terrain.Flat g { material = m; } Robot b { Base.mobile { rest_on = g; mass = 2; "
         "Shape.Cube dimensions = 1, 1, 0.3; } } }";
}

Advice advice_for(const std::string& text, const simulation::AdviceWishes& wishes) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return simulation::advise(*loaded.experiment, wishes);
}

double advised(const Advice& advice, const std::string& name) {
  for (const ConstantAdvice& constant : advice.grounds.at(0).constants) {
    if (constant.name == name) return constant.advised;
  }
  ADD_FAILURE() << "no advice on " << name;
  return NAN;
}

// k = m g/(4 delta); zeta from the rebound by the closed form, c = 2 zeta sqrt(k m/4).
TEST(Advice, LinearLawByItsClosedForm) {
  const Advice advice = advice_for(block("deltat = 0.1 ms;", ""), {2e-3, 0.3, 0.1});
  const double k = 2. * 9.81 / (4. * 2e-3);
  EXPECT_NEAR(advised(advice, "normal_stiffness"), k, 1e-9 * k);
  const double zeta = contact::kelvin_voigt_damping_ratio(0.3);
  const double c = 2. * zeta * std::sqrt(k * 0.5);
  EXPECT_NEAR(advised(advice, "normal_damping"), c, 1e-6 * c);
  EXPECT_EQ(advice.grounds[0].points, 4u);
  EXPECT_NEAR(advice.grounds[0].survival_advised, std::sqrt(9.81 * 2e-3), 1e-12);
}

// The engine itself, on the advised ground: the block sinks as deep as allowed.
TEST(Advice, AdvisedGroundCarriesTheBlockAtTheAllowedDepth) {
  for (const std::string law : {"hookpoint", "hunt_crossley"}) {
    const std::string world = "deltat = 0.1 ms; contact = " + law + ";";
    const std::string friction = "regularisation_speed = 50 mm/s; ";
    const Advice advice = advice_for(block(world, friction), {1.5e-3, 0.2, 0.1});
    std::string constants = friction;
    for (const ConstantAdvice& constant : advice.grounds.at(0).constants)
      constants += constant.name + " = " + std::to_string(constant.advised) + "; ";
    Running run(block(world, constants));
    run.step(10'000);
    EXPECT_NEAR(0.15 - run["b.position.z"], 1.5e-3, 2e-6) << law;
  }
}

TEST(Advice, NamesTheConstantThatMakesTheStepTooLarge) {
  const Advice damped = advice_for(
      block("deltat = 1 ms;", "normal_damping = 50 N.s/m; tangential_damping = 30 kN.s/m;"), {});
  ASSERT_FALSE(damped.changes.empty());
  EXPECT_NE(damped.changes[0].find("multiply tangential_damping"), std::string::npos)
      << damped.changes[0];
  const Advice stiff =
      advice_for(block("deltat = 1 ms;",
                       "normal_stiffness = 1e9 N/m; normal_damping = 0; tangential_damping = 0;"),
                 {});
  EXPECT_NE(stiff.changes.at(0).find("multiply normal_stiffness"), std::string::npos)
      << stiff.changes[0];
}

// The factor that is advised makes the step stable, and little more than that.
TEST(Advice, AdvisedFactorIsAsLargeAsTheStepAllows) {
  const std::string world = "deltat = 1 ms;";
  const Advice advice =
      advice_for(block(world, "tangential_damping = 30 kN.s/m; normal_damping = 50 N.s/m;"), {});
  const std::string& change = advice.changes.at(0);
  const double factor = std::stod(change.substr(change.find(" by ") + 4));
  const auto bound_with = [&](double c) {
    const Advice with = advice_for(block(world, "normal_damping = 50 N.s/m; tangential_damping = " +
                                                    std::to_string(c) + " N.s/m;"),
                                   {});
    for (const simulation::StepAdvice& step : with.steps) {
      if (step.integrator == "semi_implicit_euler") return step.present;
    }
    return 0.;
  };
  EXPECT_GT(bound_with(30e3 * factor), 1e-3);
  EXPECT_LT(bound_with(30e3 * factor * 2.), 1e-3 * 1.25);
}

TEST(Advice, GroundAsWishedNeedsNoChange) {
  const double k = 2. * 9.81 / (4. * 1e-3);
  const double c = 2. * contact::kelvin_voigt_damping_ratio(0.2) * std::sqrt(k * 0.5);
  const std::string constants = "normal_stiffness = " + std::to_string(k) +
                                "; tangential_stiffness = " + std::to_string(k) +
                                "; normal_damping = " + std::to_string(c) +
                                "; tangential_damping = " + std::to_string(c) + ";";
  const Advice advice = advice_for(block("deltat = 0.1 ms;", constants), {1e-3, 0.2, 0.1});
  EXPECT_TRUE(advice.changes.empty()) << advice.changes[0];
}

TEST(Advice, ARebound0IsNotToBeHad) {
  const Advice unsaid = advice_for(block("deltat = 0.1 ms;", ""), {});
  EXPECT_NEAR(unsaid.grounds[0].wanted_rebound, 0.1, 0.);
  EXPECT_LT(advised(unsaid, "normal_damping"), 1e4);
  const Loaded loaded = load_text(block("deltat = 0.1 ms;", ""));
  EXPECT_THROW(simulation::advise(*loaded.experiment, {1e-3, 0., 0.1}),
               simulation::ExperimentError);
}

TEST(Advice, RefusesWhatHasNoConstants) {
  const Loaded impulse = load_text(block("contact = impulse;", ""));
  ASSERT_TRUE(impulse.experiment) << impulse.diagnostics;
  EXPECT_THROW(simulation::advise(*impulse.experiment, {}), simulation::ExperimentError);
  const Loaded bare = load_text(
      "World w { Robot b { Base.mobile { mass = 1; Shape.Cube dimensions "
      "= 1, 1, 1; } } }");
  ASSERT_TRUE(bare.experiment) << bare.diagnostics;
  EXPECT_THROW(simulation::advise(*bare.experiment, {}), simulation::ExperimentError);
}

}  // namespace
}  // namespace hookpoint
