// A study that is killed, at whatever moment, and gone on with: the same bytes as one that was not.
// ctest: long, released
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <regex>
#include <thread>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/kills.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::Workplace;

constexpr const char* study =
    "Study fall { scene = \"scenes/sloped_block.hook\"; duration = 0.25 s; settle = 0.05 s;\n"
    "  Sweep slope { from = 5 deg; to = 40 deg; step = 5 deg; }\n"
    "  Subject ours { engine = dts; } Subject ode { engine = ode; settings = default; }\n"
    "  Measure slip_acceleration; Measure penetration_max; Measure peer_distance;\n"
    "  Plot shift { x = time; y = displacement; Only slope { values = 20 deg; } } }\n";

/// Every file of the folder by its name, without what two equal runs do not share: the date.
std::map<std::string, std::string> files_of(const Workplace& work, const std::string& folder) {
  static const std::regex date("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z");
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(work.folder() / folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(work.folder() / folder);
    std::string text = work.read(entry.path());
    if (name == "provenance.json" || name == "report.html")
      text = std::regex_replace(text, date, "date");
    // The list of hashes has that of the date's file; the store has its runs in the order in which
    // they ended.
    if (name != "files.json" && !name.starts_with("store/")) files[name] = std::move(text);
  }
  return files;
}

class Killed : public ::testing::Test {
 protected:
  /// The study into the folder `cut`.
  ChildProcess start(bool resume) const {
    std::vector<std::string> words{"study", "study.hook", "--jobs", "2", "--out", "cut"};
    if (resume) words.emplace_back("--resume");
    return {work_.folder(), words};
  }
  /// Whether it was killed before it ended.
  static bool kill_after(ChildProcess child, std::chrono::microseconds delay) {
    std::this_thread::sleep_for(delay);
    child.signal(SIGKILL);
    const int status = child.wait();
    EXPECT_TRUE(status == 0 || status == 1000 + SIGKILL) << status << '\n' << child.err();
    return status != 0;
  }
  Workplace work_;
};

// The moments are drawn over the time that a whole run takes; which they are decides nothing.
TEST_F(Killed, AtAnyMomentItEndsInTheSameBytes) {
  constexpr int kills_a_study = 5;
  const int wanted = testing::wanted_kills();
  work_.file("study.hook", study);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(work_.hookpoint("study study.hook --jobs 2 --out whole").status, 0);
  const auto whole_time = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - begin);
  const auto expected = files_of(work_, "whole");
  ASSERT_TRUE(expected.contains("results.csv"));
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> moment(0, whole_time.count());
  int kills = 0, studies = 0;
  for (; kills < wanted && studies < wanted; ++studies) {
    std::filesystem::remove_all(work_.folder() / "cut");
    for (int i = 0; i < kills_a_study; ++i)
      kills += kill_after(start(i > 0), std::chrono::microseconds(moment(random))) ? 1 : 0;
    const auto resumed = work_.hookpoint("study study.hook --jobs 2 --resume --out cut");
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    const auto found = files_of(work_, "cut");
    for (const auto& [name, text] : expected) {
      ASSERT_TRUE(found.contains(name)) << name;
      ASSERT_EQ(found.at(name), text) << name;
    }
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_EQ(work_.hookpoint("compare whole cut --tolerance 0").status, 0);
  }
  EXPECT_GE(kills, wanted) << "in " << studies << " studies";
}

}  // namespace
}  // namespace hookpoint
