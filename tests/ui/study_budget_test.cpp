// Studies that ask for more than any machine has: one diagnostic at the Sweep, exit status 2, at
// once.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint::testing {
namespace {

constexpr int wrong_input = 2;

std::string study(const std::string& sweeps) {
  return "Study many {\n  scene = \"scene.hook\"; duration = 0.1 s;\n" + sweeps +
         "  Subject ours { }\n  Measure creep_speed { }\n}\n";
}

CommandResult run_study(const Workplace& place, const std::string& sweeps) {
  place.file("scene.hook",
             "Param mass = 1 kg; Param height = 1 m;\n"
             "World w { Robot r { Base.mobile { mass = mass; location = 0, 0, height; "
             "Shape.Cube dimensions = 1, 1, 1; } } }\n");
  place.file("many.hook", study(sweeps));
  return place.hookpoint("study many.hook --out results");
}

TEST(StudyBudget, ASweepOfTooManyValuesIsRefused) {
  const Workplace place;
  const CommandResult stepped =
      run_study(place, "  Sweep mass { from = 1 kg; to = 2 kg; step = 1e-12 kg; }\n");
  EXPECT_EQ(stepped.status, wrong_input);
  EXPECT_NE(
      stepped.err.find("many.hook:3:47: error: the Sweep requires 1e+12 values, more than the "
                       "1000000 allowed"),
      std::string::npos)
      << stepped.err;
  const CommandResult counted =
      run_study(place, "  Sweep mass { from = 1 kg; to = 2 kg; count = 1e12; }\n");
  EXPECT_EQ(counted.status, wrong_input);
  EXPECT_NE(counted.err.find("the Sweep requires 1e+12 values"), std::string::npos) << counted.err;
  const CommandResult half =
      run_study(place, "  Sweep mass { from = 1 kg; to = 2 kg; count = 2.5; }\n");
  EXPECT_EQ(half.status, wrong_input);
  EXPECT_NE(half.err.find("`count` takes a whole number"), std::string::npos) << half.err;
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "results"));
}

// Of 100,000 short runs there is room in 500 MB: what a run takes more is measured over 4000. A
// hexapod's experiment alone has more than 100 kB.
TEST(StudyBudget, AHundredThousandRunsTakeLessThan500Megabytes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "memory is that of the program as released";
#endif
  const Workplace place;
  const auto peak = [&](int count) {
    place.file(
        "many.hook",
        "Study many { scene = \"scenes/walking_hexapod.hook\"; duration = 1 ms; settle = 0 s;\n"
        "  Sweep allowance { from = 0.5 mm; to = 1 mm; count = " +
            std::to_string(count) +
            "; }\n  Subject ours { } Measure penetration_max; Measure peer_distance;\n"
            "  Plot time { x = time; y = displacement; Only allowance { values = 1 mm; } } }\n");
    const CommandResult result = place.hookpoint("study many.hook --jobs 2 --out results");
    EXPECT_EQ(result.status, 0) << result.err;
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return 1024. * static_cast<double>(usage.ru_maxrss);
  };
  const double few = peak(100), many = peak(4100);
  const double a_run = (many - few) / 4000.;
  EXPECT_LT(few + 100'000. * a_run, 500e6) << a_run << " bytes a run";
}

TEST(StudyBudget, RunsAreCountedOverAllSweeps) {
  const Workplace place;
  const CommandResult result =
      run_study(place,
                "  Sweep mass { from = 1 kg; to = 2 kg; count = 2000; }\n"
                "  Sweep height { from = 1 m; to = 2 m; count = 3000; }\n");
  EXPECT_EQ(result.status, wrong_input);
  EXPECT_NE(result.err.find("the study's sweeps and subjects require 6e+06 runs, more than the "
                            "1000000 allowed"),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(std::filesystem::exists(place.folder() / "results"));
}

}  // namespace
}  // namespace hookpoint::testing
