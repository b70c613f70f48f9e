// What a file is warned of though it runs, and a step that is chosen for it.
#include <gtest/gtest.h>

#include "contact/force_law.h"
#include "language/document.h"
#include "simulation/analysis/stability.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

std::string world(const std::string& fields, const std::string& base = "") {
  return "World w { " + fields + " Robot b { Base.mobile { " +
         (base.empty() ? "rest_on = f; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 1; }"
                       : base) +
         " } } }";
}

TEST(Warnings, TellOfALawWhoseOwnConstantsNoMaterialStates) {
  const std::string ground =
      "Material clay { normal_stiffness = 1e5; } Terrain.Flat f { material = "
      "clay; } ";
  const Loaded silent = load_text(world("contact = hookpoint; " + ground));
  EXPECT_EQ(silent.diagnostics, "");
  const Loaded told = load_text(world("contact = hunt_crossley; " + ground));
  ASSERT_TRUE(told.experiment);
  EXPECT_NE(told.diagnostics.find("warning 1:36"), std::string::npos) << told.diagnostics;
  for (const char* part :
       {"hunt_crossley", "clay", "exponent (1.5)", "hysteresis_damping (0.5 s/m)", "N/m^exponent"})
    EXPECT_NE(told.diagnostics.find(part), std::string::npos) << part << told.diagnostics;
  for (const char* law : {"impulse", "exponential", "elastoplastic", "nominal"})
    EXPECT_NE(load_text(world(std::string("contact = ") + law + "; " + ground))
                  .diagnostics.find("constants of its own"),
              std::string::npos)
        << law;
  EXPECT_EQ(
      load_text(world("contact = impulse; Material clay { restitution = 0.3; } Terrain.Flat f "
                      "{ material = clay; } "))
          .diagnostics,
      "");
  EXPECT_NE(load_text(world("contact = impulse; Terrain.Flat f { } "))
                .diagnostics.find("the ground has no Material"),
            std::string::npos);
}

language::EvaluateOptions set(std::vector<language::Override> overrides) {
  language::EvaluateOptions options;
  options.overrides = std::move(overrides);
  return options;
}

std::string on_clay(const std::string& law, const std::string& constants) {
  return load_text(world("contact = " + law + "; Material clay { " + constants +
                         " } Terrain.Flat f { material = clay; } "))
      .diagnostics;
}

TEST(Warnings, TellOfConstantsThatTheLawDoesNotRead) {
  const std::string told = on_clay("hookpoint", "restitution = 0.8; normal_stiffness = 1e5;");
  EXPECT_NE(told.find("`restitution` is not read by contact law hookpoint"), std::string::npos)
      << told;
  EXPECT_NE(told.find("laws that read it: impulse, impulse_reversal"), std::string::npos) << told;
  EXPECT_EQ(told.find("normal_stiffness"), std::string::npos) << told;
  EXPECT_EQ(on_clay("hookpoint", "normal_stiffness = 1e5; static_friction = 0.5;"), "");
  // Two at once, in one warning.
  const std::string both = on_clay("hookpoint", "hysteresis_damping = 0.4 s/m; exponent = 1.2;");
  EXPECT_NE(both.find("`exponent`, `hysteresis_damping` are not read"), std::string::npos) << both;
  EXPECT_NE(both.find("laws that read them: hunt_crossley"), std::string::npos) << both;
  // A coefficient of friction stands in for the other, unless both are given and differ.
  EXPECT_EQ(on_clay("impulse", "restitution = 0.3; static_friction = 0.5;"), "");
  EXPECT_NE(on_clay("impulse", "restitution = 0.3; static_friction = 0.5; kinetic_friction = 0.4;")
                .find("`static_friction` is not read"),
            std::string::npos);
}

TEST(Warnings, AreSilentOfConstantsForOtherLaws) {
  // Written for several laws: no one of them reads all that this one does not.
  EXPECT_EQ(on_clay("hookpoint", "restitution = 0.8; exponent = 1.2; stribeck_speed = 0.1;"), "");
  // Nothing lies on the other Material.
  EXPECT_EQ(load_text(world("Material ice { restitution = 0.8; } Material clay { normal_stiffness "
                            "= 1e5; } Terrain.Flat f { material = clay; } "))
                .diagnostics,
            "");
  // The law is chosen outside, as in a comparison; or the constant too.
  const std::string file =
      world("Material clay { normal_stiffness = 1e5; } Terrain.Flat f { material = clay; } ");
  EXPECT_EQ(load_text(file, set({{"w.contact", "impulse"}})).diagnostics.find("not read"),
            std::string::npos);
  EXPECT_NE(load_text(file, set({{"w.contact", "lugre"}, {"w.clay.restitution", "0.8"}}))
                .diagnostics.find("`restitution` is not read by contact law lugre"),
            std::string::npos);
}

