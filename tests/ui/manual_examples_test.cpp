// What pages of the manual show is run as a reader would: their named blocks are files, the lines of
// their blocks of `sh` commands.
// ctest: long, released
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/page_blocks.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::PageBlock;
using testing::Workplace;

/// Writes the page's files into the place, with the shipped configs beside them, and returns its
/// commands.
std::vector<std::string> set_out(const Workplace& place, const std::string& page) {
  std::filesystem::create_directory_symlink(testing::source_folder() + "/configs",
                                            place.folder() / "configs");
  std::vector<std::string> commands;
  const std::string text = testing::read_file(testing::source_folder() + "/docs/" + page);
  for (const PageBlock& block : testing::blocks_of(text)) {
    if (!block.name.empty()) place.file(block.name, block.text);
    if (block.language != "sh") continue;
    std::istringstream lines(block.text);
    for (std::string line; std::getline(lines, line);) commands.push_back(line);
  }
  return commands;
}

class ManualExamples : public ::testing::TestWithParam<std::string> {};

TEST_P(ManualExamples, EveryCommandOfThePageWorks) {
  const Workplace place;
  const std::vector<std::string> commands = set_out(place, GetParam());
  ASSERT_FALSE(commands.empty());
  for (const std::string& command : commands) {
    ASSERT_TRUE(command.starts_with("hookpoint ")) << command;
    const CommandResult ran = place.hookpoint(command.substr(std::string("hookpoint ").size()));
    if (ran.status == 3 && testing::has(ran.err, "engine")) continue;  // one that is not found
    EXPECT_EQ(ran.status, 0) << command << "\n" << ran.err;
  }
}

/// Pages with blocks of `sh`; the tutorial has a test of its own (tutorial_test.cpp).
std::vector<std::string> pages_with_commands() {
  std::vector<std::string> pages;
  for (const auto& entry :
       std::filesystem::directory_iterator(testing::source_folder() + "/docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "tutorial.md") continue;
    const auto blocks = testing::blocks_of(testing::read_file(entry.path()));
    if (std::ranges::count(blocks, "sh", &PageBlock::language) > 0) pages.push_back(name);
  }
  std::ranges::sort(pages);
  return pages;
}

INSTANTIATE_TEST_SUITE_P(All, ManualExamples, ::testing::ValuesIn(pages_with_commands()),
                         [](const auto& page) {
                           return page.param.substr(0, page.param.find('.'));
                         });

TEST(PagesWithCommands, AreMost) { EXPECT_GE(pages_with_commands().size(), 38u); }

/// The two of the pendulum.
std::vector<double> joint_accelerations(const std::string& json) {
  const std::string key = "\"joint_accelerations\": [";
  std::istringstream numbers(json.substr(json.find(key) + key.size()));
  std::vector<double> found(2);
  char comma = ' ';
  numbers >> found[0] >> comma >> found[1];
  EXPECT_TRUE(numbers) << json;
  return found;
}

TEST(ComingFrom, TheSameRobotAcceleratesAlike) {
  const Workplace place;
  set_out(place, "coming_from.md");
  const auto ours = joint_accelerations(place.hookpoint("dynamics pendulum.hook --json").out);
  const auto theirs = joint_accelerations(place.hookpoint("dynamics included.hook --json").out);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-9 * std::abs(theirs[i]));
}

}  // namespace
}  // namespace hookpoint
