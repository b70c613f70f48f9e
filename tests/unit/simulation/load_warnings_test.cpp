// What a file is warned of though it runs, and a step that is chosen for it.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/force_law.h"
#include "language/document/document.h"
#include "simulation/analysis/stability.h"
#include "simulation/analysis/step_warning.h"
#include "tests/support/component_bench.h"
#include "tests/support/folders.h"
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

TEST(Warnings, TellOfARobotOfWhichNothingTouches) {
  const auto told = [](const std::string& more, const std::string& base) {
    return load_text("World w { " + more + " Robot b { " + base + " } }").diagnostics;
  };
  const std::string ground = "Terrain.Flat f { }", mass = "mass = 1; inertia = 1, 1, 1, 0, 0, 0;";
  const std::string warning = "`b` falls through the ground: nothing of it touches";
  const auto is_warned = [&](const std::string& more, const std::string& base) {
    return told(more, base).find(warning) != std::string::npos;
  };
  EXPECT_TRUE(is_warned(ground, "Base.mobile { " + mass + " }"));
  EXPECT_TRUE(is_warned(
      ground, "Base.mobile { Shape.Sphere { radius = 0.1; mass = 1; contact = false; } }"));
  EXPECT_TRUE(is_warned(ground, "Base.planar { plane = xz; " + mass + " }"));
  EXPECT_FALSE(is_warned(ground, "Base.planar { plane = xy; " + mass + " }")) << "it cannot fall";
  EXPECT_FALSE(is_warned(ground, "Base.fixed { }"));
  EXPECT_FALSE(is_warned(ground + " gravity = 0;", "Base.mobile { " + mass + " }"));
  EXPECT_FALSE(is_warned("", "Base.mobile { " + mass + " }"));
  EXPECT_FALSE(is_warned(ground, "Base.mobile { " + mass + " ContactPoint foot { } }"));
}

TEST(Warnings, TellOfARunThatTakesNoStep) {
  const std::string none = "the run takes none";
  EXPECT_NE(
      load_text(world("duration = 0.4 s; deltat = 1 s;", "mass = 1; inertia = 1, 1, 1, 0, 0, 0;"))
          .diagnostics.find(none),
      std::string::npos);
  EXPECT_EQ(
      load_text(world("duration = 0.6 s; deltat = 1 s;", "mass = 1; inertia = 1, 1, 1, 0, 0, 0;"))
          .diagnostics.find(none),
      std::string::npos);
}

// A World without a Terrain has its contacts on obstacles and between robots.
TEST(Warnings, TellOfConstantsOfObstaclesAndOfRobotsAlone) {
  const std::string ball = "Shape.Sphere { radius = 0.05; mass = 1; } } } ";
  const auto on_box = [&](const std::string& law, const std::string& of_box,
                          const std::string& of_ball) {
    return load_text(
               "World w { contact = " + law +
               "; Material s { restitution = 0.7; rolling_resistance = 2 mm; } Material t { } "
               "Obstacle.Box o { dimensions = 2, 2, 0.2; location = 0, 0, -0.1; " +
               of_box + " } Robot b { Base.mobile { location = 0, 0, 0.5; " + of_ball + ball + "}")
        .diagnostics;
  };
  const auto collide = [&](const std::string& law) {
    return load_text("World w { contact = " + law +
                     "; Material s { restitution = 0.7; } Robot a { Base.mobile { material = s; " +
                     ball + "Robot b { Base.mobile { location = 1, 0, 0; material = s; " + ball +
                     "}")
        .diagnostics;
  };
  // Where neither side states a Material the World's first holds.
  for (const std::string& said :
       {on_box("hookpoint", "material = s;", ""), on_box("hookpoint", "", "material = s;"),
        on_box("hookpoint", "", ""), collide("hookpoint")})
    EXPECT_NE(said.find("`restitution` is not read by contact law hookpoint"), std::string::npos)
        << said;
  for (const std::string& said :
       {on_box("hunt_crossley", "material = s;", ""), on_box("impulse", "material = t;", ""),
        on_box("hunt_crossley", "", ""), collide("hunt_crossley")})
    EXPECT_NE(said.find("has constants of its own"), std::string::npos) << said;
  EXPECT_NE(on_box("impulse", "material = s;", "").find("`rolling_resistance` is not read"),
            std::string::npos);
  EXPECT_EQ(collide("impulse"), "");
  // Nothing can touch a robot that is alone.
  EXPECT_EQ(
      load_text("World w { Material s { restitution = 0.7; } Robot b { Base.mobile { material = "
                "s; " +
                ball + "}")
          .diagnostics,
      "");
}

