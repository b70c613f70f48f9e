// Whatever bytes come: an answer, in time, and never a crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "tests/support/folders.h"
#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

std::string figure_7() {
  return read_file(std::filesystem::path(hookpoint::testing::source_folder()) /
                   "configs/paper/fig7_two_joint_arm.hook");
}

/// Evaluates many texts with one Library, each as a file of its own.
class Texts {
 public:
  std::unique_ptr<Object> evaluate(const std::string& text, Diagnostics& diagnostics) {
    const auto file = folder_.write(std::to_string(count_++) + ".hook", text);
    std::unique_ptr<Object> root = library_.evaluate(file, {}, diagnostics);
    std::filesystem::remove(file);
    return root;
  }

 private:
  Folder folder_;
  Schema schema_ = make_schema();
  Library library_{schema_, {}};
  int count_ = 0;
};

std::string errors_of(const std::string& text) { return evaluate_text(text).errors(); }

TEST(LanguageRobustness, AFileCutAtAnyByteIsReported) {
  const std::string whole = figure_7().substr(0, 1900);
  Texts texts;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    Diagnostics diagnostics;
    const std::string text = whole.substr(0, length);
    const std::unique_ptr<Object> root = texts.evaluate(text, diagnostics);
    ASSERT_EQ(root == nullptr, diagnostics.has_errors()) << length;
    // Only a cut between two objects of the top leaves a good, smaller file: then as many braces
    // are closed as opened.
    const bool balanced = std::ranges::count(text, '{') == std::ranges::count(text, '}') &&
                          text.find('{') != std::string::npos;
    if (!balanced) {
      ASSERT_EQ(root, nullptr) << length;
    }
  }
}

TEST(LanguageRobustness, AnOpenBraceIsPointedAt) {
  const std::string text = errors_of("World w {\n  Robot r {\n    Base.fixed;\n");
  EXPECT_NE(text.find("4:1: error: expected `}`, but the file ends here"), std::string::npos)
      << text;
  EXPECT_NE(text.find("2:11: note: this `{` is still open"), std::string::npos) << text;
}

TEST(LanguageRobustness, BinaryIsNoText) {
  std::mt19937 random(1);
  for (int round = 0; round < 50; ++round) {
    std::string bytes(1000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    EXPECT_NE(errors_of(bytes).find("not a text file"), std::string::npos);
  }
  EXPECT_NE(errors_of(std::string("World w;\0", 9))
                .find("1:9: error: the file is not a text file: unexpected control character 0"),
            std::string::npos);
  EXPECT_NE(errors_of("World w; // \xC3(").find("UTF-8"), std::string::npos);
  EXPECT_NE(errors_of("").find("the file describes nothing"), std::string::npos);
  EXPECT_NE(errors_of("// only a comment\n").find("the file describes nothing"), std::string::npos);
  EXPECT_EQ(errors_of("World w; // \xC3\xA9t\xC3\xA9\n"), "");
}

TEST(LanguageRobustness, RandomWordsNeverCrash) {
  const std::vector<std::string> words{"World",   "w",     "{",
                                       "}",       ";",     "=",
                                       "1",       "2 m",   "\"a\"",
                                       ",",       "(",     ")",
                                       "[",       "]",     ".",
                                       "..",      "Wire",  "FROM",
                                       "TO",      "Let",   "Param",
                                       "For",     "in",    "i",
                                       "Include", "Link",  "mass",
                                       "+",       "-",     "*",
                                       "/",       "^",     "?",
                                       ":",       "&&",    "||",
                                       "!",       "<",     "==",
                                       "sin",     "pi",    "true",
                                       "engine",  "ode",   "Robot",
                                       "r",       "\n",    "// c\n",
                                       "/* c */", "Chain", "Terrain.Flat",
                                       "1e999",   "@",     "0",
                                       "Group"};
  std::mt19937 random(7);
  Texts texts;
  for (int round = 0; round < 3000; ++round) {
    std::string text;
    const std::size_t length = random() % 60;
    for (std::size_t i = 0; i < length; ++i)
      text += words[random() % words.size()] + (random() % 4 == 0 ? "" : " ");
    Diagnostics diagnostics, again;
    const std::unique_ptr<Object> root = texts.evaluate(text, diagnostics);
    ASSERT_EQ(root == nullptr, diagnostics.has_errors()) << text;
    const std::string once = format_text(text);
    ASSERT_EQ(format_text(once), once) << text;
    if (root) {
      ASSERT_TRUE(texts.evaluate(print(*root), again)) << text;
    }
  }
}

TEST(LanguageRobustness, AWordChangedInAGoodFileNeverCrashes) {
  const std::string whole = figure_7();
  const std::string letters = "{};=,.()[]\"/*-+ \n1aW";
  std::mt19937 random(9);
  Texts texts;
  for (int round = 0; round < 300; ++round) {
    std::string text = whole;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = letters[random() % letters.size()];
    Diagnostics diagnostics;
    const std::unique_ptr<Object> root = texts.evaluate(text, diagnostics);
    ASSERT_EQ(root == nullptr, diagnostics.has_errors());
  }
}

class LargeFile
    : public ::testing::TestWithParam<std::pair<const char*, std::function<std::string()>>> {};

std::string repeated(const std::string& text) {
  constexpr std::size_t size = 1'000'000;
  std::string all;
  all.reserve(size + text.size());
  while (all.size() < size) all += text;
  return all;
}

// What is quadratic takes hours: ctest's deadline ends it, whatever else the machine does.
TEST_P(LargeFile, IsAnswered) {
  const Folder folder;
  const auto file = folder.write("large.hook", GetParam().second());
  const Evaluated result = evaluate_file(file);
  EXPECT_LT(result.errors().size(), 20000U);
}

INSTANTIATE_TEST_SUITE_P(
    All, LargeFile,
    ::testing::Values(std::pair{"braces", [] { return repeated("{"); }},
                      std::pair{"closing", [] { return repeated("}"); }},
                      std::pair{"blocks", [] { return repeated("World w{"); }},
                      std::pair{"parentheses", [] { return "Let a = " + repeated("("); }},
                      std::pair{"brackets", [] { return "Let a = " + repeated("a["); }},
                      std::pair{"minus", [] { return "Let a = " + repeated("-"); }},
                      std::pair{"powers", [] { return "Let a = " + repeated("2^"); }},
                      std::pair{"questions", [] { return "Let a = " + repeated("true?1:"); }},
                      std::pair{"sum", [] { return "Let a = " + repeated("1+") + "1;World w;"; }},
                      std::pair{"letters", [] { return repeated("a"); }},
                      std::pair{"digits", [] { return "Let a = " + repeated("9") + ";"; }},
                      std::pair{"words", [] { return repeated("foo bar;"); }},
                      std::pair{"strings", [] { return repeated("\"a"); }},
                      std::pair{"comment", [] { return "/*" + repeated("x\n"); }},
                      std::pair{"fields", [] { return "World w {" + repeated("a=1;") + "}"; }},
                      std::pair{"trail", [] { return "Record what = a" + repeated(".a") + ";"; }},
                      std::pair{"objects",
                                [] {
                                  std::string text = "World w {\n";
                                  for (int i = 0; text.size() < 10'000'000; ++i) {
                                    text +=
                                        "Material m" + std::to_string(i) +
                                        " { static_friction = .5; normal_stiffness = 3 kN/m; }\n";
                                  }
                                  return text + "Terrain.Flat g material = m77; }\n";
                                }}),
    [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace hookpoint::language::testing
