// From text to a checked tree: objects, defaults, references, wires, loops, includes, overrides.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "tests/support/folders.h"
#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

constexpr const char* arm = R"(
World w {
  Robot bot {
    Base.fixed { location = 0, 0, 1; }
    Chain leg { Link upper { mass = 1; } Link lower { mass = 2; } }
  }
}
)";

TEST(LanguageSchema, OfTheTestsIsSound) {
  EXPECT_EQ(schema_problems(make_schema()), std::vector<std::string>{});
}

TEST(LanguageSchema, ProblemsAreFound) {
  Schema schema;
  schema.add(make_class("A", "", {number("x", "furlong", ""), number("y", "m", "", "3 s")}, {"B"}));
  const std::vector<std::string> problems = schema_problems(schema);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0], "A.x: `furlong` is not an SI unit of the language");
  EXPECT_EQ(problems[1], "A.y: default: `y` takes a value in m, not in s");
  EXPECT_EQ(problems[2], "A: no class `B` to stand inside");
}

TEST(LanguageObjects, HaveFieldsDefaultsAndNames) {
  Evaluated result = evaluate_text(arm);
  ASSERT_TRUE(result.root) << result.errors();
  const Object& lower = result.at("w.bot.leg.lower");
  EXPECT_EQ(lower.type, "Link");
  EXPECT_EQ(lower.trail(), "w.bot.leg.lower");
  EXPECT_EQ(lower.number("mass"), 2.);
  EXPECT_TRUE(lower.given("mass"));
  EXPECT_EQ(lower.number("dhlength"), 0.);
  EXPECT_FALSE(lower.given("dhlength"));
  EXPECT_EQ(lower.word("joint"), "revolute");
  EXPECT_EQ(lower.parent->children_of("Link").size(), 2U);
  EXPECT_EQ(result.at("w.bot.base").type, "Base.fixed");
  EXPECT_FALSE(result.at("w.bot.base").named);
  EXPECT_EQ(result.at("w").find("gravity"), nullptr);
  EXPECT_EQ(result.at("w.bot").children_of("Base.").size(), 1U);
}

TEST(LanguageObjects, TheTokenAfterTheTypeTellsNameFromField) {
  Evaluated result = evaluate_text(
      "World w Robot r Base.fixed Shape.Cube dimensions=1,1,.3;\n"
      "Window { Window.grob eye; } Window Valuator.Slider zoom Wire TO eye.zoom;");
  ASSERT_TRUE(result.root) << result.errors();
  const Object& base = result.at("w.r.base");
  EXPECT_EQ(base.children.at(0)->numbers("dimensions"), (std::vector<double>{1., 1., .3}));
  EXPECT_EQ(result.at("zoom").wires.size(), 1U);
}

TEST(LanguageObjects, AnOrientationIsAUnitQuaternion) {
  const auto orientation = [](const std::string& value) {
    Evaluated result = evaluate_text("World w Robot r Base.fixed orientation = " + value + ";");
    EXPECT_TRUE(result.root) << result.errors();
    return result.at("w.r.base").numbers("orientation");
  };
  const double half = std::sqrt(0.5);
  const std::vector<std::pair<std::string, std::vector<double>>> cases{
      {"90 deg, 0, 0", {half, half, 0., 0.}},
      {"0, 90 deg, 0", {half, 0., half, 0.}},
      {"0, 0, 90 deg", {half, 0., 0., half}},
      {"3, 0, 4, 0", {.6, 0., .8, 0.}},
      // Roll first, then yaw, both about world axes: x to y, y to z, z to x.
      {"90 deg, 0, 90 deg", {.5, .5, .5, .5}}};
  for (const auto& [text, expected] : cases) {
    const std::vector<double> found = orientation(text);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], expected[i], 1e-15) << text;
  }
}

TEST(LanguageReferences, GoFromTheInnermostObjectOutwards) {
  Evaluated result = evaluate_text(R"(
World w {
  Material clay { static_friction = .1; }
  Robot bot { Base.mobile rest_on = ground; }
  Terrain.Flat ground { material = clay; }
  Terrain.Flat far { material = other.clay; }
}
World other { Material clay { static_friction = .2; } }
)");
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w.ground").object("material"), &result.at("w.clay"));
  EXPECT_EQ(result.at("w.far").object("material"), &result.at("other.clay"));
  EXPECT_EQ(result.at("w.bot.base").object("rest_on"), &result.at("w.ground"));
}

