// Every link of a page to a file of the project leads somewhere.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;

bool is_of_the_project(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name != "build" && name != "runs" && name != "node_modules" && name != ".git";
}

TEST(Links, LeadToFilesThatExist) {
  const std::regex link(R"(\]\(([^)\s#]+)[^)\s]*\))");
  int links = 0;
  for (auto entry = fs::recursive_directory_iterator(testing::source_folder());
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory()) {
      if (!is_of_the_project(entry->path())) entry.disable_recursion_pending();
      continue;
    }
    if (entry->path().extension() != ".md") continue;
    const std::string text = testing::read_file(entry->path());
    for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found) {
      const std::string target = (*found)[1];
      if (target.find("://") != std::string::npos || target.rfind("mailto:", 0) == 0) continue;
      ++links;
      EXPECT_TRUE(fs::exists(entry->path().parent_path() / target))
          << entry->path().lexically_relative(testing::source_folder()) << " links to " << target;
    }
  }
  EXPECT_GT(links, 200);
}

}  // namespace
}  // namespace hookpoint
