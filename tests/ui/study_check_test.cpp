// What `study` finds before it runs, `check` finds; and both find files where `run` does.
#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::count;
using testing::Workplace;

constexpr const char* block_study =
    "Study s { scene = \"scenes/sloped_block.hook\"; duration = 0.1 s;\n"
    "  Sweep slope { values = 10 deg; } Measure creep_speed; Subject ours { engine = dts; } }\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Check, FindsInAStudyWhatStudyFinds) {
  const Workplace work;
  work.file("empty.hook", "Param slope = 0 deg; Material m { }");
  work.file("named.hook", "Param subject = 1; World w { }");
  const std::pair<std::string, const char*> cases[] = {
      {replaced(block_study, "sloped_block", "slopped_block"), "no file \"scenes/slopped_block"},
      {replaced(block_study, "Sweep slope", "Sweep slop"), "did you mean `slope`?"},
      {replaced(replaced(block_study, "scenes/sloped_block", "named"), "slope", "subject"),
       "results.csv has another column `subject`"},
      {replaced(block_study, "creep_speed", "creep_sped"), "did you mean `creep_speed`?"},
      {replaced(block_study, "10 deg", "10 kg"), "in rad"},
      {replaced(block_study, "scenes/sloped_block", "empty"), "World"},
      {replaced(block_study, "creep_speed;", "creep_speed; Fix dt { value = 50 ms; }"),
       "is above the largest stable step"},
      {"Wall w { Subject ours { engine = dts; } Scene nowhere; }", "scenes/nowhere.hook"},
      {"Matrix m { Part nowhere; }", "no file \"studies/nowhere.hook\""}};
  for (const auto& [text, says] : cases) {
    work.file("study.hook", text);
    const CommandResult check = work.hookpoint("check study.hook");
    const bool warned = std::string(says).starts_with("is above");
    EXPECT_EQ(check.status, warned ? 0 : 2) << text << check.err;
    EXPECT_NE(check.err.find(says), std::string::npos) << text << check.err;
    const CommandResult study = work.hookpoint("study study.hook --jobs 1 --out s");
    EXPECT_EQ(check.err == study.err, !warned) << text;
    EXPECT_EQ(study.err.substr(0, check.err.size()), check.err) << text;
  }
  EXPECT_EQ(work.hookpoint("check study.hook").out, "");
  work.file("study.hook", block_study);
  const CommandResult fine = work.hookpoint("check study.hook");
  EXPECT_EQ(fine.status, 0) << fine.err;
  EXPECT_EQ(fine.out, "study.hook: fine\n");
  EXPECT_EQ(fine.err, "");
}

// The scene's file is evaluated for each subject.
TEST(Check, ReportsAMistakeOfAScenesFileOnce) {
  const Workplace work;
  work.file("wrong.hook", "World w { gravty = 9.81; }");
  work.file("late.hook",
            "World w { duration = 1 s; Robot b { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, "
            "0; } } }\n"
            "Expect x { of = w.b.base.location.x; equals = 0 m; within = 1 m; from = 3 s; }\n");
  for (const char* scene : {"wrong", "late"}) {
    work.file("wall.hook",
              "Wall w { Subject a { contact = hookpoint; } Subject b { contact = "
              "lugre; integrator = rk4; }\n  Scene s { file = \"" +
                  std::string(scene) + ".hook\"; } }\n");
    const CommandResult check = work.hookpoint("check wall.hook");
    EXPECT_EQ(check.status, 2);
    EXPECT_EQ(count(check.err, "error: "), 1u) << check.err;
  }
}

/// A project of its own with a material that the installation has too, and a scene on it.
void make_clone(const Workplace& work) {
  for (const char* folder : {"clone", "clone/configs", "clone/configs/materials", "clone/mine",
                             "clone/mine/scenes", "other", "other/materials"})
    std::filesystem::create_directory(work.folder() / folder);
  work.file("clone/configs/materials/clay.hook", "Material clay { normal_stiffness = 111; }\n");
  work.file("other/materials/clay.hook", "Material clay { normal_stiffness = 222; }\n");
  work.file("clone/mine/scenes/a.hook",
            "World w { Include \"materials/clay.hook\"; Terrain.Flat g { material = clay; } }\n");
}