TEST(LanguageReferences, PortsAndTheirParts) {
  Evaluated result = evaluate_text(
      std::string(arm) + "Record a what = w.bot.base.location.z; Record b what = w.time;");
  ASSERT_TRUE(result.root) << result.errors();
  const Reference& reference = result.at("a").find("what")->reference;
  EXPECT_EQ(reference.object, &result.at("w.bot.base"));
  EXPECT_EQ(reference.port, "location.z");
  EXPECT_NE(evaluate_text(std::string(arm) + "Record what = w.bot.base.location.w;")
                .messages()
                .find("has no part `w`"),
            std::string::npos);
}

TEST(LanguageReferences, AreResolvedFromOutsideToo) {
  Evaluated result = evaluate_text(arm);
  Diagnostics diagnostics;
  const auto port = resolve(*result.root, "w.bot.base.orientation.w", true, diagnostics);
  ASSERT_TRUE(port);
  EXPECT_EQ(port->port, "orientation.w");
  EXPECT_FALSE(resolve(*result.root, "w.bot.bass", true, diagnostics));
  EXPECT_EQ(diagnostics.all().at(0).message,
            "`w.bot.bass`: `bot` (Robot) has no object or port `bass`; did you mean `base`?");
}

TEST(LanguageReferences, AnAmbiguousNameIsAnError) {
  const Evaluated result = evaluate_text(
      "Window { Window.grob eye; } Window { Window.grob eye; } Window v Valuator.Slider s Wire TO "
      "eye.zoom;");
  EXPECT_NE(result.messages().find("`eye` means two objects"), std::string::npos)
      << result.errors();
}

TEST(LanguageWires, FillInDefaultEndsAndTakeEitherOrder) {
  Evaluated result = evaluate_text(std::string(arm) + R"(
Controller.PD pd {
  Wire FROM w.bot.leg.upper.angle TO current { rate = 200 Hz; delay = 20 ms; noise = 0.5 deg; }
  Wire TO w.bot.leg.upper.torque FROM output;
}
Window Valuator.Slider goal Wire TO pd.goal;
Window { Button quit Wire TO Simulator.quit; }
)");
  ASSERT_TRUE(result.root) << result.errors();
  const Object& pd = result.at("pd");
  ASSERT_EQ(pd.wires.size(), 2U);
  EXPECT_EQ(pd.wires[0].from->object, &result.at("w.bot.leg.upper"));
  EXPECT_EQ(pd.wires[0].to->port, "current");
  EXPECT_EQ(pd.wires[0].fields.size(), 3U);
  EXPECT_EQ(pd.wires[1].from->object, &pd);
  EXPECT_EQ(pd.wires[1].from->port, "output");
  const Object& goal = result.at("goal");
  EXPECT_EQ(goal.wires[0].from->object, &goal);
  EXPECT_EQ(goal.wires[0].from->port, "value");
  EXPECT_EQ(result.at("quit").wires[0].to->object->type, "Simulator");
}

TEST(LanguageWires, OneInputTakesOneWire) {
  const std::string wires =
      "Window Valuator.Slider a { Wire TO eye.zoom; } Window Valuator.Slider b { Wire TO eye.zoom; "
      "}";
  const Evaluated twice = evaluate_text("Window Window.grob eye;" + wires);
  EXPECT_EQ(twice.messages(), "a second wire into `eye.zoom`\nthe first one is here\n");
}

TEST(LanguageWires, MustAgreeInUnitAndKind) {
  const auto messages = [](const std::string& wire) {
    return evaluate_text(std::string(arm) + "Window Window.grob eye;" + wire).messages();
  };
  EXPECT_EQ(messages("Wire FROM w.time TO eye.distance;"), "`time` is in s, `distance` in m\n");
  EXPECT_EQ(messages("Wire FROM w.time TO w.running;"),
            "`time` is a number in s, `running` takes true or false\n");
  EXPECT_EQ(messages("Wire FROM w.bot.base.location TO eye.distance;"),
            "`location` carries 3 numbers, `distance` takes 1\n");
  EXPECT_EQ(messages("Wire FROM w.bot.base.location.x TO eye.distance;"), "");
  EXPECT_EQ(messages("Wire FROM w.time TO w.time;"),
            "`time` of World is no input; its inputs are running\n");
  EXPECT_EQ(messages("Wire TO eye.zoom;"),
            "the top of the file has no output of its own: the wire needs FROM and a port\n");
}

