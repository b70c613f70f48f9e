// Every file in configs/ evaluates; every one that holds a World loads.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

std::vector<std::filesystem::path> config_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(testing::source_folder()) / "configs")) {
    // Studies and engines have classes of their own, which their own tests know.
    const auto folder = entry.path().parent_path().filename();
    const bool other = folder == "studies" || folder == "tunings" || folder == "engines" ||
                       entry.path().filename() == "scenes.hook";
    if (entry.path().extension() == ".hook" && !other) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Whether another file of configs/, or a test that writes its scene itself, lays `module` down.
bool is_included(const std::filesystem::path& module) {
  std::vector<std::filesystem::path> files = config_files();
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(testing::source_folder()) / "tests" / "truth")) {
    files.push_back(entry.path());
  }
  const std::string name = module.parent_path().filename() / module.filename();
  return std::ranges::any_of(files, [&](const std::filesystem::path& file) {
    return testing::read_file(file).find(name) != std::string::npos;
  });
}

/// A robot that lies on its scene's ground.
bool rests_on_its_scene(const std::filesystem::path& module) {
  return module.parent_path().filename() == "robots" &&
         testing::read_file(module).find("rest_on = ground;") != std::string::npos;
}

class EveryConfig : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryConfig, Loads) {
  const std::string folder = GetParam().parent_path().filename();
  if (folder == "controllers" || rests_on_its_scene(GetParam())) {
    // What reaches into what it is laid down beside (wires into a robot) is checked in the scene
    // that includes it.
    EXPECT_TRUE(is_included(GetParam())) << GetParam() << " stands in no scene";
    return;
  }
  const bool is_world = folder == "scenes" || folder == "paper" || folder == "views" ||
                        folder == "fixture" || folder == "parts" ||
                        (folder == "starters" && GetParam().stem() != "study");
  const Loaded loaded = load_file(GetParam());
  if (is_world) {
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(loaded.diagnostics.find("error"), std::string::npos) << loaded.diagnostics;
  } else {
    // A module describes a part: all that is missing is a World around it.
    EXPECT_NE(loaded.diagnostics.find("there is no World in this file"), std::string::npos)
        << loaded.diagnostics;
  }
}

std::string test_name(const ::testing::TestParamInfo<std::filesystem::path>& info) {
  std::string name =
      info.param.parent_path().filename().string() + "_" + info.param.stem().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Configs, EveryConfig, ::testing::ValuesIn(config_files()), test_name);

}  // namespace
}  // namespace hookpoint