TEST(Warnings, TellOfBodiesThatRestOnPutsBelowTheGround) {
  const auto arm = [](double reach) {
    return "World w { Terrain.Flat f; Robot b { Base.mobile { rest_on = f; mass = 1; inertia = "
           "1,1,1,0,0,0; } Chain arm { Link hand { mass = 1; inertia = 1,1,1,0,0,0; ContactPoint { "
           "location = 0, 0, " +
           std::to_string(reach) + "; } } } } }";
  };
  const Loaded hanging = load_text(arm(0.5));
  ASSERT_TRUE(hanging.experiment);
  EXPECT_NE(hanging.diagnostics.find("2 of its 2 bodies lie below the ground"), std::string::npos)
      << hanging.diagnostics;
  EXPECT_NE(hanging.diagnostics.find("by 0.5 m"), std::string::npos) << hanging.diagnostics;
  EXPECT_EQ(load_text(arm(-0.5)).diagnostics, "");
}

TEST(Warnings, TellOfShapesOfOneBodyThatMeet) {
  const auto halves = [](double gap) {
    return world("Terrain.Flat f { }",
                 "location = 0, 0, 1; Shape.Box { location = " + std::to_string(-0.05 - gap) +
                     ", 0, 0; dimensions = 0.1, 0.1, 0.1; mass = 1; } Shape.Box { location = 0.05, "
                     "0, 0; dimensions = 0.1, 0.1, 0.1; mass = 1; }");
  };
  const Loaded touching = load_text(halves(0.));
  ASSERT_TRUE(touching.experiment);
  EXPECT_NE(touching.diagnostics.find("overlap or touch"), std::string::npos)
      << touching.diagnostics;
  EXPECT_NE(load_text(halves(-0.02)).diagnostics.find("overlap or touch"), std::string::npos);
  EXPECT_EQ(load_text(halves(0.02)).diagnostics, "");
}

// A scene that is shipped states what any law reads, so that a study of laws warns of nothing.
TEST(Warnings, AreNotOfScenesThatAreShipped) {
  const std::filesystem::path configs = std::filesystem::path(HOOKPOINT_SOURCE_DIR) / "configs";
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(configs / "scenes")) {
    language::Library library(experiment_schema(), {configs});
    language::Diagnostics untold;
    const auto root = library.evaluate(file.path(), {}, untold);
    ASSERT_TRUE(root) << file.path();
    const std::string world = root->children_of("World").front()->trail();
    for (const contact::LawDescription& law : contact::law_table()) {
      const Loaded loaded =
          load_file(file.path(), {{}, {{world + ".contact", std::string(law.name)}}});
      if (!loaded.experiment) continue;
      ++scenes;
      EXPECT_EQ(loaded.diagnostics.find("constants of its own"), std::string::npos)
          << file.path() << " " << law.name << ": " << loaded.diagnostics;
    }
  }
  EXPECT_GT(scenes, 300);
}

TEST(AutomaticStep, IsARoundPartOfTheBoundThatDividesTheRates) {
  const Loaded plain = load_text(world("deltat = auto; Terrain.Flat f { }"));
  ASSERT_TRUE(plain.experiment) << plain.diagnostics;
  const double bound = simulation::stability_bound(*plain.experiment).step;
  EXPECT_DOUBLE_EQ(*plain.experiment->chosen_from, bound);
  EXPECT_LE(plain.experiment->deltat, 0.5 * bound);
  EXPECT_GT(plain.experiment->deltat, 0.5 * bound / 2.51);
  // 0.3 ms is no multiple of 0.2 ms.
  const Loaded recorded = load_text(
      world("deltat = auto; Record r { rate = (10000 / 3) * 1 Hz; trails = w.b.base.location; } "
            "Terrain.Flat f { }"));
  ASSERT_TRUE(recorded.experiment) << recorded.diagnostics;
  EXPECT_DOUBLE_EQ(recorded.experiment->deltat, 1e-4);
}

TEST(AutomaticStep, IsWrittenIntoWhatIsPrinted) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "auto.hook";
  std::ofstream(file) << world("deltat = auto; Terrain.Flat f { }");
  language::Library library(experiment_schema(), {});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(file, {}, diagnostics);
  ASSERT_TRUE(root);
  EXPECT_NE(language::print(*root).find("deltat = auto;"), std::string::npos);
  const auto experiment = simulation::load_experiment(*root, diagnostics);
  ASSERT_TRUE(experiment);
  simulation::write_chosen_step(*experiment, *root);
  const Loaded again = load_text(language::print(*root));
  ASSERT_TRUE(again.experiment) << again.diagnostics;
  EXPECT_EQ(again.experiment->deltat, experiment->deltat);
  EXPECT_FALSE(again.experiment->chosen_from);
}

TEST(AutomaticStep, AsksForANumberWhereThereIsNoBound) {
  for (const char* fields : {"engine = ode;", "contact = impulse; Material m { restitution = 0; }",
                             "integrator = cvode_bdf;"}) {
    const Loaded loaded =
        load_text(world(std::string("deltat = auto; ") + fields + " Terrain.Flat f { }"));
    EXPECT_FALSE(loaded.experiment) << fields;
    EXPECT_NE(loaded.diagnostics.find("error 1:20 deltat = auto"), std::string::npos)
        << loaded.diagnostics;
    EXPECT_NE(loaded.diagnostics.find("give deltat a number"), std::string::npos);
  }
}

}  // namespace
}  // namespace hookpoint