TEST(LanguageLoops, LayDownIndexedObjects) {
  Evaluated result = evaluate_text(R"(
Let n = 3;
World w Robot r {
  For i in 0..n - 1 { Chain leg[i] { hip_distance = i * 1 m, 0, 0; For j in 1..2 { Link l[j] { mass = j; } } } }
}
Record what = w.r.leg[n - 1].l[2].angle;
)");
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w.r").children_of("Chain").size(), 3U);
  EXPECT_EQ(result.at("w.r.leg[2]").numbers("hip_distance")[0], 2.);
  EXPECT_EQ(result.at("w.r.leg[1].l[2]").number("mass"), 2.);
  EXPECT_TRUE(evaluate_text("World w; For i in 1..0 { World v[i]; }").root);
}

TEST(LanguageLoops, GoThroughListsAndNames) {
  Evaluated result = evaluate_text(R"(
Let sides = left, right;
World w Robot r {
  For side in sides {
    Chain side { hip_distance = side == left ? 0.5 : -0.5, 0, 0; For j in 3, 7 { Link l[j] { mass = j; } } }
  }
}
For side in left, right { Record side { what = w.r.side.l[3].angle; } }
)");
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w.r").children_of("Chain").size(), 2U);
  EXPECT_EQ(result.at("w.r.left").numbers("hip_distance")[0], 0.5);
  EXPECT_EQ(result.at("w.r.right").numbers("hip_distance")[0], -0.5);
  EXPECT_EQ(result.at("w.r.right.l[7]").number("mass"), 7.);
  EXPECT_NO_THROW(result.at("left"));
  EXPECT_NO_THROW(result.at("right"));
}

TEST(LanguageLoops, NamesAreSingleWordsAndEachOfItsOwn) {
  EXPECT_NE(evaluate_text("World w; For side in w.a, w.b { World side; }")
                .messages()
                .find("single words"),
            std::string::npos);
  EXPECT_NE(evaluate_text("For side in left, left { World side; }").messages().find("left"),
            std::string::npos);
  EXPECT_NE(evaluate_text("For side in left, right World side;").messages(), "");
}

TEST(LanguageLoops, AreBounded) {
  EXPECT_NE(
      evaluate_text("For i in 0..1e8 { World w[i]; }").messages().find("more than 1000000 values"),
      std::string::npos);
  EXPECT_NE(evaluate_text("For i in 0..999999 { For j in 0..999999 { } }")
                .messages()
                .find("steps of evaluation"),
            std::string::npos);
  EXPECT_NE(evaluate_text("For i in 0..1.5 { }").messages().find("whole number"),
            std::string::npos);
}

TEST(LanguageIncludes, LayDownWithArguments) {
  const Folder folder;
  folder.write(
      "robots/leg.hook",
      "Param side; Param femur = 400 mm; Link femur { mass = side * side; dhlength = femur; }");
  folder.write("clay.hook", "Material clay { static_friction = .3; }");
  const auto file = folder.write("test.hook", R"(
World w {
  Include "clay.hook";
  Terrain.Flat ground material = clay;
  Robot r Chain c { Include "robots/leg.hook" (side = -2, femur = 0.5) front_left; Include "robots/leg.hook" (side = 3); }
}
Record what = w.r.c.front_left.femur.angle;
)");
  Evaluated result = evaluate_file(file);
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w.r.c.front_left.femur").number("mass"), 4.);
  EXPECT_EQ(result.at("w.r.c.front_left.femur").number("dhlength"), .5);
  EXPECT_EQ(result.at("w.r.c.femur").number("mass"), 9.);
  EXPECT_EQ(result.at("w.r.c").children_of("Link").size(), 2U);
  EXPECT_EQ(result.at("w.ground").object("material"), &result.at("w.clay"));
}