// Four corners of a box 0.1 m deep in ground of k = 50 kN/m hold 4 k d^2/2 = 1000 J, and m g = 9.81 N.
TEST(Warnings, TellOfABodyThatStartsDeepInside) {
  const auto box = [](const std::string& height, const std::string& ground) {
    return load_text("World w { gravity = 9.81; Material s { normal_stiffness = 50 kN/m; } " +
                     ground + " Robot b { Base.mobile { location = 0, 0, " + height +
                     "; Shape.Box { dimensions = 0.2, 0.2, 0.2; mass = 1; } } } }")
        .diagnostics;
  };
  const std::string flat = "Terrain.Flat g { material = s; }";
  const std::string block =
      "Obstacle.Box g { dimensions = 4, 4, 2; location = 0, 0, -1; material = s; }";
  for (const std::string& ground : {flat, block}) {
    const std::string said = box("0", ground);
    for (const char* part : {"`b` starts 0.1 m deep in", "1e+03 J", "102 m high", "location"})
      EXPECT_NE(said.find(part), std::string::npos) << part << said;
    // At its static depth, m g/(4 k) = 0.049 mm, and ten times as deep.
    for (const char* height : {"0.1", "0.09995", "0.0996"})
      EXPECT_EQ(box(height, ground), "") << height;
  }
}

// 1e4 kg on four corners of 100 kN/m: m g/(4 k) = 0.245 m.
TEST(Warnings, TellOfGroundThatIsTooSoftForABody) {
  const auto box = [](const std::string& mass) {
    return load_text(
               "World w { gravity = 9.81; Terrain.Flat g { } Robot b { Base.mobile { rest_on = g; "
               "Shape.Box { dimensions = 1, 1, 0.4; mass = " +
               mass + "; } } } }")
        .diagnostics;
  };
  const std::string said = box("1e4 kg");
  for (const char* part : {"`b` rests 0.245 m deep in the ground", "normal_stiffness"})
    EXPECT_NE(said.find(part), std::string::npos) << part << said;
  EXPECT_EQ(box("1e3 kg"), "");
}

TEST(Warnings, TellOfATableThatLiesOutsideOfTheRun) {
  const testing::TemporaryFile file("late.csv", "time [s],F [N]\n100,1\n101,2\n");
  const auto said = [&](const std::string& fields) {
    const Loaded loaded = load_text(
        "World w { duration = 1 s; Robot b { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, "
        "0, 0; } } Force p { body = b.base; } Data d { file = \"" +
        file.path() + "\"; column = \"F\"; " + fields + " Wire TO p.force.z; } }");
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    return loaded.diagnostics;
  };
  EXPECT_NE(said("").find("the table's times, 100 s to 101 s, lie outside of the run, 0 s to 1 s"),
            std::string::npos);
  EXPECT_EQ(said("offset = 100 s;"), "");
  EXPECT_EQ(said("start = -99.5 s;"), "");
}

constexpr const char* overlapping = "overlap or touch";

