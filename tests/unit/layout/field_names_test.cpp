// A block of the language names each of its fields once, where it declares it (language/tree/
// fields.h): no other line of studies/ reads a field by its name.
// ctest: released
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "tests/support/folders.h"

namespace {

/// `block.number("tolerance")`; of a member function without a field's name nothing.
bool reads_by_name(const std::string& line) {
  static const std::regex read(
      R"re((\.|->)(find|given|number|numbers|word|object|boolean)\("[a-z][a-z_]*"\))re");
  return std::regex_search(line, read);
}

TEST(FieldNames, AReadByNameIsRecognised) {
  EXPECT_TRUE(reads_by_name("  truth.tolerance = block.number(\"tolerance\");"));
  EXPECT_TRUE(reads_by_name("  if (field->given(\"quick_values\")) return;"));
  EXPECT_FALSE(reads_by_name("  const auto at = text.find(\" or \");"));
  EXPECT_FALSE(reads_by_name("  schema.find(\"World\");"));
  EXPECT_FALSE(reads_by_name("  number_field(\"tolerance\", \"\", &Truth::tolerance, \"\")"));
}

TEST(FieldNames, NoLineOfStudiesReadsAFieldByItsName) {
  int files = 0;
  const std::filesystem::path root = hookpoint::testing::source_folder();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "studies")) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    ++files;
    std::ifstream file(entry.path());
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      EXPECT_FALSE(reads_by_name(line))
          << entry.path().lexically_relative(root).string() << ":" << number << ": " << line;
    }
  }
  EXPECT_GT(files, 50);
}

}  // namespace
