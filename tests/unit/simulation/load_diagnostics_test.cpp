// Every wrong experiment of tests/unit/diagnostics_full, read with the whole schema as `hookpoint
// check` does, gives exactly the text in its .expected, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/derived_file.h"
#include "tests/support/folders.h"
#include "tests/support/language_files.h"
#include "tests/support/load_text.h"
#include "tests/support/message_rules.h"

namespace hookpoint {
namespace {

std::filesystem::path folder() {
  return std::filesystem::path(testing::source_folder()) / "tests/unit/diagnostics_full";
}

std::vector<std::string> wrong_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() == ".hook") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

/// What the program says of a file, data files named as they are reached from the folder.
std::string diagnostics_of(const std::string& file) {
  std::filesystem::current_path(folder());
  language::Library library(experiment_schema(), {});
  language::Diagnostics diagnostics;
  const auto root = library.evaluate(file, {}, diagnostics);
  const bool loads = root && simulation::load_experiment(*root, diagnostics, {}).has_value();
  EXPECT_FALSE(loads);
  std::ostringstream text;
  diagnostics.print(text, false);
  std::string said = text.str();
  const std::string absolute = std::filesystem::current_path().string() + "/";
  for (std::size_t at = said.find(absolute); at != std::string::npos; at = said.find(absolute))
    said.erase(at, absolute.size());
  return said;
}

class WrongExperimentFile : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongExperimentFile, GivesTheExpectedText) {
  const std::string said = diagnostics_of(GetParam() + ".hook");
  const std::filesystem::path expected = folder() / (GetParam() + ".expected");
  EXPECT_NE(said, "");
  EXPECT_EQ(testing::stale("diagnostics", expected, said), "");
  EXPECT_EQ(testing::broken_rule(said), "");
}

INSTANTIATE_TEST_SUITE_P(All, WrongExperimentFile, ::testing::ValuesIn(wrong_files()),
                         [](const auto& test) { return test.param; });

TEST(WrongExperimentFiles, AreEnough) { EXPECT_GE(wrong_files().size(), 70U); }

}  // namespace
}  // namespace hookpoint