/// A body that floats above its ground, with these shapes.
std::string shaped(const std::string& shapes) {
  return world("Terrain.Flat f { }", "location = 0, 0, 1; " + shapes);
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
  // Written for every law: something of each that has constants of its own.
  const std::string written =
      "normal_stiffness = 1e5; restitution = 0.8; exponent = 1.2; breakaway = 0.7; "
      "nominal_stiffness = 1e4; ";
  EXPECT_EQ(on_clay("hookpoint", written + "exponential_rate = 1e3;"), "");
  EXPECT_NE(on_clay("hookpoint", written).find("are not read"), std::string::npos);
  // Nothing lies on the other Material.
  EXPECT_EQ(load_text(world("Material ice { restitution = 0.8; } Material clay { normal_stiffness "
                            "= 1e5; } Terrain.Flat f { material = clay; } "))
                .diagnostics,
            "");
}

TEST(Warnings, TellOfConstantsOfSeveralLawsThatNoneIsWrittenFor) {
  const std::string told = on_clay("hookpoint", "restitution = 0.8; exponent = 1.5;");
  EXPECT_NE(told.find("`restitution`, `exponent` are not read by contact law hookpoint: they "
                      "change nothing in this run; laws that read `exponent`: hunt_crossley; "
                      "`restitution`: impulse, impulse_reversal"),
            std::string::npos)
      << told;
  EXPECT_NE(on_clay("hookpoint", "normal_stiffness = 1e5; restitution = 0.8; exponent = 1.5;")
                .find("`restitution`, `exponent` are not read"),
            std::string::npos);
}

constexpr const char* unread_restitution = "`restitution` is not read by contact law lugre";

TEST(Warnings, TellOfUnreadConstantsWhoeverChoosesTheLaw) {
  const std::string file =
      world("Material clay { restitution = 0.8; } Terrain.Flat f { material = clay; } ");
  EXPECT_NE(load_text(file, set({{"w.contact", "lugre"}})).diagnostics.find(unread_restitution),
            std::string::npos);
  const testing::TemporaryFile material("clay.hook", "Material clay { restitution = 0.8; }");
  EXPECT_NE(load_text("Include \"" + material.path() + "\"; " +
                      world("contact = lugre; Terrain.Flat f { material = clay; } "))
                .diagnostics.find(unread_restitution),
            std::string::npos);
}

TEST(Warnings, TellAStudyOfUnreadConstantsThatItSets) {
  const std::string file =
      "Param e = 0.8; Let rebound = e/2; " +
      world("Material clay { restitution = 2*rebound; } Terrain.Flat f { material = clay; } ");
  language::EvaluateOptions subject = set({{"w.contact", "lugre"}});
  const auto told = [&] {
    return load_text(file, subject, simulation::RunOf::study)
               .diagnostics.find(unread_restitution) != std::string::npos;
  };
  // Its scene serves other subjects too.
  EXPECT_FALSE(told());
  subject.parameters["e"] = "0.2";
  EXPECT_TRUE(told());
  subject.parameters.clear();
  subject.overrides.push_back({"w.clay.restitution", "0.2"});
  EXPECT_TRUE(told());
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
  // A point of mass that starts in balance lies below the ground by its static depth.
  EXPECT_EQ(load_text("World w { Terrain.Flat f; Robot b { Base.mobile { rest_on = f; mass = 1; "
                      "inertia = 1,1,1,0,0,0; ContactPoint { location = 0, 0, 0; } } } }")
                .diagnostics,
            "");
}

TEST(Warnings, TellWhereASettledStartIsNone) {
  const auto on_slope = [](const std::string& fields, const std::string& settled) {
    return load_text("World w { " + fields +
                     " Terrain.Slope f { angle = 15 deg; } Robot b { Base.mobile { rest_on = f; " +
                     settled + " Shape.Box { dimensions = 0.3, 0.2, 0.1; mass = 2; } } } }")
        .diagnostics;
  };
  const std::string settled = "settled = true;",
                    force = "Force push { body = b.base; force = 1, 0, -5; }";
  const std::string told = "`b` moves at the start in spite of `settled = true`: ";
  EXPECT_EQ(on_slope("", settled), "");
  EXPECT_NE(on_slope("engine = ode;", settled).find(told + "engine ode starts"), std::string::npos);
  EXPECT_NE(
      on_slope("contact = impulse;", settled).find(told + "contact law impulse has no springs"),
      std::string::npos);
  EXPECT_NE(on_slope(force, settled)
                .find(told + "the balance is that of its weight, without Force "
                             "`push`"),
            std::string::npos);
  for (const std::string& fields : {std::string("engine = ode;"), force})
    EXPECT_EQ(on_slope(fields, "").find(told), std::string::npos);
}

