// Words that docs/style.md replaces by the field's are in no header, no message and no page.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/folders.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
const fs::path source = testing::source_folder();

/// Patterns of the third column of docs/style.md's glossary, joined to one.
std::string patterns_of_glossary() {
  const std::string page = testing::read_file(source / "docs/style.md");
  const std::string table = page.substr(page.find("| never | instead | pattern |"));
  const std::regex pattern(R"(\| `([^`]+)` \|)");
  std::string all;
  for (std::sregex_iterator row(table.begin(), table.end(), pattern), end; row != end; ++row) {
    all +=
        (all.empty() ? "" : "|") + std::regex_replace((*row)[1].str(), std::regex(R"(\\\|)"), "|");
  }
  return all;
}

/// What users and developers read of a file: all of a header; the string literals of a source that
/// are more than a word (a single one is the name of a column or of a member of JSON); a page
/// without its code. Line by line.
std::vector<std::string> readable_lines(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  const std::regex literal(R"re("([^"\\]|\\.)*")re");
  bool code = false;
  for (std::string line; std::getline(in, line);) {
    std::string read;
    if (file.extension() == ".h") {
      read = line;
    } else if (file.extension() == ".cpp") {
      for (std::sregex_iterator text(line.begin(), line.end(), literal), end; text != end; ++text)
        if (text->str().find(' ') != std::string::npos) read += text->str() + " ";
    } else {
      if (line.starts_with("```")) code = !code;
      if (!code && !line.starts_with("    "))
        read = std::regex_replace(line, std::regex("`[^`]*`|\\]\\([^)]*\\)"), "");
    }
    lines.push_back(read);
  }
  return lines;
}

TEST(Glossary, ItsWordsAreNowhere) {
  const std::string all = patterns_of_glossary();
  ASSERT_NE(all, "");
  const std::regex words(all, std::regex::icase);
  EXPECT_TRUE(std::regex_search("an error is told", words));
  int files = 0;
  for (const std::string folder :
       {"apps", "contact", "control", "docs", "dts", "integrators", "language", "math", "output",
        "reference", "simulation", "studies", "text"}) {
    for (auto entry = fs::recursive_directory_iterator(source / folder);
         entry != fs::recursive_directory_iterator(); ++entry) {
      const fs::path path = entry->path();
      const std::string name = path.filename();
      if (name == "node_modules" || name == "decisions") entry.disable_recursion_pending();
      if (name == "style.md" ||
          (path.extension() != ".h" && path.extension() != ".cpp" && path.extension() != ".md"))
        continue;
      ++files;
      int number = 0;
      for (const std::string& line : readable_lines(path)) {
        ++number;
        std::smatch found;
        EXPECT_FALSE(std::regex_search(line, found, words))
            << path.lexically_relative(source).string() << ":" << number << ": " << found.str();
      }
    }
  }
  EXPECT_GT(files, 500);
}

}  // namespace
}  // namespace hookpoint
