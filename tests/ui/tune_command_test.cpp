// `hookpoint tune` as a user runs it: what it prints, leaves and returns.
#include <gtest/gtest.h>

#include "tests/support/child_process.h"
#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::CommandResult;
using testing::Workplace;
namespace fs = std::filesystem;

constexpr const char* block = R"(World world {
  Material floor { normal_stiffness = 5 kN/m; }
  Terrain.Flat ground { material = floor; }
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = .2, .2, .1; mass = 1; } } }
}
)";

std::string tune_of(const std::string& duration) {
  return R"(Tune floor_for_block {
  scene = "block.hook"; duration = )" +
         duration + R"(;
  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }
  Objective penetration_max { minimise; }
  Objective stable_step { maximise; }
  population = 8; generations = 3; seeds = 1; samples = 2;
}
)";
}

TEST(TuneCommand, LeavesWhatItSaysAndExitsWithZero) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("tune.hook", tune_of("0.2 s"));
  const CommandResult result = place.hookpoint("tune tune.hook --out out --jobs 2");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("normal_stiffness"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("generation 3 of 3"), std::string::npos) << result.err;
  for (const char* file : {"evaluations.csv", "pareto.csv", "sobol.csv", "recommended.json",
                           "report.html", "experiment.hook", "scene.hook", "provenance.json",
                           "files.json", "pareto_front.svg", "materials/floor_tuned.hook"})
    EXPECT_FALSE(place.read(fs::path("out") / file).empty()) << file;
  EXPECT_EQ(place.hookpoint("fmt --check out/materials/floor_tuned.hook").status, 0);
  EXPECT_EQ(place.hookpoint("run out/scene.hook --for \"10 ms\" --out again").status, 0);
  // Without a command the file is for `tune`.
  EXPECT_EQ(place.hookpoint("tune.hook --out out --resume").status, 0);
}

// The friction of a block on level ground changes nothing: the tuning judged nothing.
TEST(TuneCommand, AnObjectiveThatNoConstantChangesIsAFault) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("tune.hook", R"(Tune idle {
  scene = "block.hook"; duration = 0.1 s;
  Vary static_friction { from = 0.5; to = 1; }
  Objective penetration_max { minimise; }
  population = 8; generations = 2; seeds = 1; samples = 0;
}
)");
  const CommandResult result = place.hookpoint("tune tune.hook --out out --jobs 2");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("idle: Objective penetration_max: the same for every candidate"),
            std::string::npos)
      << result.err;
  EXPECT_NE(place.read("out/report.html").find("1 Objective judges nothing"), std::string::npos);
}

// The block never rises by a metre: neither what is required of that time nor what is minimised has
// a value.
TEST(TuneCommand, BlocksThatMayBeEmptyAreNoFault) {
  const Workplace place;
  place.file("block.hook", block);
  const auto tune = [&](const std::string& word) {
    place.file("tune.hook", R"(Tune idle {
  scene = "block.hook"; duration = 0.1 s;
  Vary static_friction { from = 0.5; to = 1; }
  Measure risen { of = block.position.z; take = time_at; level = 1 m; }
  Measure late { of = block.position.z; take = time_at; level = 2 m; }
  Objective penetration_max { minimise; )" +
                                word + R"( }
  Objective late { target = 1 s; )" +
                                word + R"( }
  Require risen { below = 1 s; )" +
                                word + R"( }
  population = 8; generations = 2; seeds = 1; samples = 0;
}
)");
    return place.hookpoint("tune tune.hook --out out --jobs 2");
  };
  const CommandResult fault = tune("");
  EXPECT_EQ(fault.status, 1) << fault.err;
  EXPECT_NE(fault.err.find("Require risen: no candidate has a value of risen"), std::string::npos)
      << fault.err;
  const CommandResult allowed = tune("may_be_empty = true;");
  EXPECT_EQ(allowed.status, 0) << allowed.err;
  EXPECT_EQ(allowed.err.find("error"), std::string::npos) << allowed.err;
  EXPECT_NE(place.read("out/report.html")
                .find("✓ The recommended constants meet all requirements; 2 Objectives judge "
                      "nothing, as they may, 1 Require judges nothing, as it may."),
            std::string::npos);
}