TEST(Warnings, TellOfAChosenStepThatMakesARunLong) {
  const auto cube = [](const std::string& fields) {
    return load_text(
               "World w { duration = 10 s; " + fields +
               " Terrain.Flat f; Robot b { Base.mobile { rest_on = f; Shape.Cube { dimensions "
               "= 0.01, 0.01, 0.01; mass = 1e-3; } } } }")
        .diagnostics;
  };
  EXPECT_NE(cube("").find("the chosen step is"), std::string::npos) << cube("");
  EXPECT_EQ(cube("deltat = 1e-6 s;").find("the chosen step is"), std::string::npos);
}

TEST(Warnings, TellOfShapesOfOneBodyThatMeet) {
  const auto halves = [](double gap) {
    return shaped("Shape.Box left { location = " + std::to_string(-0.05 - gap) +
                  ", 0, 0; dimensions = 0.1, 0.1, 0.1; mass = 1; } Shape.Box { location = 0.05, 0, "
                  "0; dimensions = 0.1, 0.1, 0.1; mass = 1; }");
  };
  const Loaded touching = load_text(halves(0.));
  ASSERT_TRUE(touching.experiment);
  EXPECT_NE(touching.diagnostics.find(overlapping), std::string::npos) << touching.diagnostics;
  for (const char* part :
       {"Shape.Box `left` and Shape.Box in line 1 of w.b.base", "`contact = false`", "note 1:"})
    EXPECT_NE(touching.diagnostics.find(part), std::string::npos) << part << touching.diagnostics;
  EXPECT_NE(load_text(halves(-0.02)).diagnostics.find(overlapping), std::string::npos);
  EXPECT_EQ(load_text(halves(0.02)).diagnostics, "");
  const std::string cube = "Shape.Cube { dimensions = 0.1, 0.1, 0.1; mass = 1; } ";
  EXPECT_NE(load_text(shaped(cube + cube)).diagnostics.find(overlapping), std::string::npos);
}

TEST(Warnings, AreNotOfShapesThatBearInsteadOfWhatTheyContain) {
  // A ball at the end of a leg, one that is wider than its leg, and a motor inside its housing.
  const std::string leg = "Shape.Cylinder { radius = 0.02; length = 0.3; mass = 1; } ";
  for (const std::string& shapes :
       {leg + "Shape.Sphere { location = 0, 0, -0.15; radius = 0.02; mass = 0.1; }",
        leg + "Shape.Sphere { location = 0, 0, -0.14; radius = 0.05; mass = 0.1; }",
        std::string("Shape.Cube { dimensions = 0.2, 0.2, 0.2; mass = 1; } Shape.Cylinder { radius "
                    "= 0.05; length = 0.1; mass = 1; }")})
    EXPECT_EQ(load_text(shaped(shapes)).diagnostics, "") << shapes;
}

