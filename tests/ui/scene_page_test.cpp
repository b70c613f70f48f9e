// The scene of docs/adding_a_scene.md, run as it stands there: its truths hold under every law that
// they cover.
#include <gtest/gtest.h>

#include <algorithm>

#include "contact/force_law.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"

namespace hookpoint {
namespace {

std::string scene_of_page() {
  const std::string page = testing::read_file(std::filesystem::path(testing::source_folder()) /
                                              "docs/adding_a_scene.md");
  const auto blocks = testing::blocks_of(page);
  const auto found = std::ranges::find(blocks, "hook", &testing::PageBlock::language);
  return found == blocks.end() ? "" : found->text;
}

TEST(SceneOfThePage, ShowsWhatItSays) {
  const testing::Workplace place;
  const std::string scene = place.file("uphill_point.hook", scene_of_page());
  int truths = 0;
  for (const std::string& law : contact::law_names()) {
    const auto run = place.hookpoint("run " + scene + " --contact " + law);
    EXPECT_EQ(run.status, 0) << law << ": " << run.out << run.err;
    truths += run.out.find(" way ") != std::string::npos;
    truths += run.out.find(" stays ") != std::string::npos;
  }
  EXPECT_EQ(truths, 14);
}

}  // namespace
}  // namespace hookpoint
