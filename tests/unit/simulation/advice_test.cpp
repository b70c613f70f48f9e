// Advice holds when the ground that it advises does what was wished for: run in the engine, or by
// the closed form.
#include "simulation/analysis/advice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "contact/force_law.h"
#include "contact/predictions.h"
#include "simulation/analysis/advice_constants.h"
#include "simulation/analysis/stability.h"
#include "simulation/engine_interface/engine.h"
#include "tests/support/load_text.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using simulation::Advice;
using simulation::ConstantAdvice;

std::string block(const std::string& world, const std::string& material, double upward = 0.) {
  return "World w { gravity = 9.81; duration = 1 s; " + world + " Material m { " + material +
         " } Terrain.Flat g { material = m; } Robot b { Base.mobile { rest_on = g; mass = 2; "
         "velocity = 0, 0, " +
         std::to_string(upward) +
         "; "
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
// A contact of two compliant sides is not the ground's alone.
TEST(Advice, FeetThatStateAStiffnessAreRefused) {
  const auto scene = [](const std::string& foot) {
    return *load_text("World w { Material soft { normal_stiffness = 10 kN/m; } Material foot { " +
                      foot +
                      " } Terrain.Flat g { material = soft; } Robot b { Base.mobile { rest_on = g; "
                      "Shape.Sphere { radius = 0.1; mass = 1 kg; material = foot; } } } }")
                .experiment;
  };
  EXPECT_NO_THROW(simulation::advise(scene("static_friction = 0.5;"), {}));
  try {
    simulation::advise(scene("normal_stiffness = 5 kN/m;"), {});
    ADD_FAILURE();
  } catch (const simulation::ExperimentError& error) {
    EXPECT_NE(std::string(error.what()).find("Material foot of the feet states normal_stiffness"),
              std::string::npos)
        << error.what();
  }
}

TEST(Advice, LinearLawByItsClosedForm) {
  const Advice advice = advice_for(block("deltat = 0.1 ms;", ""), {2e-3, 0.3, 0.1});
  const double k = 2. * 9.81 / (4. * 2e-3);
  EXPECT_NEAR(advised(advice, "normal_stiffness"), k, 1e-9 * k);
  const double zeta = contact::kelvin_voigt_damping_ratio(0.3);
  const double c = 2. * zeta * std::sqrt(k * 0.5);
  EXPECT_NEAR(advised(advice, "normal_damping"), c, 1e-6 * c);
  EXPECT_NEAR(advised(advice, "tangential_damping"), c, 1e-6 * c);
  EXPECT_EQ(advice.grounds[0].points, 4u);
  EXPECT_NEAR(advice.grounds[0].survival_advised, std::sqrt(9.81 * 2e-3), 1e-12);
}

// The engine itself, on the advised ground: the block sinks as deep as allowed.
TEST(Advice, AdvisedGroundCarriesTheBlockAtTheAllowedDepth) {
  for (const std::string law : {"hookpoint", "hunt_crossley", "azad_featherstone", "exponential"}) {
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
  EXPECT_NE(damped.changes[0].find(".tangential_damping = "), std::string::npos)
      << damped.changes[0];
  const Advice stiff =
      advice_for(block("deltat = 1 ms;",
                       "normal_stiffness = 1e9 N/m; normal_damping = 0; tangential_damping = 0;"),
                 {});
  EXPECT_NE(stiff.changes.at(0).find(".normal_stiffness = "), std::string::npos)
      << stiff.changes[0];
}

// Which constants matter follows from the load: 49 N sink beyond the nominal depth of the first
// ground, and there its second stiffness, of 1e9 N/m, is what makes the step too large.
TEST(Advice, NamesConstantsWithWhichTheStepIsStable) {
  const std::string nominal =
      "World w { deltat = 1 ms; contact = nominal; Material m { normal_stiffness = 1e9; "
      "nominal_stiffness = 1e4; "
      "nominal_penetration = 1 mm; } Terrain.Flat g { material = m; } Robot b { Base.mobile { "
      "rest_on = g; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 20; } } } }";
  for (const std::string& text :
       {nominal,
        block("deltat = 1 ms;", "normal_damping = 50 N.s/m; tangential_damping = 30 kN.s/m;"),
        block("deltat = 1 ms;", "normal_stiffness = 1e9 N/m; normal_damping = 0;"),
        block("deltat = 1 ms; contact = exponential;", "exponential_rate = 1e7;")}) {
    SCOPED_TRACE(text);
    simulation::Experiment experiment = *load_text(text).experiment;
    EXPECT_LT(simulation::stability_bound(experiment).step, experiment.deltat);
    const std::string line = simulation::advise(experiment, {}).changes.at(0);
    ASSERT_NE(line.find(": set "), std::string::npos) << line;
    const std::string said =
        line.substr(line.find(": set "), line.find(", or ") - line.find(": set "));
    const std::regex setting(R"((\w+)\.(\w+) = ([0-9.e+-]+))");
    int set = 0;
    for (std::sregex_iterator it(said.begin(), said.end(), setting), end; it != end; ++it) {
      const auto material =
          std::ranges::find(experiment.materials, it->str(1), &simulation::MaterialSpec::name);
      ASSERT_NE(material, experiment.materials.end()) << line;
      material->constants.*simulation::field_named(it->str(2)).member = std::stod(it->str(3));
      ++set;
    }
    EXPECT_GT(set, 0) << line;
    EXPECT_GT(simulation::stability_bound(experiment).step, experiment.deltat) << line;
  }
}

/// The first of the constants that changes `prediction` when it grows by a thousandth; "" if none.
template <class Prediction>
std::string first_that_matters(const std::vector<std::string>& names,
                               const Prediction& prediction) {
  const contact::Constants material;
  for (const std::string& name : names) {
    contact::Constants more = material;
    more.*simulation::field_named(name).member *= 1.001;
    if (prediction(more) != prediction(material)) return name;
  }
  return "";
}

// Of several that matter, the one that a law is soft by where a point rests.
TEST(AdviceConstants, AreThoseThatDepthAndReboundDependOn) {
  for (const std::string& name : contact::law_names()) {
    const auto* const law = contact::find_force_law(name);
    if (!law) continue;
    const auto stiffness = simulation::stiffness_field(*law);
    ASSERT_TRUE(stiffness) << name;
    EXPECT_EQ(stiffness->name,
              first_that_matters({"nominal_stiffness", "normal_stiffness", "exponential_rate"},
                                 [&](const contact::Constants& material) {
                                   return law->static_depth(20., material);
                                 }))
        << name;
    const auto damping = simulation::damping_field(*law);
    ASSERT_TRUE(damping) << name;
    EXPECT_EQ(damping->name, first_that_matters({"normal_damping", "hysteresis_damping"},
                                                [&](const contact::Constants& material) {
                                                  return law->restitution(2., 0.1, material);
                                                }))
        << name;
  }
}

double bound(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return simulation::stability_bound(*loaded.experiment).step;
}

/// A point of 1 kg on its ground, and on it whatever `chain` says.
std::string point(const std::string& integrator, const std::string& material,
                  const std::string& chain = "") {
  return "World w { gravity = 9.81; integrator = " + integrator + "; Material m { " + material +
         " } Terrain.Flat g { material = m; } Robot b { Base.mobile { rest_on = g; mass = 1; "
         "inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } } " +
         chain + " } }";
}

// Normal and tangential mode each have a bound of their own; the stiffer need not be the worse.
TEST(StabilityBound, IsThatOfTheWorstModeNotOfAMixture) {
  const std::string slack_damper =
      "normal_stiffness = 1e5; normal_damping = 300; tangential_stiffness = 4e4; "
      "tangential_damping = 20;";
  EXPECT_NEAR(bound(point("explicit_euler", slack_damper)), 20. / 4e4, 1e-12);
  EXPECT_NEAR(bound(point("semi_implicit_euler", slack_damper)),
              (std::sqrt(300. * 300. + 4. * 1e5) - 300.) / 1e5, 1e-12);
  EXPECT_EQ(bound(point("explicit_euler", "normal_damping = 0; tangential_damping = 0;")), 0.);
}

// A second mass on a vertical spring: w^2 are the roots of (k1 + k2 - m1 x)(k2 - m2 x) = k2^2.
TEST(StabilityBound, CountsTheSpringsOfJoints) {
  const double k1 = 2e4, k2 = 5e4, m2 = 0.25;
  const std::string chain =
      "Chain c { Link l { joint = prismatic; stiffness = 50 kN/m; mass = 0.25; "
      "center_of_mass = 0, 0, 0; inertia = 1, 1, 1, 0, 0, 0; } }";
  const double half = 0.5 * ((k1 + k2) * m2 + k2) / m2;
  const double w = std::sqrt(half + std::sqrt(half * half - k1 * k2 / m2));
  const std::string ground =
      "normal_stiffness = 2e4; normal_damping = 0; tangential_stiffness = 2e4; "
      "tangential_damping = 0;";
  EXPECT_NEAR(bound(point("semi_implicit_euler", ground, chain)), 2. / w, 1e-9);
  EXPECT_NEAR(bound(point("rk4", ground, chain)), 2. * std::sqrt(2.) / w, 1e-9);
}

// A damper alone, on soft ground: its rate is b (1/m1 + 1/m2), and 2 or 2.785 of its times are
// borne.
TEST(StabilityBound, CountsTheDampersAndDryFrictionOfJoints) {
  const std::string ground =
      "normal_stiffness = 1; normal_damping = 0; tangential_stiffness = 1; "
      "tangential_damping = 0;";
  const auto chain = [](const std::string& what) {
    return "Chain c { Link l { joint = prismatic; " + what +
           " mass = 0.25; center_of_mass = 0, 0, 0; inertia = 1, 1, 1, 0, 0, 0; } }";
  };
  const double rate = 100. * (1. + 1. / 0.25);
  // 5 N over 0.05 m/s: 100 N s/m.
  for (const std::string what :
       {"damping = 100;", "friction = 5; friction_speed = 0.05; friction_deflection = 1e9;"}) {
    EXPECT_NEAR(bound(point("semi_implicit_euler", ground, chain(what))), 2. / rate,
                1e-6 * 2. / rate);
    EXPECT_NEAR(bound(point("rk4", ground, chain(what))), 2.785293563405282 / rate, 1e-5 / rate);
  }
}

// Dry friction that sticks is a spring: 5 N over 0.1 mm between the two masses, here undamped.
TEST(StabilityBound, CountsTheSpringOfDryFriction) {
  const std::string ground =
      "normal_stiffness = 1; normal_damping = 0; tangential_stiffness = 1; "
      "tangential_damping = 0;";
  const std::string chain =
      "Chain c { Link l { joint = prismatic; friction = 5; friction_speed = 1e9; mass = 0.25; "
      "center_of_mass = 0, 0, 0; inertia = 1, 1, 1, 0, 0, 0; } }";
  const double w = std::sqrt(5. / 1e-4 * (1. + 1. / 0.25));
  EXPECT_NEAR(bound(point("semi_implicit_euler", ground, chain)), 2. / w, 1e-5 * 2. / w);
  EXPECT_NEAR(bound(point("rk4", ground, chain)), 2. * std::sqrt(2.) / w, 1e-5 / w);
}

// The factor that is advised makes the step stable, and little more than that.
TEST(Advice, AdvisedDampingIsAsLargeAsTheStepAllows) {
  const std::string world = "deltat = 1 ms;";
  const Advice advice =
      advice_for(block(world, "tangential_damping = 30 kN.s/m; normal_damping = 50 N.s/m;"), {});
  const std::string& change = advice.changes.at(0);
  const std::string set = ".tangential_damping = ";
  const double advised = std::stod(change.substr(change.find(set) + set.size()));
  const auto bound_with = [&](double c) {
    const Advice with = advice_for(block(world, "normal_damping = 50 N.s/m; tangential_damping = " +
                                                    std::to_string(c) + " N.s/m;"),
                                   {});
    for (const simulation::StepAdvice& step : with.steps) {
      if (step.integrator == "semi_implicit_euler") return step.present;
    }
    return 0.;
  };
  EXPECT_GT(bound_with(advised), 1e-3);
  EXPECT_LT(bound_with(2. * advised), 1e-3 * 1.25);
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

// d1 exp(d2 d) = W and d1 = W/10 where the tile would carry more than that, so d2 = ln(10)/d; its
// damper multiplies the whole force, so c is Hunt & Crossley's.
TEST(Advice, ExponentialSpringByItsClosedForm) {
  const double load = 2. * 9.81 / 4.;
  const Advice advice =
      advice_for(block("deltat = 0.1 ms; contact = exponential;", "exponential_force = 2 N;"),
                 {2e-3, 0.3, 0.1});
  EXPECT_NEAR(advised(advice, "exponential_force"), 0.1 * load, 1e-9 * load);
  EXPECT_NEAR(advised(advice, "exponential_rate"), std::log(10.) / 2e-3, 1e-6);
  const double a = 0.1 * advised(advice, "hysteresis_damping");
  EXPECT_NEAR(a - std::log1p(a), -0.3 * a - std::log1p(-0.3 * a), 1e-9 * a);
  EXPECT_NEAR(advised(advice, "tangential_stiffness"), load / 2e-3, 1e-6);
  const double zeta = contact::kelvin_voigt_damping_ratio(0.3);
  EXPECT_NEAR(advised(advice, "tangential_damping"), 2. * zeta * std::sqrt(load / 2e-3 * 0.5),
              1e-6);
}

// The advised speed is the one beyond which the engine's block leaves the ground: thrown up from
// rest a little slower it stays, a little faster it goes.
TEST(Advice, SurvivalSpeedIsThatAtWhichTheGroundIsLost) {
  for (const std::string law : {"hookpoint", "hunt_crossley", "exponential"}) {
    const std::string world = "deltat = 0.02 ms; contact = " + law + ";";
    const std::string material =
        "normal_damping = 0; tangential_damping = 0; hysteresis_damping = 0; "
        "regularisation_speed = 50 mm/s;";
    const Advice advice = advice_for(block(world, material), {1e-3, 0.3, 0.1});
    for (const double factor : {0.99, 1.01}) {
      Running run(block(world, material, factor * advice.grounds.at(0).survival_present));
      int contacts = 4;
      for (int i = 0; i < 10'000; ++i) {
        run.step();
        contacts = std::min(contacts, run.world().state().bodies.at(0).contacts);
      }
      EXPECT_EQ(contacts == 0, factor > 1.) << law << " " << factor;
    }
  }
}

// A force at the tile that is small enough is the user's to choose.
TEST(Advice, ExponentialSpringKeepsASmallForceAtTheTile) {
  const double load = 2. * 9.81 / 4.;
  const Advice advice = advice_for(block("deltat = 0.1 ms; contact = exponential;",
                                         "exponential_force = 0.1 N; exponential_height = 0.2 mm;"),
                                   {2e-3, 0.3, 0.1});
  EXPECT_NEAR(advised(advice, "exponential_rate"), std::log(load / 0.1) / 2.2e-3, 1e-6);
  for (const ConstantAdvice& constant : advice.grounds[0].constants)
    EXPECT_NE(constant.name, "exponential_force");
}

// Above its tile the ground carries what the block weighs: it hovers, whatever the rate.
TEST(Advice, HoveringBlockIsToldBothConstants) {
  const Advice advice = advice_for(block("deltat = 0.1 ms; contact = exponential;",
                                         "exponential_force = 100 N; exponential_height = 1 mm;"),
                                   {1e-3, 0.3, 0.1});
  const double rate = std::log(10.) / 1e-3;
  EXPECT_LT(advice.grounds[0].depth, 0.);
  EXPECT_NEAR(advised(advice, "exponential_rate"), rate, 1e-6);
  EXPECT_NEAR(advised(advice, "exponential_force"), 0.4905 * std::exp(-rate * 1e-3), 1e-9);
  ASSERT_FALSE(advice.changes.empty());
  EXPECT_NE(advice.changes[0].find("set exponential_force = 0.04905 N and exponential_rate = 2303"),
            std::string::npos)
      << advice.changes[0];
}

TEST(Advice, ALawWithoutATangentialSpringIsAdvisedNone) {
  const Advice advice = advice_for(block("deltat = 0.1 ms; contact = hunt_crossley;", ""), {});
  for (const ConstantAdvice& constant : advice.grounds[0].constants)
    EXPECT_EQ(constant.name.find("tangential"), std::string::npos) << constant.name;
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