TEST(Warnings, AreOneOfAllBodiesWhoseShapesMeetAndNoneOfThoseWithoutContact) {
  const auto table = [](const std::string& top) {
    return shaped("Shape.Box top { dimensions = 0.8, 0.4, 0.04; mass = 4; " + top +
                  "} For i in 0..3 { Shape.Box leg[i] { dimensions = 0.04, 0.04, 0.4; location = "
                  "0.3*(i < 2 ? 1 : -1), 0.1*(i == 1 || i == 2 ? 1 : -1), -0.21; mass = 0.5; } }");
  };
  const Loaded all = load_text(table(""));
  ASSERT_TRUE(all.experiment) << all.diagnostics;
  EXPECT_NE(all.diagnostics.find("Shape.Box `top` and Shape.Box `leg[0]`"), std::string::npos)
      << all.diagnostics;
  EXPECT_EQ(all.diagnostics.find(overlapping), all.diagnostics.rfind(overlapping));
  const Loaded some = load_text(table("contact = false; "));
  ASSERT_TRUE(some.experiment) << some.diagnostics;
  EXPECT_EQ(some.diagnostics, "");
  const simulation::BodySpec &whole = all.experiment->robots[0].base,
                             &legs = some.experiment->robots[0].base;
  EXPECT_EQ(whole.boundary_points.size(), 40U);
  EXPECT_EQ(legs.boundary_points.size(), 32U);
  EXPECT_EQ(legs.shapes.size(), 4U);
  EXPECT_EQ(legs.shapes_without_contact.size(), 1U);
  EXPECT_EQ(legs.mass.mass, whole.mass.mass);
  EXPECT_EQ(legs.mass.center_of_mass, whole.mass.center_of_mass);
  EXPECT_EQ(legs.mass.inertia.xx, whole.mass.inertia.xx);
  const std::string half =
      "Shape.Cube { dimensions = 1, 1, 1; mass = 1; } Shape.Cube { location = 1, 0, 0; dimensions "
      "= 1, 1, 1; mass = 1; } ";
  const Loaded two = load_text(
      "World w { Terrain.Flat f { } For i in 0..1 { Robot b[i] { Base.mobile { location "
      "= 0, 3*i, 1; " +
      half + "} } } }");
  EXPECT_NE(two.diagnostics.find(", and shapes of another body:"), std::string::npos)
      << two.diagnostics;
  EXPECT_EQ(two.diagnostics.find(overlapping), two.diagnostics.rfind(overlapping));
}

