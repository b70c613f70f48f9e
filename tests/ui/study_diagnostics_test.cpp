// Every wrong Study, Tune, Calibrate, Wall and Matrix of tests/ui/diagnostics_studies, read as
// `hookpoint check` does, gives exactly the text in its .expected: the words, the place and the caret.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/derived_file.h"
#include "tests/support/folders.h"
#include "tests/support/message_rules.h"

namespace hookpoint {
namespace {

std::filesystem::path folder() {
  return std::filesystem::path(testing::source_folder()) / "tests/ui/diagnostics_studies";
}

std::vector<std::string> wrong_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    if (entry.path().extension() == ".hook") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

/// Without the project's own path, wherever it stands.
std::string from_the_root(std::string text) {
  const std::string root = testing::source_folder() + "/";
  for (std::size_t at; (at = text.find(root)) != std::string::npos;) text.erase(at, root.size());
  return text;
}

class WrongStudyFile : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongStudyFile, GivesTheExpectedText) {
  const testing::Workplace work;
  const testing::CommandResult result =
      work.hookpoint("check '" + (folder() / (GetParam() + ".hook")).string() + "'");
  EXPECT_EQ(result.status, 2);
  const std::string said = from_the_root(result.err);
  EXPECT_NE(said, "");
  EXPECT_EQ(testing::stale("diagnostics", folder() / (GetParam() + ".expected"), said), "");
  EXPECT_EQ(testing::broken_rule(said), "");
}

INSTANTIATE_TEST_SUITE_P(All, WrongStudyFile, ::testing::ValuesIn(wrong_files()),
                         [](const auto& test) { return test.param; });

TEST(WrongStudyFiles, AreEnough) { EXPECT_GE(wrong_files().size(), 40U); }

}  // namespace
}  // namespace hookpoint
