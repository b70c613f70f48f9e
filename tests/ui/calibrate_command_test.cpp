// `hookpoint tune` with a Calibrate as a user runs it: what it prints, leaves and returns.
#include <gtest/gtest.h>

#include "output/files/csv.h"
#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::CommandResult;
using testing::config;
using testing::Workplace;
namespace fs = std::filesystem;

TEST(CalibrateCommand, TheExampleFindsTheTruthOfItsDrop) {
  const Workplace place;
  const CommandResult result =
      place.hookpoint("tune " + config("tunings/floor_from_drop.hook") + " --quick --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* file : {"calibration.csv", "correlations.csv", "evaluations.csv", "curves.csv",
                           "report.html", "provenance.json", "files.json", "trace_drop.svg",
                           "residuals_drop.svg", "materials/surface_hunt_crossley.hook"})
    EXPECT_FALSE(place.read(fs::path("out") / file).empty()) << file;
  EXPECT_EQ(place.hookpoint("fmt --check out/materials/surface_hunt_crossley.hook").status, 0);
  const auto table = output::parse_csv(place.read("out/calibration.csv"));
  ASSERT_TRUE(table);
  double stiffness = 0., hysteresis = 0.;
  for (const auto& row : table->rows) {
    if (row[0] != "hunt_crossley" || row[6] != "yes") continue;
    if (row[1] == "normal_stiffness") stiffness = std::stod(row[3]);
    if (row[1] == "hysteresis_damping") hysteresis = std::stod(row[3]);
  }
  EXPECT_NEAR(stiffness, 200., 40.) << result.out;  // configs/data/make_drop.py
  EXPECT_NEAR(hysteresis, 0.5, 0.05) << result.out;
}

TEST(CalibrateCommand, TheExamplesDataAreWhatTheirScriptMakes) {
  const Workplace place;
  ASSERT_EQ(std::system(("'" + testing::source_folder() + "/configs/data/make_drop.py' > '" +
                         (place.folder() / "drop.csv").string() + "'")
                            .c_str()),
            0);
  EXPECT_EQ(place.read("drop.csv"),
            testing::read_file(testing::source_folder() + "/configs/data/drop.csv"));
}

// In free flight no constant of the ground changes the height: the fit judged nothing.
TEST(CalibrateCommand, AConstantThatChangesNoTraceIsAFault) {
  const Workplace place;
  place.file("flight.csv", "time [s],z [m]\n0,0.1\n0.01,0.0995\n0.02,0.098\n0.03,0.0956\n");
  const auto tune = [&](const std::string& word) {
    place.file("drop.hook", R"(Calibrate floor {
  scene = "scenes/dropped_box.hook";
  Trace drop { file = "flight.csv"; column = "z [m]"; of = world.box.base.location.z; weight = 1 / (0.5 mm); )" +
                                word + R"( }
  Vary normal_stiffness { from = 5 kN/m; to = 50 kN/m; }
  subjects = hookpoint; starts = 2; resamples = 2;
}
)");
    return place.hookpoint("tune drop.hook --out out");
  };
  const CommandResult result = tune("");
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_NE(result.err.find("floor: Subject hookpoint: none of the constants changes a trace"),
            std::string::npos)
      << result.err;
  EXPECT_NE(place.read("out/report.html").find("1 Subject judges nothing"), std::string::npos);
  const CommandResult allowed = tune("may_be_empty = true;");
  EXPECT_EQ(allowed.status, 0) << allowed.err;
  EXPECT_EQ(allowed.err.find("error"), std::string::npos) << allowed.err;
  EXPECT_NE(place.read("out/report.html").find("1 Subject judges nothing, as it may"),
            std::string::npos);
}

TEST(CalibrateCommand, RefusesABadTraceWithItsPlace) {
  const Workplace place;
  place.file("drop.csv", "time [s],z [m]\n1,1\n0,2\n");
  place.file("bad.hook", R"(Calibrate floor {
  scene = "scenes/dropped_box.hook";
  Trace drop { file = "drop.csv"; column = "z [m]"; of = world.box.base.location.z; weight = 1 / (1 mm); }
  Vary normal_stiffness { from = 1 kN/m; to = 1 MN/m; scale = log; }
}
)");
  const CommandResult bad = place.hookpoint("tune bad.hook --out out");
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.hook:3:"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("row 3"), std::string::npos) << bad.err;
  EXPECT_EQ(place.hookpoint("check bad.hook").status, 2);
  EXPECT_FALSE(fs::exists(place.folder() / "out"));
}

TEST(CalibrateCommand, InterruptedItLeavesWhatIsKnownAndGoesOn) {
  const Workplace place;
  place.file("drop.hook", R"(Calibrate floor {
  scene = "scenes/dropped_box.hook";
  Trace drop { file = "data/drop.csv"; column = "z [m]"; of = world.box.base.location.z; weight = 1 / (0.5 mm); }
  Vary normal_stiffness { from = 1 kN/m; to = 1 MN/m; scale = log; }
  subjects = hunt_crossley, hookpoint; starts = 4; resamples = 40;
}
)");
  ChildProcess calibrating(place.folder(), {"tune", "drop.hook", "--out", "out", "--jobs", "1"});
  ASSERT_TRUE(calibrating.wait_until([&] {
    return calibrating.err().find("hunt_crossley: error") != std::string::npos;
  })) << calibrating.err();
  calibrating.signal(SIGINT);
  EXPECT_EQ(calibrating.wait(), 130);
  EXPECT_NE(calibrating.err().find("--resume` continues from there"), std::string::npos)
      << calibrating.err();
  EXPECT_NE(place.read("out/report.html").find("Interrupted"), std::string::npos);
  EXPECT_EQ(place.hookpoint("tune drop.hook --out out --resume").status, 0);
  EXPECT_EQ(place.hookpoint("tune drop.hook --out whole").status, 0);
  for (const char* file : {"calibration.csv", "evaluations.csv", "correlations.csv",
                           "materials/surface_hookpoint.hook", "trace_drop.svg"})
    EXPECT_EQ(place.read(fs::path("out") / file), place.read(fs::path("whole") / file)) << file;
}

}  // namespace
}  // namespace hookpoint