TEST(LanguageIncludes, AreLookedUpBesideTheFileThenAlongThePath) {
  const Folder folder;
  folder.write("here/a.hook", "World beside;");
  folder.write("there/a.hook", "World along;");
  folder.write("there/b.hook", "World second;");
  const auto file = folder.write("here/test.hook", "Include \"a.hook\"; Include \"b.hook\";");
  Evaluated result = evaluate_file(file, {}, {folder.path() / "there"});
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.root->children.at(0)->name, "beside");
  EXPECT_EQ(result.root->children.at(1)->name, "second");
}

TEST(LanguageIncludes, TakeTheirPathFromAValue) {
  const Folder folder;
  folder.write("parts/clay.hook", "Material clay { static_friction = .3; }");
  folder.write("parts/sand.hook", "Param mu = .4; Material sand { static_friction = mu; }");
  folder.write("plugged.hook", "Plugin \"law.so\";");
  const auto file = folder.write("test.hook", R"(
Param soil = "parts/clay.hook";
Param second = sand;
World w { Include soil; Include ("parts/" + second + ".hook") (mu = .7) under; Include soil again; }
)");
  Evaluated result = evaluate_file(file);
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w.clay").number("static_friction"), .3);
  EXPECT_EQ(result.at("w.under.sand").number("static_friction"), .7);
  EXPECT_EQ(result.at("w.again.clay").number("static_friction"), .3);
  EvaluateOptions options;
  options.parameters = {{"soil", "\"parts/sand.hook\""}};
  EXPECT_EQ(evaluate_file(file, options).at("w.sand").number("static_friction"), .4);
  options.parameters = {{"soil", "\"parts/mud.hook\""}};
  EXPECT_EQ(evaluate_file(file, options).messages().substr(0, 36),
            "there is no file `parts/mud.hook`; l");
  EXPECT_EQ(evaluate_file(folder.write("two.hook", "Let p = \"plugged.hook\"; Include p;"))
                .messages()
                .substr(0, 64),
            "a Plugin stands in no file whose Include has its path from a val");
  EXPECT_EQ(evaluate_text("Include soil;").messages(),
            "an Include takes the path of a file, a string in quotes or a Param that holds one, "
            "not the word `soil`\n");
  EXPECT_EQ(evaluate_text("Include (\"a\" + 3);").messages(),
            "a string and a number cannot be put together\n");
}

TEST(LanguageIncludes, DoNotSeeTheIncludersVariables) {
  const Folder folder;
  folder.write("a.hook", "World w deltat = 2 * step;");
  const Evaluated result =
      evaluate_file(folder.write("test.hook", "Let step = 1 ms; Include \"a.hook\";"));
  EXPECT_EQ(result.messages(), "undefined variable `step`\nincluded here\n");
}

TEST(LanguageOverrides, SetFieldsAndParams) {
  EvaluateOptions options;
  options.overrides = {{"w.deltat", "2 ms"}, {"w.bot.leg.lower.mass", "1 + 2"}, {"n", "4"}};
  Evaluated result = evaluate_text("Param n = 1; Window v width = n;" + std::string(arm), options);
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w").number("deltat"), .002);
  EXPECT_TRUE(result.at("w").given("deltat"));
  EXPECT_EQ(result.at("w.bot.leg.lower").number("mass"), 3.);
  EXPECT_EQ(result.at("v").number("width"), 4.);
}

TEST(LanguageOverrides, ABareNumberTakesTheUnitOfTheParamsDefault) {
  EvaluateOptions options;
  options.parameters = {{"slope", "0.25"}};
  Evaluated result = evaluate_text(
      "Param slope = 20 deg; World w Terrain.Slope s angle = slope - 1 deg;", options);
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_DOUBLE_EQ(result.at("w.s").number("angle"), 0.25 - M_PI / 180.);
}

TEST(LanguageOverrides, AreCheckedLikeAnyText) {
  EvaluateOptions options;
  options.overrides = {{"w.bot.leg.lower.mass", "-1 kg"}};
  EXPECT_EQ(
      evaluate_text(arm, options).errors(),
      "<--set w.bot.leg.lower.mass>:1:22: error: `mass` must be greater than 0 kg, not -1 kg\n"
      " 1 | w.bot.leg.lower.mass=-1 kg\n"
      "   |                      ^~~~~\n");
  options.overrides = {{"w.bot.leg.lowr.mass", "1"}};
  EXPECT_NE(evaluate_text(arm, options).messages().find("did you mean `lower`?"),
            std::string::npos);
  options.overrides = {{"deltat", "1"}};
  EXPECT_NE(evaluate_text(arm, options).messages().find("no Param `deltat`"), std::string::npos);
}

