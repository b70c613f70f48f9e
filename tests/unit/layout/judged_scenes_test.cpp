// A truth that nothing judges is no truth: every scene with an Expect is one of the Wall of scenes
// (configs/studies/truths.hook) or is run by a test.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;

std::string all_tests() {
  std::string all;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(testing::source_folder() + "/tests"))
    if (entry.path().extension() == ".cpp") all += testing::read_file(entry.path());
  return all;
}

TEST(JudgedScenes, AreAllThatStateATruth) {
  const fs::path configs = fs::path(testing::source_folder()) / "configs";
  const std::string wall = testing::read_file(configs / "studies/truths.hook");
  const std::string tests = all_tests();
  int scenes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(configs / "scenes")) {
    if (testing::read_file(entry.path()).find("\nExpect ") == std::string::npos) continue;
    ++scenes;
    const std::string name = entry.path().stem().string();
    const bool judged = wall.find("  Scene " + name + " {") != std::string::npos ||
                        tests.find(name + ".hook") != std::string::npos;
    EXPECT_TRUE(judged) << entry.path().filename();
  }
  EXPECT_GT(scenes, 40);
}

}  // namespace
}  // namespace hookpoint
