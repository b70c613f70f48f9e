// The layout is the architecture: no folder includes one that it must not see (ARCHITECTURE: four
// floors, no arrow up).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace {

using Folders = std::set<std::string>;

const std::map<std::string, Folders> may_include{
    {"math", {}},
    {"dts", {"math"}},
    {"contact", {"math"}},
    {"integrators", {"math"}},
    {"language", {"math"}},
    {"control", {"math"}},
    {"output", {"math"}},
    {"simulation", {"math", "dts", "contact", "integrators", "language", "control", "output"}},
    {"reference", {"math", "contact", "simulation"}},
    {"studies", {"math", "contact", "integrators", "language", "output", "simulation"}},
    {"view", {"math", "language", "output", "simulation"}},
    {"examples", {"control"}},
    {"cli",
     {"math", "dts", "contact", "integrators", "language", "control", "output", "simulation",
      "reference", "studies", "view"}},
    {"python", {"language", "output", "simulation", "studies", "cli"}},
};

std::string folder_of_include(const std::string& line) {
  const std::string opening = "#include \"";
  if (line.rfind(opening, 0) != 0) return "";
  const std::size_t slash = line.find('/', opening.size());
  return slash == std::string::npos ? "(none)"
                                    : line.substr(opening.size(), slash - opening.size());
}

TEST(Layering, EveryIncludeGoesDown) {
  const std::filesystem::path root = HOOKPOINT_SOURCE_DIR;
  int includes = 0;
  for (const auto& [folder, allowed] : may_include) {
    if (!std::filesystem::exists(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        const std::string included = folder_of_include(line);
        if (included.empty() || included == folder) continue;
        ++includes;
        EXPECT_TRUE(allowed.count(included))
            << entry.path() << " includes " << included << "/: " << line;
      }
    }
  }
  EXPECT_GT(includes, 50);
}

}  // namespace