TEST(LanguageLibrary, ListsParams) {
  const Folder folder;
  Evaluated result =
      evaluate_file(folder.write("test.hook", "Param slope = 20 deg; Param mu; World w;"));
  const auto params = result.library->parameters(folder.path() / "test.hook", result.diagnostics);
  ASSERT_EQ(params.size(), 2U);
  EXPECT_EQ(params[0].name, "slope");
  EXPECT_EQ(params[0].default_text, "20 deg");
  EXPECT_EQ(params[1].default_text, "");
}

TEST(LanguageLibrary, EvaluatesInManyThreadsAlike) {
  const Folder folder;
  const auto file =
      folder.write("test.hook", "Param mass = 1; World w Robot r Chain c Link l { mass = mass; }");
  const Schema schema = make_schema();
  Library library(schema, {});
  std::vector<double> masses(8);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      threads.emplace_back([&, i] {
        Diagnostics diagnostics;
        EvaluateOptions options;
        options.parameters = {{"mass", std::to_string(i + 1)}};
        const auto root = library.evaluate(file, options, diagnostics);
        masses[i] = resolve(*root, "w.r.c.l", false, diagnostics)->object->number("mass");
      });
    }
  }
  for (std::size_t i = 0; i < masses.size(); ++i) EXPECT_EQ(masses[i], static_cast<double>(i + 1));
}

TEST(LanguageNumber, IsWhatAFieldOfItsUnitWouldTake) {
  EXPECT_EQ(number_of("300 ms", "s"), 0.3);
  EXPECT_EQ(number_of("2.5", "s"), 2.5);
  EXPECT_EQ(number_of("1/2 * 3 s", "s"), 1.5);
  EXPECT_EQ(number_of("-(2 + 1) * 1 s", "s"), -3.);
  for (const char* wrong :
       {"", "s", "2 kg", "1, 2", "soon", "1/2 s", "2 s; x = 3", "1e999", "true"})
    EXPECT_EQ(number_of(wrong, "s"), std::nullopt) << wrong;
}

TEST(LanguageUnit, OfAValueIsTheOneThatItsFirstNumberIsWrittenIn) {
  Schema schema;
  FieldSchema values;
  values.name = "values";
  values.type = FieldType::numbers;
  values.unit = "?";
  values.max_count = 9;
  ClassSchema sweep;
  sweep.name = "Sweep";
  sweep.top_level = true;
  sweep.fields = {values};
  schema.add(sweep);
  const std::pair<const char*, const char*> cases[] = {
      {"5 deg, 1 rad", "deg"}, {"a /* 3 kg */, 10 deg", "deg"},
      {"2 * 5deg", "deg"},     {"10 m / 2 s, 3 mm/s", "mm/s"},
      {"a, 2 * a", ""},        {"1, 2 // 3 kg\n", ""}};
  for (const auto& [text, unit] : cases) {
    const Folder folder;
    const auto file =
        folder.write("test.hook", "Let a = 5 deg; Sweep s { values = " + std::string(text) + "; }");
    Library library(schema, {});
    Diagnostics diagnostics;
    const auto root = library.evaluate(file, {}, diagnostics);
    ASSERT_TRUE(root) << text;
    EXPECT_EQ(root->children.front()->find("values")->unit, unit) << text;
  }
}

TEST(LanguagePaper, Figure7ParsesAndChecksWhole) {
  Evaluated result = evaluate_file(std::filesystem::path(hookpoint::testing::source_folder()) /
                                   "configs/paper/fig7_two_joint_arm.hook");
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("SimpleWorld").numbers("gravity"), std::vector<double>{9.81});
  EXPECT_EQ(result.at("SimpleWorld.simplebot.leg1.link1").number("dhtwist"), 1.57);
  EXPECT_EQ(result.at("videocam").object("drawer"), &result.at("SimpleWorld"));
  EXPECT_EQ(result.at("pause").wires[0].to->port, "running");
  EXPECT_EQ(result.at("pd2").wires[1].to->object, &result.at("SimpleWorld.simplebot.leg1.link2"));
}

}  // namespace
}  // namespace hookpoint::language::testing
