// docs/tutorial.md as a newcomer follows it: its files are written, its commands typed in, in the
// order of the page, and what it says comes true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"

namespace hookpoint {
namespace {

using testing::blocks_of;
using testing::Workplace;
namespace fs = std::filesystem;

const fs::path source = testing::source_folder();

/// `hookpoint view`, which goes on until somebody ends it, is ended once its page can be opened.
constexpr const char* watched_briefly = R"(hookpoint() {
  if [ "$1" != view ]; then command hookpoint "$@"; return; fi
  command hookpoint "$@" --no-open >address &
  until [ -s address ]; do kill -0 $!; sleep 0.05; done
  kill -TERM $!
  wait $!
  rm address
}
)";

/// The page as one script for a shell: a named block is a file of the folder reached by then.
std::string script_of(const std::vector<testing::PageBlock>& blocks) {
  std::string script =
      std::string("set -euxo pipefail\nunset HOOKPOINT_TRUSTED_PLUGINS\n") + watched_briefly;
  for (const testing::PageBlock& block : blocks) {
    script += block.language == "sh"
                  ? block.text
                  : "cat >'" + block.name + "' <<'END OF BLOCK'\n" + block.text + "END OF BLOCK\n";
  }
  const std::string build = "build/release";
  return script.replace(script.find(build), build.size(), "'" + testing::build_folder() + "'");
}

/// Column `index` of a CSV file with a line of titles.
std::vector<double> column(const std::string& text, std::size_t index) {
  std::vector<double> values;
  std::istringstream lines(text.substr(text.find('\n') + 1));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t i = 0; i <= index; ++i) std::getline(cells, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

class Tutorial : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new Workplace;
    const std::vector<testing::PageBlock> blocks =
        blocks_of(place_->read(source / "docs/tutorial.md"));
    for (const testing::PageBlock& block : blocks)
      EXPECT_TRUE(block.language == "sh" || !block.name.empty()) << block.text;
    place_->file("script", script_of(blocks));
    const std::string folder = place_->folder().string();
    status_ = std::system(("cd '" + source.string() + "' && HOME='" + folder + "' bash '" + folder +
                           "/script' >'" + folder + "/log' 2>&1")
                              .c_str());
  }
  static void TearDownTestSuite() { delete place_; }
  void SetUp() override { ASSERT_EQ(status_, 0) << place_->read("log"); }

  static Workplace* place_;
  static int status_;
};
Workplace* Tutorial::place_ = nullptr;
int Tutorial::status_ = -1;

TEST_F(Tutorial, WithoutAControllerItSinksToTheGround) {
  const std::vector<double> height = column(place_->read("two_legs/limp/trace.csv"), 1);
  EXPECT_GT(height.front(), 0.35);
  EXPECT_LT(height.back(), 0.15);
}

TEST_F(Tutorial, WhatWasMovedByHandIsRepeated) {
  const std::vector<double> again = column(place_->read("two_legs/again/trace.csv"), 1),
                            limp = column(place_->read("two_legs/limp/trace.csv"), 1);
  EXPECT_NEAR(again.back(), 0.25, 0.005) << "the page says so";
  EXPECT_NEAR(limp.at(again.size() - 1), 0.19, 0.005);
  EXPECT_EQ(place_->read("two_legs/again/changes.csv"), place_->read("two_legs/changes.csv"));
}

TEST_F(Tutorial, WithItItSquatsAsItSays) {
  const std::string record = place_->read("two_legs/result/motion.csv");
  EXPECT_EQ(record.substr(0, record.find('\n')),
            "time [s],yard.biped.position.z [m],squat.bend [rad],yard.biped.leg[0].shank.angle "
            "[rad],yard.biped.leg[0].foot.contact.force.z [N]");
  const std::vector<double> time = column(record, 0), height = column(record, 1),
                            bend = column(record, 2), knee = column(record, 3);
  ASSERT_EQ(time.size(), 801U);
  const auto [low, high] = std::ranges::minmax(height);
  EXPECT_NEAR(high - low, 0.11, 0.005) << "the page says so";
  for (std::size_t i = 100; i < time.size(); ++i)
    EXPECT_NEAR(knee[i], 2. * bend[i], 0.05) << "at " << time[i] << " s";
  EXPECT_NEAR(*std::ranges::max_element(bend), 50. * M_PI / 180., 1e-3);
}

TEST_F(Tutorial, TheStudyIsTheOneThatIsShippedAndSaysWhatThePageSays) {
  const std::vector<testing::PageBlock> blocks =
      blocks_of(place_->read(source / "docs/tutorial.md"));
  const auto shown = std::ranges::find(blocks, "foot_drop.hook", &testing::PageBlock::name);
  ASSERT_NE(shown, blocks.end());
  EXPECT_EQ(shown->text, place_->read(source / "configs/studies/foot_drop.hook"));
  EXPECT_LT(std::ranges::count(shown->text, '\n'), 50);
  const std::string table = place_->read("two_legs/foot_drop/depth.csv");
  EXPECT_NE(table.find("hookpoint,clay,10.93"), std::string::npos) << table;
}

TEST_F(Tutorial, ThePlotShowsTheCurves) {
  const std::string plot = place_->read("two_legs/squat.svg");
  EXPECT_NE(plot.find("</svg>"), std::string::npos);
  for (const char* title : {"body", "knee, wanted", "height [m]", "time [s]"})
    EXPECT_NE(plot.find(title), std::string::npos) << title;
}

TEST_F(Tutorial, TheControllerMayRunAtHalfTheRateButNotAtAQuarter) {
  const auto times = [](const char* folder) {
    return column(place_->read(std::string("two_legs/") + folder + "/motion.csv"), 0);
  };
  EXPECT_EQ(times("often").back(), 8.);
  const std::vector<double> height = column(place_->read("two_legs/often/motion.csv"), 1);
  EXPECT_NEAR(std::ranges::max(height) - std::ranges::min(height), 0.11, 0.005);
  EXPECT_LT(times("seldom").back(), 0.1);
  EXPECT_NE(place_->read("log").find("it was not often enough"), std::string::npos);
  EXPECT_NE(place_->read("log").find("the run stopped at 0.0"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint
