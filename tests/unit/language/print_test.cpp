// print: a valid file that evaluates to the same tree, bit for bit. format: the same meaning,
// comments kept, idempotent.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/support/folders.h"
#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

const char* const rich = R"(
// Everything that print must carry.
Param n = 2;
Let clay_name = clay;
World w {
  gravity = 0, 0, -9.81; deltat = 5 ms; engine = ode; seed = 12345678;
  Material clay { normal_stiffness = 30 kN/m; static_friction = 1 / 3; }
  Terrain.Flat ground material = clay_name;
  Robot bot {
    Base.mobile { location = 1e-7, .1 + .2, -0.; orientation = 10 deg, 20 deg, 30 deg; rest_on = ground; Shape.Cube dimensions=1,1,.3; }
    For i in 0..n - 1 { Chain leg[i] { hip_distance = i * 1 m, 0, sqrt(2) * 1 cm; Link l { mass = 120 g; angle = 5 deg; } } }
  }
}
Controller.PD pd1 {
  rate = 200 Hz;
  Wire FROM w.bot.leg[0].l.angle TO current { rate = 200 Hz; delay = 20 ms; noise = 0.5 deg; }
  Wire TO w.bot.leg[n - 1].l.torque FROM output;
}
Data d { file = "a \"b\" \\ c.csv"; interpolate = linear; }
Window { Button quit Wire TO Simulator.quit; }
Window controllers {
  Window { Valuator.Slider goal { range = -3.2 rad, 3.2 rad; value = 90 deg; Wire TO pd1.goal; } }
  Window { Valuator.Slider goal { range = 0, 1; Wire TO pd1.pconstant; } }
}
Wire FROM w.bot.base.location.x TO eye.distance;
Window Window.grob eye { drawer = w; }
Record what = w.bot.base.orientation.w;
)";

void expect_same(const Field& a, const Field& b) {
  EXPECT_EQ(a.schema->name, b.schema->name);
  EXPECT_EQ(a.words, b.words);
  EXPECT_EQ(a.dimension, b.dimension) << a.schema->name;
  ASSERT_EQ(a.numbers.size(), b.numbers.size());
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.numbers[i]),
              std::bit_cast<std::uint64_t>(b.numbers[i]))
        << a.schema->name;
  }
  EXPECT_EQ(a.reference.port, b.reference.port);
  EXPECT_EQ(a.reference.object == nullptr, b.reference.object == nullptr);
  if (a.reference.object != nullptr && b.reference.object != nullptr) {
    EXPECT_EQ(a.reference.object->trail(), b.reference.object->trail());
  }
}

void expect_same(const Object& a, const Object& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.named, b.named);
  ASSERT_EQ(a.fields.size(), b.fields.size()) << a.trail();
  for (std::size_t i = 0; i < a.fields.size(); ++i) expect_same(a.fields[i], b.fields[i]);
  ASSERT_EQ(a.wires.size(), b.wires.size()) << a.trail();
  for (std::size_t i = 0; i < a.wires.size(); ++i) {
    EXPECT_EQ(a.wires[i].from->object->trail(), b.wires[i].from->object->trail());
    EXPECT_EQ(a.wires[i].from->port, b.wires[i].from->port);
    EXPECT_EQ(a.wires[i].to->object->trail(), b.wires[i].to->object->trail());
    EXPECT_EQ(a.wires[i].to->port, b.wires[i].to->port);
    ASSERT_EQ(a.wires[i].fields.size(), b.wires[i].fields.size());
    for (std::size_t j = 0; j < a.wires[i].fields.size(); ++j)
      expect_same(a.wires[i].fields[j], b.wires[i].fields[j]);
  }
  ASSERT_EQ(a.children.size(), b.children.size()) << a.trail();
  for (std::size_t i = 0; i < a.children.size(); ++i) expect_same(*a.children[i], *b.children[i]);
}

TEST(LanguagePrint, EvaluatesToTheSameTreeBitForBit) {
  const Evaluated first = evaluate_text(rich);
  ASSERT_TRUE(first.root) << first.errors();
  const std::string printed = print(*first.root);
  const Evaluated second = evaluate_text(printed);
  ASSERT_TRUE(second.root) << second.errors() << printed;
  expect_same(*first.root, *second.root);
  EXPECT_EQ(print(*second.root), printed);
}

TEST(LanguagePrint, KeepsEveryDouble) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    double value = std::bit_cast<double>(random());
    if (!std::isfinite(value) || std::abs(value) < 1e-300) value = static_cast<double>(i);
    std::ostringstream text;
    text.precision(17);
    text << "Window w Valuator.Slider s value = " << value << ";";
    Evaluated first = evaluate_text(text.str());
    ASSERT_TRUE(first.root) << first.errors();
    Evaluated second = evaluate_text(print(*first.root));
    ASSERT_EQ(second.at("w.s").number("value"), value);
  }
}

TEST(LanguagePrint, AnyOrientationStaysItself) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    std::ostringstream text;
    text.precision(17);
    text << "World w Robot r Base.fixed orientation = " << normal(random) << ',' << normal(random)
         << ',' << normal(random) << ',' << normal(random) << ';';
    Evaluated first = evaluate_text(text.str());
    Evaluated second = evaluate_text(print(*first.root));
    ASSERT_TRUE(second.root) << second.errors();
    expect_same(*first.root, *second.root);
  }
}

TEST(LanguagePrint, NamedIncludesStayGroups) {
  const Folder folder;
  folder.write("leg.hook", "Chain c { Link l { mass = 1; } }");
  Evaluated first =
      evaluate_file(folder.write("test.hook",
                                 "World w Robot r { For i in 0..1 { Include \"leg.hook\" leg[i]; } "
                                 "} Record what = w.r.leg[1].c.l.rate;"));
  ASSERT_TRUE(first.root) << first.errors();
  const Evaluated second = evaluate_text(print(*first.root));
  ASSERT_TRUE(second.root) << second.errors();
  expect_same(*first.root, *second.root);
}