// A scene that is shipped states what any law reads, so that a study of laws warns of nothing.
TEST(Warnings, AreNotOfScenesThatAreShipped) {
  const std::filesystem::path configs = std::filesystem::path(testing::source_folder()) / "configs";
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

/// A ball of 1 kg without friction or damping, k = `stiffness` N/m: it bounces on one spring, for
/// which semi-implicit Euler bears 2/sqrt(k/m), 2/sqrt(k) s.
std::string ball(const std::string& fields, double stiffness) {
  return "World w { " + fields +
         " Material m { static_friction = 0; kinetic_friction = 0; normal_damping = 0; "
         "normal_stiffness = " +
         std::to_string(stiffness) +
         "; } Terrain.Flat f { material = m; } Robot b { Base.mobile { rest_on = f; Shape.Sphere { "
         "radius = 0.1; mass = 1; } } } }";
}

TEST(AutomaticStep, IsTheDefaultHalfTheBoundAndAtMostOneMillisecond) {
  const Loaded stiff = load_text(ball("", 3e6));  // 1.1547 ms
  ASSERT_TRUE(stiff.experiment) << stiff.diagnostics;
  EXPECT_NEAR(stiff.experiment->chosen_from.value_or(0.), 2. / std::sqrt(3e6), 1e-9);
  EXPECT_DOUBLE_EQ(stiff.experiment->deltat, 5e-4);
  const Loaded soft = load_text(ball("", 1e3));  // 63 ms
  ASSERT_TRUE(soft.experiment) << soft.diagnostics;
  EXPECT_DOUBLE_EQ(soft.experiment->deltat, 1e-3);
  const Loaded written = load_text(ball("deltat = 3 ms;", 3e6));
  ASSERT_TRUE(written.experiment) << written.diagnostics;
  EXPECT_DOUBLE_EQ(written.experiment->deltat, 3e-3);
  EXPECT_FALSE(written.experiment->chosen_from);
}

// Whoever computes it, a file has one step, and none that loaded with 1 ms is refused.
TEST(AutomaticStep, IsThatOfEngineDtsForAllAndOneMillisecondWhereThereIsNoBound) {
  const Loaded peer = load_text(ball("engine = ode;", 3e6));
  ASSERT_TRUE(peer.experiment) << peer.diagnostics;
  EXPECT_DOUBLE_EQ(peer.experiment->deltat, 5e-4);
  EXPECT_FALSE(simulation::step_warning(*peer.experiment));
  for (const char* fields : {"contact = impulse;", "integrator = cvode_bdf;",
                             "engine = ode; "
                             "contact = impulse;"}) {
    const Loaded loaded = load_text(ball(fields, 3e6));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_DOUBLE_EQ(loaded.experiment->deltat, 1e-3) << fields;
    EXPECT_TRUE(std::isinf(*loaded.experiment->chosen_from)) << fields;
  }
  const Loaded free = load_text(
      "World w { Robot b { Base.mobile { mass = 1; inertia = 1,1,1,0,0,0; "
      "} } }");
  ASSERT_TRUE(free.experiment) << free.diagnostics;
  EXPECT_DOUBLE_EQ(free.experiment->deltat, 1e-3);
}

TEST(AutomaticStep, LetsAControllerAndARecordHaveTheirRates) {
  // 1 ms would be too long for 4 kHz, and a delay of 0.3 ms no delay.
  const Loaded loaded =
      load_text(ball("Record r { rate = 4 kHz; trails = w.b.base.location; }", 1e3) +
                " Gain one { Wire FROM two.output TO input { delay = 0.3 ms; } } Gain two { Wire "
                "FROM one.output TO input { delay = 0.3 ms; } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_DOUBLE_EQ(loaded.experiment->deltat, 5e-5);  // 0.25 ms is no multiple of 0.2 or 0.1 ms
}

// Undamped, explicit Euler is unstable with every step: what ran with 1 ms still does, warned of.
TEST(AutomaticStep, IsOneMillisecondWhereNoStepIsStable) {
  const Loaded loaded = load_text(ball("integrator = explicit_euler;", 1e3));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_DOUBLE_EQ(loaded.experiment->deltat, 1e-3);
  EXPECT_EQ(*loaded.experiment->chosen_from, 0.);
  const auto warning = simulation::step_warning(*loaded.experiment);
  ASSERT_TRUE(warning);
  EXPECT_EQ(*warning,
            "no step of explicit_euler is stable under the law hookpoint: what springs back gains "
            "energy; give what vibrates some damping, or choose another integrator");
}

TEST(StepWarning, SaysHowLargeTheStepMayBeAndWhatToDo) {
  const Loaded loaded = load_text(ball("deltat = 2 ms;", 3e6));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const auto warning = simulation::step_warning(*loaded.experiment);
  ASSERT_TRUE(warning);
  EXPECT_EQ(
      *warning,
      "deltat 0.002 s is above the largest stable step 0.001155 s of semi_implicit_euler "
      "under the law hookpoint: what springs back gains energy; make the step smaller (deltat "
      "= auto) or the ground softer, or choose another integrator");
  EXPECT_FALSE(simulation::step_warning(*load_text(ball("deltat = 1 ms;", 3e6)).experiment));
}

// A default too: without it the printed file would choose again.
TEST(AutomaticStep, IsWrittenIntoWhatIsPrinted) {
  for (const char* field : {"deltat = auto; ", ""}) {
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "auto.hook";
    std::ofstream(file) << world(std::string(field) + "Terrain.Flat f { }");
    language::Library library(experiment_schema(), {});
    language::Diagnostics diagnostics;
    const auto root = library.evaluate(file, {}, diagnostics);
    ASSERT_TRUE(root);
    EXPECT_EQ(language::print(*root).find("deltat = auto;") != std::string::npos, field[0] != 0);
    const auto experiment = simulation::load_experiment(*root, diagnostics);
    ASSERT_TRUE(experiment);
    simulation::write_chosen_step(*experiment, *root);
    const std::string printed = language::print(*root);
    const Loaded again = load_text(printed);
    ASSERT_TRUE(again.experiment) << again.diagnostics;
    EXPECT_EQ(again.experiment->deltat, experiment->deltat);
    EXPECT_FALSE(again.experiment->chosen_from);
    EXPECT_EQ(printed.find("deltat"), printed.rfind("deltat"));
  }
}

}  // namespace
}  // namespace hookpoint
