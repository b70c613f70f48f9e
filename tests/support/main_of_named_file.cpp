// A program of several tests' files runs those of the file that it is called by: dts_dense_test
// those of dts_dense_test.cpp or of dts/dense_test.cpp. Called by a name that is none of its
// files', it runs them all. Tests in a header belong to no file: a program of such is not called by
// a file's name (it says `// ctest: alone`).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

/// Whether the tests of `file` have this name, with or without the folder before it.
bool is_named(const std::filesystem::path& file, const std::string& name) {
  return file.filename() == name ||
         file.parent_path().filename().string() + "_" + file.filename().string() == name;
}

}  // namespace

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  const std::string wanted = std::filesystem::path(arguments[0]).stem().string() + ".cpp";
  const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
  std::string own, others, in_a_header;
  bool several = false;
  for (int i = 0; i < tests.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *tests.GetTestSuite(i);
    std::string parts[2];  // of other files, of this one
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      const std::filesystem::path file = test.file();
      if (file.extension() != ".cpp") {
        in_a_header = test.file();
      } else if (!is_named(file, wanted)) {
        several = true;
      }
      parts[is_named(file, wanted)] += std::string(suite.name()) + "." + test.name() + ":";
    }
    const std::string whole = std::string(suite.name()) + ".*:";
    if (!parts[1].empty()) own += parts[0].empty() ? whole : parts[1];
    if (!parts[0].empty()) others += parts[1].empty() ? whole : parts[0];
  }
  if (!own.empty() && several) {
    if (!in_a_header.empty()) {
      std::fprintf(stderr,
                   "%s has tests of its own: a test that includes it says `// ctest: alone`\n",
                   in_a_header.c_str());
      return 2;
    }
    // What follows the first `-` of a filter is left out.
    const std::string asked = GTEST_FLAG_GET(filter);
    const bool all = asked == "*";
    GTEST_FLAG_SET(filter,
                   all ? own : asked + (asked.find('-') == std::string::npos ? "-" : ":") + others);
  }
  return RUN_ALL_TESTS();
}