std::size_t comments_in(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("comment", at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(LanguageFormat, KeepsMeaningAndIsIdempotent) {
  const std::string once = format_text(rich);
  EXPECT_EQ(format_text(once), once);
  const Evaluated before = evaluate_text(rich), after = evaluate_text(once);
  ASSERT_TRUE(after.root) << after.errors();
  EXPECT_EQ(print(*before.root), print(*after.root));
}

TEST(LanguageFormat, HasOneLayout) {
  EXPECT_EQ(format_text("World   w{gravity=9.81;deltat=5   ms;\n\n\n\nengine=ode;}"),
            "World w {\n  gravity = 9.81; deltat = 5 ms;\n\n  engine = ode;\n}\n");
  EXPECT_EQ(format_text("World w // comment\n{ // more comment\n}// comment"),
            "World w {  // comment  // more comment\n}  // comment\n");
  EXPECT_EQ(format_text("World w { Terrain.Slope\n s\n angle=-( 2+3 )^2*1deg; }"),
            "World w {\n  Terrain.Slope s angle = -(2 + 3)^2 * 1 deg;\n}\n");
  EXPECT_EQ(format_text("For i in -1 .. 2{World w[ i ];};"), "For i in -1..2 { World w[i]; }\n");
  EXPECT_EQ(format_text("Include \"a.hook\"(a=1,b=2)x;"), "Include \"a.hook\" (a = 1, b = 2) x;\n");
  EXPECT_EQ(format_text("Let a=30 kN / m ;Let b=a>1?!true:false;"),
            "Let a = 30 kN/m; Let b = a > 1 ? !true : false;\n");
}

TEST(LanguageFormat, AStatementThatIsTooLongForALineKeepsItsLines) {
  const std::string half(60, 'a');
  EXPECT_EQ(format_text("Let x=" + half + "\n+" + half + ";"),
            "Let x = " + half + "\n    + " + half + ";\n");
  EXPECT_EQ(format_text("World w {Let y=1;Let x=" + half + "\n\n  +" + half + ";}"),
            "World w {\n  Let y = 1;\n  Let x = " + half + "\n      + " + half + ";\n}\n");
  const std::string shorter(50, 'a');  // 112 columns in all: there is room for it on a line
  EXPECT_EQ(format_text("Let x=" + shorter + "\n+" + shorter + ";"),
            "Let x = " + shorter + " + " + shorter + ";\n");
}

/// But for the paper's own text, which stands as printed.
TEST(LanguageFormat, EveryConfigIsLaidOut) {
  const std::filesystem::path configs =
      std::filesystem::path(hookpoint::testing::source_folder()) / "configs";
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(configs)) {
    if (entry.path().extension() != ".hook" || entry.path().parent_path().filename() == "paper")
      continue;
    const std::string text = read_file(entry.path());
    Diagnostics diagnostics;
    EXPECT_TRUE(format(entry.path().string(), text, diagnostics) == text)
        << "hookpoint fmt would change " << entry.path();
    ++count;
  }
  EXPECT_GT(count, 50);
}

TEST(LanguageFormat, LeavesATextWithErrorsAlone) {
  Diagnostics diagnostics;
  EXPECT_EQ(format("test.hook", "World { = ", diagnostics), "World { = ");
  EXPECT_TRUE(diagnostics.has_errors());
}

/// Comments, empty lines and line ends put between the words of a good file at random.
TEST(LanguageFormat, CommentsAnywhereAreKept) {
  std::mt19937 random(3);
  const std::string source =
      "World w { gravity = 9.81 ; Terrain.Flat g { height = - 3 mm * ( 2 + 1 ) ; } engine = ode ; "
      "} Wire FROM w.time "
      "TO x.value { delay = 1 ms ; } Window v { Valuator.Slider s ; } Window x Valuator.Slider "
      "value ; Let wider_than_a_line = first_long_name * second_long_name + third_long_name - "
      "fourth_long_name / ( fifth_long_name + sixth_long_name ) ;";
  const std::string fillers[] = {
      " ",    "\n", "\n\n\n", " // comment\n", " /* comment */ ", "\n/* comment\n comment */\n",
      "\r\n", " "};
  for (int round = 0; round < 500; ++round) {
    std::string text;
    for (std::size_t i = 0; i < source.size(); ++i) {
      const bool unit = source.compare(i, 3, " mm") == 0 || source.compare(i, 3, " ms") == 0;
      text += source[i] == ' ' && !unit ? fillers[random() % std::size(fillers)]
                                        : std::string(1, source[i]);
    }
    const std::string once = format_text(text);
    ASSERT_EQ(format_text(once), once) << text;
    ASSERT_EQ(comments_in(once), comments_in(text)) << text << "\n----\n" << once;
    const auto bare = [](const std::string& formatted) {
      std::string letters;
      for (std::size_t i = 0; i < formatted.size(); ++i) {
        if (formatted.compare(i, 2, "//") == 0)
          i = std::min(formatted.find('\n', i), formatted.size() - 1);
        if (formatted.compare(i, 2, "/*") == 0) i = formatted.find("*/", i) + 2;
        if (i < formatted.size() && std::isspace(static_cast<unsigned char>(formatted[i])) == 0)
          letters += formatted[i];
      }
      return letters;
    };
    std::string expected = source;
    std::erase(expected, ' ');
    ASSERT_EQ(bare(once), expected) << text << "\n----\n" << once;
  }
}

}  // namespace
}  // namespace hookpoint::language::testing