TEST(TuneCommand, BringsAMeasureToItsTarget) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("tune.hook", R"(Tune deep {
  scene = "block.hook"; duration = 0.5 s; settle = 0.3 s;
  Vary normal_stiffness { from = 0.5 kN/m; to = 100 kN/m; scale = log; }
  Measure sink { of = 0.05 m - block.position.z; take = mean; unit = mm; }
  Objective sink { target = 1 mm; }
  Require penetration_max { below = 4 mm; }
  method = cmaes; population = 8; generations = 6; seeds = 1; samples = 0;
}
)");
  const CommandResult result = place.hookpoint("tune tune.hook --out out --jobs 2");
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* part : {"mm off", "required: penetration_max is below 4 mm"})
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("distance of sink from 1 mm"), std::string::npos) << result.err;
  // A mass of 1 kg on four corners sinks m g/(4 k): 1 mm at 2.45 kN/m.
  const std::string json = place.read("out/recommended.json");
  const std::size_t value = json.find("\"value\": ");
  ASSERT_NE(value, std::string::npos);
  EXPECT_NEAR(std::stod(json.substr(value + 9)), 2.4517, 0.1) << json;
  EXPECT_EQ(place.hookpoint("check tune.hook").status, 0);
}

TEST(TuneCommand, RefusesWhatItCannotTune) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("bad.hook", "Tune t { scene = \"block.hook\"; Vary mass { from = 1; to = 2; } }\n");
  const CommandResult world = place.hookpoint("tune block.hook --out out");
  EXPECT_EQ(world.status, 2);
  EXPECT_NE(world.err.find("holds no Tune"), std::string::npos) << world.err;
  const CommandResult bad = place.hookpoint("tune bad.hook --out out");
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.hook:1:"), std::string::npos) << bad.err;
  EXPECT_EQ(place.hookpoint("check bad.hook").status, 2);
  EXPECT_FALSE(fs::exists(place.folder() / "out"));
}

// 1 kg on four corners: their stiffness decides which step is stable.
TEST(TuneCommand, WarnsOfUnstableStepsBeforeAndAfterTheSearch) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("tune.hook", tune_of("0.05 s"));
  EXPECT_EQ(place.hookpoint("check tune.hook").err, "") << "each candidate has a step of its own";
  std::string coarse = block;
  coarse.insert(coarse.find("Material"), "deltat = 5 ms; ");
  place.file("block.hook", coarse);
  const CommandResult tuned = place.hookpoint("tune tune.hook --quick --out out --jobs 2");
  EXPECT_NE(tuned.err.find("warning: deltat 0.005 s is above the largest stable step"),
            std::string::npos)
      << tuned.err;
  EXPECT_NE(tuned.err.find("with every constant at its greatest value"), std::string::npos)
      << tuned.err;
  EXPECT_NE(tuned.err.find("recommended constants: deltat 0.005 s is above"), std::string::npos)
      << tuned.err;
}

TEST(TuneCommand, EndsWithOneWhereNothingMeetsTheRequirements) {
  const Workplace place;
  place.file("block.hook", block);
  std::string text = tune_of("0.2 s");
  text.insert(text.find("population"), "Require stable_step { above = 1 s; } ");
  place.file("tune.hook", text);
  const CommandResult result = place.hookpoint("tune tune.hook --out out");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("the requirements are not met"), std::string::npos) << result.out;
  EXPECT_NE(place.read("out/report.html").find("No candidate meets"), std::string::npos);
}

TEST(TuneCommand, InterruptedItLeavesWhatIsKnownAndGoesOn) {
  const Workplace place;
  place.file("block.hook", block);
  place.file("tune.hook", tune_of("5 s"));
  ChildProcess tuning(place.folder(), {"tune", "tune.hook", "--out", "out", "--jobs", "1"});
  ASSERT_TRUE(tuning.wait_until([&] {
    return tuning.err().find("generation 1 of 3") != std::string::npos;
  })) << tuning.err();
  tuning.signal(SIGINT);
  EXPECT_EQ(tuning.wait(), 130);
  EXPECT_NE(tuning.err().find("--resume` continues from there"), std::string::npos) << tuning.err();
  EXPECT_NE(place.read("out/recommended.json").find("\"complete\": false"), std::string::npos);
  EXPECT_NE(place.read("out/report.html").find("Interrupted"), std::string::npos);
  EXPECT_EQ(place.hookpoint("tune tune.hook --out out --resume").status, 0);
  EXPECT_EQ(place.hookpoint("tune tune.hook --out whole").status, 0);
  for (const char* file : {"evaluations.csv", "recommended.json", "materials/floor_tuned.hook",
                           "pareto_front.svg", "sobol.csv"})
    EXPECT_EQ(place.read(fs::path("out") / file), place.read(fs::path("whole") / file)) << file;
}

}  // namespace
}  // namespace hookpoint
