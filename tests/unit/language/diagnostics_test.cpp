// Every wrong file of tests/unit/diagnostics gives exactly the text in its .expected, and nothing
// else.
#include <gtest/gtest.h>

#include <algorithm>

#include "language/names.h"
#include "tests/support/derived_file.h"
#include "tests/support/folders.h"
#include "tests/support/language_files.h"
#include "tests/support/message_rules.h"

namespace hookpoint::language::testing {
namespace {

std::filesystem::path diagnostics_folder() {
  return std::filesystem::path(hookpoint::testing::source_folder()) / "tests/unit/diagnostics";
}

std::vector<std::string> wrong_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(diagnostics_folder())) {
    if (entry.path().extension() == ".hook") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

class WrongFile : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongFile, GivesTheExpectedText) {
  // Messages name files as they are reached from the folder.
  std::filesystem::current_path(diagnostics_folder());
  const Evaluated result = evaluate_file(GetParam() + ".hook", {}, {"configs"});
  EXPECT_EQ(result.root, nullptr);
  // The project's configs are found from here upward, wherever it stands.
  std::string errors = result.errors();
  const std::string project = hookpoint::testing::source_folder() + "/";
  for (std::size_t at; (at = errors.find(project)) != std::string::npos;)
    errors.erase(at, project.size());
  EXPECT_EQ(hookpoint::testing::stale("diagnostics", GetParam() + ".expected", errors), "");
  EXPECT_EQ(hookpoint::testing::broken_rule(errors), "");
}

INSTANTIATE_TEST_SUITE_P(All, WrongFile, ::testing::ValuesIn(wrong_files()),
                         [](const auto& test) { return test.param; });

TEST(Diagnostics, ThereAreEnoughWrongFiles) { EXPECT_GE(wrong_files().size(), 36U); }

SourceFile source(const std::string& text, const std::string& path = "a.hook") {
  return source_file(path, text);
}

std::string shown(const Diagnostics& diagnostics, bool colours = false) {
  std::ostringstream out;
  diagnostics.print(out, colours);
  return out.str();
}

TEST(Diagnostics, ShowTheLineTheCaretAndColours) {
  const SourceFile file = source("one\n\tt\xC3\xA9 two;\r\n");
  Diagnostics diagnostics;
  diagnostics.error({&file, 9, 3}, "expected three");
  diagnostics.note({}, "without a place");
  EXPECT_EQ(shown(diagnostics),
            "a.hook:2:5: error: expected three\n"
            " 2 | \tt\xC3\xA9 two;\n"
            "   | \t   ^~~\n"
            "note: without a place\n");
  EXPECT_NE(shown(diagnostics, true).find("\033[1;31merror: \033[0mexpected three"),
            std::string::npos);
}

TEST(Diagnostics, ALongLineIsShownAroundItsCaret) {
  const SourceFile file = source(std::string(100000, 'x') + "!" + std::string(100000, 'y'));
  Diagnostics diagnostics;
  diagnostics.error({&file, 100000, 1}, "here");
  const std::string text = shown(diagnostics);
  EXPECT_LT(text.size(), 500U);
  const std::size_t mark = text.find('!'), caret = text.find('^');
  EXPECT_EQ(mark - text.rfind('\n', mark), caret - text.rfind('\n', caret));
  EXPECT_NE(text.find(" | ...xxx"), std::string::npos) << "cut in front: " << text;
  EXPECT_NE(text.find("yyy...\n"), std::string::npos) << "cut behind: " << text;
}

TEST(Diagnostics, TheCaretStandsUnderWideCharacters) {
  // Two columns each, then an e with an accent of its own, which takes none.
  const SourceFile file = source("\u4e16\u754c e\u0301 x = 1;\n");
  Diagnostics diagnostics;
  diagnostics.error({&file, file.text.find('x'), 1}, "here");
  diagnostics.error({&file, 0, 6}, "there");
  const std::string text = shown(diagnostics);
  EXPECT_NE(text.find("\n   |        ^\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n   | ^~~~\n"), std::string::npos) << text;
}

TEST(Diagnostics, NothingCommandsTheTerminal) {
  const SourceFile file = source("b\033]0;title\a \u009b31m \xff c;\n", "a\033[31m.hook");
  Diagnostics diagnostics;
  diagnostics.error({&file, 0, 1}, "no `\033[2J` nor\nerror: of its own");
  EXPECT_EQ(shown(diagnostics),
            "a?[31m.hook:1:1: error: no `?[2J` nor?error: of its own\n"
            " 1 | b?]0;title? ??31m ? c;\n"
            "   | ^\n");
}

TEST(Diagnostics, AMissingFileHasNoPlaceAndAnEmptyLineNoCaret) {
  const SourceFile nothing = source(""), blank = source("one\n  \t\n");
  Diagnostics diagnostics;
  diagnostics.error({&nothing, 0, 1}, "there is no such file");
  diagnostics.error({&blank, 5, 1}, "expected two");
  EXPECT_EQ(shown(diagnostics),
            "a.hook: error: there is no such file\na.hook:2:2: error: expected two\n");
}

TEST(Message, RulesAreBroken) {
  using hookpoint::testing::broken_rule;
  for (const char* wrong :
       {"a Input is not one of", "a `offset` is", "an box", "world at 3.3000000000000003 s",
        "--token: --token takes", "\n 1 | \n   | ^", "no `x` here; did you mean `x`?"})
    EXPECT_NE(broken_rule(wrong), "") << wrong;
  for (const char* right :
       {"an Input is one of", "a URDF", "a unit", "a one", "an IMU", "at 3.3 s", "--port takes",
        " 1 | x\n   | ^", "`x` is not here; did you mean `y`?", "Base.mobile has an `angle`"})
    EXPECT_EQ(broken_rule(right), "") << right;
}

TEST(NearestName, IsNotTheNameItself) {
  EXPECT_EQ(nearest_name("creep_speed", {"creep_speed", "creep_sped"}), "creep_sped");
  EXPECT_EQ(nearest_name("mass", {"mass", "length"}), "");
}

TEST(NearestName, IsNearAndDeterministic) {
  const std::vector<std::string> names{"mass", "length", "location", "x"};
  EXPECT_EQ(nearest_name("mas", names), "mass");
  EXPECT_EQ(nearest_name("Mass", names), "mass");
  EXPECT_EQ(nearest_name("lenght", names), "length");
  EXPECT_EQ(nearest_name("locatoin", names), "location");
  EXPECT_EQ(nearest_name("velocity", names), "");
  EXPECT_EQ(nearest_name("q", names), "");
  EXPECT_EQ(nearest_name("", names), "");
}

}  // namespace
}  // namespace hookpoint::language::testing
