// Record in a file, as a user meets it: files of a run, what an interrupt and a full disk leave,
// and what is said of mistakes.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/command.h"
#include "tests/support/record_scene.h"

namespace hookpoint {
namespace {

constexpr const char* falling = R"(World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.1;
  Robot ball[1] {
    Base.mobile { location = 0,0,100; mass = 1; inertia = 1,1,1,0,0,0; }
  }
  RECORDS
}
)";

std::string scene(const std::string& records) {
  std::string text = falling;
  return text.replace(text.find("RECORDS"), 7, records);
}

std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(RecordCommand, ChannelsAreAnnotatedFromTheSchema) {
  const testing::Workplace place;
  place.file("run.hook",
             scene("Record fall { trails = ball[1].base.velocity, time; rate = 50 Hz; }"));
  const testing::CommandResult result = place.hookpoint("run run.hook --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string table = place.read("out/fall.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "time [s],w.ball[1].base.velocity.x [m/s],w.ball[1].base.velocity.y [m/s],"
            "w.ball[1].base.velocity.z [m/s],w.time [s]");
  EXPECT_EQ(lines(table), 1 + 6) << "0, 20, ... 100 ms";
  // Free fall: v = -g t at t = 0.1 s.
  const std::string last = table.substr(table.rfind('\n', table.size() - 2) + 1);
  EXPECT_EQ(last.substr(0, 4), "0.1,");
  EXPECT_NEAR(std::stod(last.substr(8)), -0.981, 1e-12) << last;
  const std::string channels = place.read("out/fall.channels.csv");
  EXPECT_NE(channels.find("w.ball[1].base.velocity.z,m/s,double,-inf,inf,"), std::string::npos)
      << channels;
  EXPECT_NE(place.read("out/fall.record.csv").find("engine,dts"), std::string::npos);
}

TEST(RecordCommand, MistakesAreSaidTogetherAndNothingIsWritten) {
  const testing::Workplace place;
  place.file("run.hook", scene("Record a { trails = ball[1].base.velocty, ball[1], time, time; }\n"
                               "Record b { trails = time; file = \"a.csv\"; }"));
  const testing::CommandResult result = place.hookpoint("run run.hook --out out");
  EXPECT_EQ(result.status, 2);
  for (const char* said : {"did you mean `velocity`", "`ball[1]` is no number",
                           "`w.time` is recorded twice", "another Record writes `a.csv`"})
    EXPECT_NE(result.err.find(said), std::string::npos) << said << "\n" << result.err;
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "out"));
}

TEST(RecordCommand, FullDiskIsSaid) {
  const testing::Workplace place;
  place.file("run.hook", scene("Record fall { trails = time; }"));
  const testing::FileSizeLimit full(20'000);
  const testing::CommandResult result = place.hookpoint("run run.hook --for 100s --out out");
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("cannot write out/fall.csv.partial: File too large (the limit of file "
                            "sizes, `ulimit -f`), at "),
            std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("rows are kept in out/fall.csv.partial"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint
