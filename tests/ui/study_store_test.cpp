// What becomes of a study's runs when its disk is full, its store broken, held or another's; and
// runs that several studies have in common.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/record_scene.h"
#include "tests/support/store_file.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::Workplace;

class StudyStore : public ::testing::Test {
 protected:
  StudyStore() { work_.file("study.hook", study("fall", "penetration_max", "40 deg")); }
  static std::string study(const std::string& name, const std::string& metric,
                           const std::string& to) {
    return "Study " + name + " { scene = \"scenes/sloped_block.hook\"; duration = 0.1 s;\n" +
           "  settle = 0.05 s; Sweep slope { from = 5 deg; to = " + to +
           "; step = 5 deg; }\n  Subject ours { engine = dts; } Measure " + metric +
           "; Plot shift { x = time; y = displacement; } }\n";
  }
  fs::path store(const std::string& folder) const {
    return work_.folder() / folder / "store/runs.sqlite";
  }
  void expect_told(const CommandResult& result, const std::string& what) const {
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find("hookpoint: error: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  }
  Workplace work_;
};

TEST_F(StudyStore, OfAFullDiskKeepsTheRunsAndGoesOn) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out whole").status, 0);
  int met = 0;
  for (const rlim_t bytes : {1000, 20'000, 60'000, 100'000}) {
    fs::remove_all(work_.folder() / "s");
    {
      const testing::FileSizeLimit full(bytes);
      const CommandResult result = work_.hookpoint("study study.hook --out s");
      if (result.status == 0) continue;
      ++met;
      expect_told(result, "s/");
    }
    const CommandResult resumed = work_.hookpoint("study study.hook --out s --resume");
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(resumed.err.find("run again"), std::string::npos) << resumed.err;
    EXPECT_EQ(work_.read("s/results.csv"), work_.read("whole/results.csv"));
  }
  EXPECT_GE(met, 2);
}

TEST_F(StudyStore, ThatIsBrokenIsLeftAndTold) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out s").status, 0);
  const std::string table = work_.read("s/results.csv");
  const std::string whole = testing::read_file(store("s"));
  // The header, a page of an index, a table's root.
  for (const std::size_t place : {std::size_t{3}, std::size_t{4096}, whole.size() / 2}) {
    std::string broken = whole;
    broken.replace(place, 64, std::string(64, '\xa5'));
    std::ofstream(store("s"), std::ios::binary) << broken;
    const CommandResult result = work_.hookpoint("study study.hook --out s --resume");
    if (result.status == 0) {
      // Damage within a run: that run was made again.
      EXPECT_EQ(work_.read("s/results.csv"), table);
    } else {
      expect_told(result, "move it away, or name another folder with --out");
      EXPECT_EQ(testing::read_file(store("s")), broken) << "left as it is";
    }
  }
  const fs::path away = work_.folder() / "away.sqlite";
  fs::rename(store("s"), away);
  EXPECT_EQ(work_.hookpoint("study study.hook --out s --resume").status, 0);
  EXPECT_EQ(work_.read("s/results.csv"), table);
}

TEST_F(StudyStore, OfAnotherVersionIsLeftAndTold) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out s").status, 0);
  testing::alter_database(store("s"), "PRAGMA user_version = 2");
  for (const char* resume : {"", " --resume"})
    expect_told(work_.hookpoint(std::string("study study.hook --out s") + resume),
                "is a store of another version of hookpoint");
  testing::alter_database(store("s"), "PRAGMA user_version = 1");
  EXPECT_EQ(work_.hookpoint("study study.hook --out s --resume").status, 0);
}

TEST_F(StudyStore, ThatAnotherProgramHoldsIsTold) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out s").status, 0);
  {
    const testing::HeldDatabase held(store("s"));
    expect_told(work_.hookpoint("study study.hook --out s --resume"),
                "wait for the program that has it open");
  }
  EXPECT_EQ(work_.hookpoint("study study.hook --out s --resume").status, 0);
}

TEST_F(StudyStore, IsReadByAnyToolAfterwards) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out s").status, 0);
  EXPECT_EQ(testing::number_in_database(store("s"),
                                        "SELECT count(*) FROM assignment JOIN run USING(identity) "
                                        "WHERE study = 'fall' AND numbers LIKE 'status ok%'"),
            8);
}

// The runs of the second are those of the first, and one more; the folder is of both.
TEST_F(StudyStore, IsSharedByTheStudiesOfAFolder) {
  work_.file("both.hook", study("one", "penetration_max", "40 deg") +
                              study("other", "penetration_max", "45 deg"));
  ASSERT_EQ(work_.hookpoint("study both.hook --jobs 1 --out both").status, 0);
  EXPECT_FALSE(fs::exists(work_.folder() / "both/one/store"));
  const fs::path shared = store("both");
  EXPECT_EQ(testing::number_in_database(shared, "SELECT count(*) FROM run"), 9);
  EXPECT_EQ(testing::number_in_database(shared, "SELECT count(*) FROM assignment"), 17);
  work_.file("other.hook", study("other", "penetration_max", "45 deg"));
  ASSERT_EQ(work_.hookpoint("study other.hook --out alone").status, 0);
  EXPECT_EQ(work_.read("both/other/results.csv"), work_.read("alone/results.csv"));
  const CommandResult again = work_.hookpoint("study both.hook --out both --resume");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(work_.read("both/other/results.csv"), work_.read("alone/results.csv"));
}

// Two at once, of the same folder: one is told, and the bytes are those of one alone.
TEST_F(StudyStore, OfTwoWritersOneWaits) {
  ASSERT_EQ(work_.hookpoint("study study.hook --out whole").status, 0);
  Workplace beside;
  for (const char* folder : {"s", "both"}) {
    const std::string file = folder == std::string("s") ? "study.hook" : "both.hook";
    if (file == "both.hook")
      work_.file(file, study("one", "penetration_max", "40 deg") +
                           study("other", "penetration_max", "45 deg"));
    const std::string out = (work_.folder() / folder).string();
    testing::ChildProcess first(work_.folder(), {"study", file, "--out", folder});
    testing::ChildProcess second(beside.folder(),
                                 {"study", (work_.folder() / file).string(), "--out", out});
    const int one = first.wait(), other = second.wait();
    EXPECT_TRUE(one == 0 || other == 0) << first.err() << second.err();
    for (const int status : {one, other}) EXPECT_TRUE(status >= 0 && status <= 2) << status;
    const auto resumed = work_.hookpoint("study " + file + " --resume --out " + folder);
    EXPECT_EQ(resumed.status, 0) << resumed.err;
  }
  EXPECT_EQ(work_.read("s/results.csv"), work_.read("whole/results.csv"));
}

}  // namespace
}  // namespace hookpoint