TEST(Search, FindsTheConfigsOfItsOwnProjectFirst) {
  const Workplace work;
  make_clone(work);
  const auto stiffness = [&](const std::string& file) {
    const std::string out = work.hookpoint("print " + file).out;
    const std::size_t at = out.find("normal_stiffness = ");
    return at == std::string::npos ? "" : out.substr(at + 19, out.find(';', at + 19) - at - 19);
  };
  EXPECT_EQ(stiffness("clone/mine/scenes/a.hook"), "111");
  EXPECT_EQ(stiffness("\"$PWD/clone/mine/scenes/a.hook\""), "111");
  setenv("HOOKPOINT_PATH", (work.folder() / "other").c_str(), 1);
  EXPECT_EQ(stiffness("clone/mine/scenes/a.hook"), "111");
  std::filesystem::remove_all(work.folder() / "clone/configs");
  EXPECT_EQ(stiffness("clone/mine/scenes/a.hook"), "222") << "HOOKPOINT_PATH, then the program's";
  unsetenv("HOOKPOINT_PATH");
  const std::string installed = stiffness("clone/mine/scenes/a.hook");
  EXPECT_NE(installed, "222");
  EXPECT_NE(installed, "");
  work.file("clone/mine/scenes/clay.hook", "Material clay { normal_stiffness = 333; }\n");
  std::filesystem::create_directory(work.folder() / "clone/mine/scenes/materials");
  work.file("clone/mine/scenes/materials/clay.hook", "Material clay { normal_stiffness = 444; }\n");
  EXPECT_EQ(stiffness("clone/mine/scenes/a.hook"), "444") << "beside the file comes first";
}

/// Flat ground 0.5 m high, whose heights lie in the project's configs.
TEST(Search, AStudyFindsTheFilesThatItsSceneFinds) {
  const Workplace work;
  make_clone(work);
  work.file("clone/configs/flat.txt", "0.5 0.5\n0.5 0.5\n");
  work.file(
      "clone/mine/scenes/b.hook",
      "Param mass = 1 kg; World w { duration = 10 ms;\n"
      "  Material m { normal_stiffness = 10 kN/m; normal_damping = 100 N.s/m; }\n"
      "  Terrain.Grid g { file = \"flat.txt\"; spacing = 2; material = m; }\n"
      "  Robot ball { Base.mobile { location = 0, 0, 0.6; Shape.Sphere { radius = 0.1; mass = "
      "mass; } } } }\n"
      "Expect height { of = w.ball.base.location.z; equals = 0.6 m; within = 1 mm; }\n");
  work.file("clone/mine/study.hook",
            "Study s { scene = \"scenes/b.hook\"; duration = 10 ms; Sweep mass { values = 1 kg; }\n"
            "  Measure penetration_max; Subject ours { engine = dts; } }\n"
            "Wall w { Subject ours { engine = dts; } Scene b; }\n");
  const CommandResult run = work.hookpoint("run clone/mine/scenes/b.hook");
  EXPECT_EQ(run.status, 0) << run.err;
  const CommandResult study = work.hookpoint("study clone/mine/study.hook --jobs 1 --out s");
  EXPECT_EQ(study.status, 0) << study.err;
  EXPECT_NE(work.read("s/s/provenance.json").find("clone/configs/flat.txt\""), std::string::npos);
  EXPECT_NE(work.read("s/w/provenance.json").find("clone/configs/flat.txt\""), std::string::npos);
}

// A ball that falls for 0.1 s under gravity g has -g/10 m/s. The scene's own `m` is another.
TEST(WallFix, IsTheValueThatItsFileMeans) {
  const Workplace work;
  work.file(
      "fall.hook",
      "Param g = 1; Let m = 3; World w { gravity = g; deltat = 1 ms; duration = 0.1 s;\n"
      "  Robot ball { Base.mobile { location = 0, 0, 100; Shape.Sphere { radius = 0.1; mass = "
      "m; } } } }\n"
      "Expect speed { of = w.ball.base.velocity.z; equals = -0.5; within = 1e-9; }\n");
  work.file("wall.hook",
            "Let m = 5; Wall w { Subject ours { engine = dts; }\n"
            "  Scene fall { file = \"fall.hook\"; Fix g { value = m; } } }\n");
  const CommandResult result = work.hookpoint("study wall.hook --jobs 1 --out w");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST(WallFix, DecidesOfTheFieldsThatHangOnIt) {
  const Workplace work;
  work.file("fall.hook",
            "Param dt = 1 ms; World w { deltat = dt; duration = 10 ms;\n"
            "  Robot ball { Base.mobile { mass = 1; inertia = 1, 1, 1, 0, 0, 0; } } }\n"
            "Expect speed { of = w.ball.base.velocity.z; equals = -0.0981; within = 1e-9; }\n");
  const std::string wall =
      "Wall w { Subject one { engine = dts; } Subject two { engine = dts; integrator = rk4; }\n"
      "  Scene fall { file = \"fall.hook\"; ";
  work.file("free.hook", wall + "} }\n");
  work.file("fixed.hook", wall + "Fix dt { value = 0.5 ms; } } }\n");
  const std::string finer = " --jobs 1 --out w --dt '0.25 ms'";
  EXPECT_EQ(work.hookpoint("study free.hook" + finer).status, 0);
  const CommandResult refused = work.hookpoint("study fixed.hook" + finer);
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(refused.err.starts_with(
      "fixed.hook:2:3: error: the study decides of `w.deltat`: it cannot be set as well\n"))
      << refused.err;
  EXPECT_EQ(count(refused.err, "error:"), 1U) << refused.err;
}

}  // namespace
}  // namespace hookpoint
