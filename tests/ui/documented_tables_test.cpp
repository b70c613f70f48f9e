// Tables of the manual that are made of results are those of this program.
// ctest: long, released, full
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

/// The first engine that is not on this machine, linked or a program; "" where all are.
std::string missing_engine(const testing::Workplace& work) {
  std::istringstream lines(work.hookpoint("engines").out);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.empty()) {
    std::istringstream words(line);
    std::string name, version, precision, found;
    words >> name >> version >> precision >> found;
    if (found != "yes") return name;
  }
  return "";
}

TEST(DocumentedTables, TheCreepOfEveryPeerIsThatOfItsStudy) {
  const testing::Workplace work;
  if (const std::string missing = missing_engine(work); !missing.empty())
    GTEST_SKIP() << "engine " << missing << " is not found";
  const std::string results = "'" + (work.folder() / "results").string() + "'";
  const std::string output = " >'" + (work.folder() / "out").string() + "' 2>&1";
  const std::string program = "'" + testing::build_folder() + "/hookpoint'";
  const std::string run = program + " study '" + testing::source_folder() +
                          "/configs/studies/peer_creep.hook' --out " + results + output;
  ASSERT_EQ(std::system(run.c_str()), 0) << work.read("out");
  for (const std::string table : {"peer_creep", "readme_creep"}) {
    const std::string check = "'" + testing::source_folder() +
                              "/docs/make/documented_tables' --check " + table + " " + results +
                              output;
    EXPECT_EQ(std::system(check.c_str()), 0) << table << "\n" << work.read("out");
  }
}

TEST(DocumentedTables, TheScoresOfTheFixtureAreThoseOfTheCommand) {
  const testing::Workplace work;
  if (const std::string missing = missing_engine(work); !missing.empty())
    GTEST_SKIP() << "engine " << missing << " is not found";
  const auto checked =
      work.run("HOOKPOINT='" + testing::build_folder() + "/hookpoint' '" +
               testing::source_folder() + "/docs/make/documented_tables' --check fixture");
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST(DocumentedTables, TheWalksOnSevenGroundsAreThoseOfTheirStudy) {
  const testing::Workplace work;
  const std::string command = "HOOKPOINT='" + testing::build_folder() + "/hookpoint' '" +
                              testing::source_folder() +
                              "/docs/make/documented_tables' --check terrains >'" +
                              (work.folder() / "out").string() + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << work.read("out");
}

TEST(DocumentedTables, TheTunedGroundsAreThoseOfTheirMaterials) {
  const testing::Workplace work;
  const std::string command = "'" + testing::source_folder() +
                              "/docs/papers/terrains/make.py' --check >'" +
                              (work.folder() / "out").string() + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << work.read("out");
}

}  // namespace
}  // namespace hookpoint
