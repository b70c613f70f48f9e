// The diffs of the pages that tell how to extend hookpoint: what each changes is there, as it
// stands in the page.
// ctest: released
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;

const fs::path source = testing::source_folder();

/// What a diff finds in a file, in one piece.
struct Hunk {
  std::string path;
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Those of files that are not new.
std::vector<Hunk> hunks_of(const std::string& diff) {
  std::vector<Hunk> hunks;
  std::string path;
  for (const std::string& line : lines_of(diff)) {
    if (line.starts_with("--- ")) {
      path = line.starts_with("--- a/") ? line.substr(6) : "";
    } else if (line.starts_with("@@")) {
      hunks.push_back({path, {}});
    } else if (hunks.empty() || line.starts_with("+") || line.starts_with("diff ") ||
               line.starts_with("index ") || line.starts_with("new file")) {
      continue;
    } else {
      hunks.back().lines.push_back(line.empty() ? "" : line.substr(1));
    }
  }
  std::erase_if(hunks, [](const Hunk& hunk) { return hunk.path.empty(); });
  return hunks;
}

TEST(PageDiffs, FitTheFilesThatTheyChange) {
  int pages = 0, hunks = 0;
  for (const auto& entry : fs::directory_iterator(source / "docs")) {
    const std::string page = entry.path().filename();
    if (!page.starts_with("adding_")) continue;
    ++pages;
    for (const testing::PageBlock& block : testing::blocks_of(testing::read_file(entry.path()))) {
      if (block.language != "diff") continue;
      for (const Hunk& hunk : hunks_of(block.text)) {
        ++hunks;
        ASSERT_TRUE(fs::exists(source / hunk.path)) << page << ": " << hunk.path;
        const auto file = lines_of(testing::read_file(source / hunk.path));
        EXPECT_NE(std::ranges::search(file, hunk.lines).begin(), file.end())
            << page << " has other lines than " << hunk.path << ": "
            << ::testing::PrintToString(hunk.lines);
      }
    }
  }
  EXPECT_GE(pages, 6);
  EXPECT_GE(hunks, 10);
}

}  // namespace
}  // namespace hookpoint
