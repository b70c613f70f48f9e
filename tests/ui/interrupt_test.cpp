// The interrupt key at known moments: what is kept, what is said, and the exit status.
// ctest: clock
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/record_scene.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::Workplace;
namespace fs = std::filesystem;

constexpr const char* falling = R"(World w {
  gravity = 9.81; deltat = 1 ms; duration = 1e6;
  Robot ball { Base.mobile { location = 0, 0, 100; mass = 1; inertia = 1, 1, 1, 0, 0, 0; } }
  Record fall { trails = time; format = wl; }
}
)";

/// Two studies of one file, each of far too many steps.
constexpr const char* endless =
    R"(Study first { scene = "run.hook"; duration = 100000 s; settle = 0 s;
  Measure slip_distance; Subject dts { engine = dts; } }
Study second { scene = "run.hook"; duration = 100000 s; settle = 0 s;
  Measure slip_distance; Subject dts { engine = dts; } }
)";

constexpr const char* block = R"(World w {
  Terrain.Flat ground;
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = .2, .2, .1; mass = 1; } } }
}
)";

bool is_larger(const fs::path& file, std::uintmax_t size) {
  std::error_code none;
  const std::uintmax_t found = fs::file_size(file, none);
  return !none && found > size;
}

/// Puts the plugin of Test.Stalls, whose step does not end, beside the files.
void put_stalling_plugin(const Workplace& place) {
  fs::copy_file(fs::path(testing::build_folder()) / "tests/plugins/libplugin_stalls.so",
                place.folder() / "libstalls.so");
}

class Interrupt : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_P(Interrupt, OfARunKeepsWhatWasRecorded) {
  const Workplace place;
  place.file("run.hook", falling);
  ChildProcess run(place.folder(), {"run", "run.hook", "--out", "out", "--record", "w.time"});
  ASSERT_TRUE(run.wait_until([&] {
    return is_larger(place.folder() / "out/trace.csv.partial", 20'000);
  })) << run.err();
  run.signal(GetParam());
  EXPECT_EQ(run.wait(), 128 + GetParam());
  EXPECT_NE(run.err().find("interrupted at "), std::string::npos) << run.err();
  EXPECT_NE(place.read("out/fall.wl").find("\"complete\"->True|>"), std::string::npos);
  EXPECT_TRUE(place.read("out/trace.csv").ends_with('\n'));
}

TEST_P(Interrupt, OfAStepThatDoesNotEndKeepsTheRowsBefore) {
  const Workplace place;
  put_stalling_plugin(place);
  place.file("run.hook", "Plugin \"libstalls.so\";\n" + std::string(falling) +
                             "Test.Stalls stalls { at = 49.5 ms; }\nMovie film;\n");
  ChildProcess run(place.folder(),
                   {"run", "run.hook", "--out", "out", "--record", "w.time", "--allow-plugins"});
  ASSERT_TRUE(run.wait_until([&] { return run.err().find("stalled") != std::string::npos; }))
      << run.err();
  run.signal(GetParam());
  EXPECT_EQ(run.wait(), 128 + GetParam());
  EXPECT_NE(run.err().find("interrupted at 0.049 s, within a step that does not end"),
            std::string::npos)
      << run.err();
  const std::string trace = place.read("out/trace.csv");
  EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 1 + 50) << "0, 1, ... 49 ms";
  EXPECT_NE(place.read("out/fall.wl").find("\"complete\"->True|>"), std::string::npos);
  const auto film = place.hookpoint("replay out/film.h5 --allow-plugins --about");
  EXPECT_NE(film.out.find("complete"), std::string::npos) << film.err;
  EXPECT_NE(film.out.find("0 s to 0.049 s"), std::string::npos) << film.out;
}

TEST_P(Interrupt, ASecondOneEndsAtOnce) {
  const Workplace place;
  put_stalling_plugin(place);
  place.file("block.hook", "Plugin \"libstalls.so\";\n" + std::string(block) +
                               "Test.Stalls stalls { at = 49.5 ms; }\n");
  place.file("study.hook",
             "Study s { scene = \"block.hook\"; duration = 1 s; settle = 0 s; Measure "
             "slip_distance; Subject dts { engine = dts; } }");
  // A study ends between steps: of the first interrupt nothing is seen here.
  ChildProcess study(place.folder(), {"study", "study.hook", "--out", "out", "--allow-plugins"});
  ASSERT_TRUE(study.wait_until([&] { return study.err().find("stalled") != std::string::npos; }))
      << study.err();
  // Two that come together count as one: again, until it ends.
  study.wait_until([&] {
    study.signal(GetParam());
    return false;
  });
  EXPECT_EQ(study.wait(), 128 + GetParam());
}

// As in the background of a script.
TEST(IgnoredInterrupt, StaysIgnored) {
  const Workplace place;
  place.file("run.hook", falling);
  ChildProcess run(place.folder(), {"run", "run.hook", "--out", "out", "--record", "w.time"},
                   {SIGINT});
  const fs::path trace = place.folder() / "out/trace.csv.partial";
  ASSERT_TRUE(run.wait_until([&] { return is_larger(trace, 20'000); })) << run.err();
  run.signal(SIGINT);
  run.signal(SIGINT);
  const std::uintmax_t size = fs::file_size(trace);
  ASSERT_TRUE(run.wait_until([&] { return is_larger(trace, size + 20'000); })) << run.err();
  run.signal(SIGTERM);
  EXPECT_EQ(run.wait(), 128 + SIGTERM);
}

// As a full disk: `ulimit -f` is no signal that ends the program without a word.
TEST(FileSizeLimit, IsSaidAndWhatIsThereStays) {
  const Workplace place;
  place.file("run.hook", falling);
  place.file("block.hook", block);
  place.file("study.hook",
             "Study s { scene = \"block.hook\"; duration = 0.1 s; Measure slip_distance; "
             "seeds = 200; Subject dts { engine = dts; contact = hookpoint; } }");
  const auto limited = [&](const std::vector<std::string>& words, int status) {
    const testing::FileSizeLimit limit(60'000);
    ChildProcess process(place.folder(), words);
    EXPECT_EQ(process.wait(), status) << words.front() << process.err();
    EXPECT_NE(process.err().find("`ulimit -f`"), std::string::npos) << process.err();
  };
  limited({"run", "run.hook", "--out", "out", "--record", "w.time"}, 3);
  EXPECT_TRUE(place.read("out/trace.csv.partial").starts_with("time [s]"));
  limited({"study", "study.hook", "--out", "study", "--jobs", "1"}, 1);
  const testing::CommandResult resumed =
      place.hookpoint("study study.hook --resume --out study --jobs 1");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
}

TEST(InterruptedStudy, BeginsNoOther) {
  const Workplace place;
  place.file("run.hook", block);
  place.file("study.hook", endless);
  ChildProcess study(place.folder(), {"study", "study.hook", "--out", "out", "--jobs", "1"});
  ASSERT_TRUE(study.wait_until([&] { return fs::exists(place.folder() / "out/first/files.json"); }))
      << study.err();
  study.signal(SIGINT);
  EXPECT_EQ(study.wait(), 130);
  EXPECT_NE(study.err().find("--resume` continues from there"), std::string::npos) << study.err();
  EXPECT_FALSE(fs::exists(place.folder() / "out/second"));
}

}  // namespace
}  // namespace hookpoint
