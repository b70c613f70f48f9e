// A folder of results as a user meets it: used again, used twice at once, edited, on a full disk,
// and compared.
// ctest: long, released
#include <gtest/gtest.h>

#include "output/files/hash.h"
#include "output/files/result_folder.h"
#include "tests/support/falling_ball.h"
#include "tests/support/png_file.h"
#include "tests/support/record_scene.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::falling;
using testing::record_height;
using testing::run_into;
using testing::Workplace;

TEST(UsedAgain, NothingStaleStaysAndCompareIsNotFooled) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  ASSERT_EQ(run_into(work, "b", falling("9.81")).status, 0);
  const std::string stale = work.read("b/trace.csv");
  ASSERT_EQ(run_into(work, "b", falling("1.62"), "").status, 0);
  EXPECT_FALSE(std::filesystem::exists(work.folder() / "b/trace.csv"));
  EXPECT_EQ(work.hookpoint("compare a b").status, 1);

  work.file("b/trace.csv", stale);
  const CommandResult fooled = work.hookpoint("compare a b");
  EXPECT_EQ(fooled.status, 2) << fooled.out;
  EXPECT_NE(fooled.err.find("b/trace.csv is of no run of this folder: it says nothing of the run "
                            "whose experiment.hook lies beside it"),
            std::string::npos)
      << fooled.err;

  ASSERT_EQ(run_into(work, "c", falling("1.62")).status, 0);
  work.file("c/trace.csv", stale);
  const CommandResult exchanged = work.hookpoint("compare a c");
  EXPECT_EQ(exchanged.status, 2);
  EXPECT_NE(exchanged.err.find("c/trace.csv is not the file that its run left"), std::string::npos)
      << exchanged.err;
}

TEST(UsedAgain, WhatIsNotHookpointsIsRefusedAndKept) {
  const Workplace work;
  std::filesystem::create_directory(work.folder() / "a");
  work.file("a/trace.csv", "mine");
  const CommandResult result = run_into(work, "a", falling("9.81"));
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("a/trace.csv stands in the way, and hookpoint did not write it; move "
                            "it away, or name another folder with --out"),
            std::string::npos)
      << result.err;
  EXPECT_EQ(work.read("a/trace.csv"), "mine");
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(std::filesystem::exists(work.folder() / "a/experiment.hook"));
  EXPECT_EQ(run_into(work, "a", falling("9.81"), "").status, 0) << "nothing of it is in the way";
}

TEST(UsedAgain, ARunInItsOwnFolderRepeatsIt) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  const std::string trace = work.read("a/trace.csv");
  const CommandResult again = work.hookpoint("run a/experiment.hook --out a" + record_height);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(work.read("a/trace.csv"), trace);
}

TEST(UsedAgain, AMovieThatIsResumedIsNotClearedAway) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81"), " --movie").status, 0);
  const CommandResult result = work.hookpoint("run --resume a/movie.h5 --at 50ms --out a");
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("is what this run reads"), std::string::npos) << result.err;
  EXPECT_EQ(work.hookpoint("replay a/movie.h5 --at 50ms").status, 0);
}

TEST(Folder, EveryFileIsTiedToItsExperiment) {
  const Workplace work;
  const std::string records =
      "Record t { trails = time; } Record h { trails = time; format = hdf5; } Movie film;";
  ASSERT_EQ(run_into(work, "a", falling("9.81", records)).status, 0);
  const auto manifest = output::read_manifest(work.folder() / "a");
  ASSERT_TRUE(manifest);
  for (const auto& entry : std::filesystem::directory_iterator(work.folder() / "a")) {
    const std::string name = entry.path().filename();
    if (name == "files.json") continue;
    ASSERT_TRUE(manifest->files.contains(name)) << name;
    EXPECT_EQ(manifest->files.at(name), output::hash_of_file(entry.path())) << name;
  }
  EXPECT_EQ(manifest->files.size(), 7u);
  EXPECT_NE(work.read("a/t.record.csv").find("hash," + manifest->experiment), std::string::npos);
  EXPECT_NE(work.hookpoint("replay a/film.h5 --about").out.find(manifest->experiment),
            std::string::npos);
  ASSERT_EQ(manifest->inputs.size(), 1u);
  EXPECT_EQ(manifest->inputs[0].path, (work.folder() / "run.hook").string());
  EXPECT_EQ(manifest->inputs[0].hash, output::hash_of_file(work.folder() / "run.hook"));
}

TEST(Folder, TheRunsOwnFilesAreNoRecords) {
  const Workplace work;
  const std::pair<const char*, const char*> cases[] = {
      {"Record a { trails = time; file = \"experiment.hook\"; }",
       "the run itself writes `experiment.hook`; give this one another `file`"},
      {"Record a { trails = time; file = \"trace.csv\"; }", "the run itself writes `trace.csv`"},
      {"Record trace { trails = time; }", "the run itself writes `trace.csv`"},
      {"Movie a { file = \"files.json\"; }", "the run itself writes `files.json`"},
      {"Movie a { file = \"trace.csv.partial\"; }", "the run itself writes `trace.csv.partial`"},
      {"Record a { trails = time; } Record b { trails = time; file = \"a.channels.csv\"; }",
       "another Record writes `a.channels.csv`"},
      {"Record b { trails = time; file = \"a.record.csv\"; } Record a { trails = time; }",
       "another Record writes `a.csv`"},
      {"Movie a { file = \"x\"; } Record b { trails = time; format = mat5; file = \"x.spool\"; }",
       "another Record writes `x`"},
      {"Record a { trails = time; file = \"a\\nb\"; }",
       "takes characters that can be seen, on one line"}};
  for (const auto& [text, says] : cases) {
    const CommandResult result = run_into(work, "a", falling("9.81", text), "");
    EXPECT_EQ(result.status, 2) << text;
    EXPECT_NE(result.err.find(says), std::string::npos) << text << '\n' << result.err;
    EXPECT_FALSE(std::filesystem::exists(work.folder() / "a")) << text;
  }
}

TEST(Compare, RefusesAFolderWithoutAList) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  std::filesystem::remove(work.folder() / "a/files.json");
  const CommandResult result = work.hookpoint("compare a a");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("a has no files.json"), std::string::npos) << result.err;
}

/// Heights of the black and white of a 4 x 4 image.
void write_image(const Workplace& work, char shade) {
  test_support::write_file(
      work.folder() / "hills.png",
      test_support::png_bytes({.columns = 4, .rows = 4, .bytes = std::string(16, shade)}));
}

/// A ball at rest on the ground of that image, 1 m high where it is white.
void write_hills(const Workplace& work) {
  work.file(
      "hills.hook",
      "Param g = 10; World w { gravity = g; deltat = 1 ms; duration = 0.1 s;\n"
      "  Material m { normal_stiffness = 10 kN/m; normal_damping = 100 N.s/m; }\n"
      "  Terrain.Grid ground { file = \"hills.png\"; low = 0; high = 1; spacing = 1; material "
      "= m; }\n"
      "  Robot ball { Base.mobile { location = 0, 0, 1.1; Shape.Sphere { radius = 0.1; mass = "
      "1 kg; } } } }\n");
  work.file("study.hook",
            "Study s { scene = \"hills.hook\"; duration = 0.1 s; Sweep g { values = 5, 10; }\n"
            "  Measure penetration_max; Measure energy_gain; Subject ours { engine = dts; } }\n");
}

// On white ground the ball stands, above black it falls: other numbers under the same text.
TEST(Resume, AnInputThatWasEditedIsAnotherExperiment) {
  const Workplace work;
  write_image(work, '\xff');
  write_hills(work);
  const CommandResult white = work.hookpoint("study study.hook --jobs 1 --out s");
  ASSERT_EQ(white.status, 0) << white.err;
  const std::string stands = work.read("s/results.csv");
  const CommandResult same = work.hookpoint("study study.hook --jobs 1 --resume --out s");
  EXPECT_EQ(same.err.find("run again"), std::string::npos) << same.err;
  write_image(work, '\0');
  const CommandResult black = work.hookpoint("study study.hook --jobs 1 --resume --out s");
  EXPECT_EQ(black.status, 0) << black.err;
  EXPECT_NE(black.err.find("note: 2 of the finished rows are of another study, scene, input file, "
                           "program or engine, or damaged: they are run again"),
            std::string::npos)
      << black.err;
  EXPECT_NE(work.read("s/results.csv"), stands);
  const std::string provenance = work.read("s/provenance.json");
  for (const char* file : {"hills.png", "hills.hook", "study.hook"})
    EXPECT_NE(provenance.find("\"path\": \"" + (work.folder() / file).string() + "\""),
              std::string::npos)
        << provenance;
  EXPECT_NE(provenance.find(output::hash_of_file(work.folder() / "hills.png")), std::string::npos);
}

TEST(Compare, TellsThatAnInputWasAnother) {
  const Workplace work;
  write_hills(work);
  for (const auto& [name, shade] : {std::pair("a", '\xff'), std::pair("b", '\0')}) {
    write_image(work, shade);
    ASSERT_EQ(work.hookpoint(std::string("run hills.hook --out ") + name).status, 0);
  }
  const CommandResult result = work.hookpoint("compare a b");
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_NE(result.out.find("inputs.hills.png"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("run.hook"), std::string::npos) << result.out;
}

TEST(Folder, HasOneWriterAtATime) {
  const Workplace work;
  write_image(work, '\xff');
  write_hills(work);
  const output::ResultFolder other(work.folder() / "s", {"other", {}, {}, {}}, {"a"});
  for (const char* command : {"study study.hook --out s", "study study.hook --resume --out s",
                              "run hills.hook --out s"}) {
    const CommandResult result = work.hookpoint(command);
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_NE(result.err.find("another hookpoint (process " + std::to_string(getpid()) +
                              ") writes into s; wait for it, or name another folder with --out"),
              std::string::npos)
        << result.err;
  }
  EXPECT_EQ(output::read_manifest(work.folder() / "s")->experiment, "other");
}

TEST(FullDisk, KeepsTheRowsAndSaysHowToGoOn) {
  const Workplace work;
  write_image(work, '\xff');
  write_hills(work);
  ASSERT_EQ(work.hookpoint("study study.hook --jobs 1 --out whole").status, 0);
  {
    const testing::FileSizeLimit full(20'000);
    const CommandResult result = work.hookpoint("study study.hook --jobs 1 --out s");
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find("hookpoint: error: cannot write s/"), std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("what is finished is kept in s: `hookpoint study study.hook --out s "
                              "--resume` continues from there"),
              std::string::npos)
        << result.err;
  }
  const CommandResult resumed = work.hookpoint("study study.hook --jobs 1 --out s --resume");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(work.read("s/results.csv"), work.read("whole/results.csv"));
  EXPECT_EQ(resumed.err.find("run again"), std::string::npos) << resumed.err;
  EXPECT_FALSE(work.read("s/report.html").empty());
}

TEST(FullDisk, LeavesTheResultsOfBefore) {
  const Workplace work;
  ASSERT_EQ(run_into(work, "a", falling("9.81")).status, 0);
  const std::string trace = work.read("a/trace.csv");
  work.file("run.hook", falling("1.62"));
  {
    const testing::FileSizeLimit full(100);
    EXPECT_EQ(work.hookpoint("run run.hook --out a" + record_height).status, 3);
  }
  EXPECT_EQ(work.read("a/trace.csv"), trace);
  EXPECT_EQ(work.hookpoint("compare a a").status, 0);
}

TEST(Folder, ThatCannotBeMadeIsToldWithTheReason) {
  const Workplace work;
  work.file("file", "");
  for (const char* place : {"file/sub", "/proc/nowhere"}) {
    const CommandResult result = run_into(work, place, falling("9.81"));
    EXPECT_EQ(result.status, 3) << result.err;
    EXPECT_NE(result.err.find(std::string("cannot make the folder ") + place + ": "),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("--out names another folder"), std::string::npos) << result.err;
  }
  const CommandResult read_only = run_into(work, "/proc", falling("9.81"));
  EXPECT_EQ(read_only.status, 3);
  EXPECT_NE(read_only.err.find("cannot write into the folder /proc: "), std::string::npos)
      << read_only.err;
  write_image(work, '\xff');
  write_hills(work);
  const CommandResult study = work.hookpoint("study study.hook --out /proc");
  EXPECT_EQ(study.status, 3);
  EXPECT_EQ(study.err.find("what is finished is kept"), std::string::npos) << study.err;
}

TEST(Folder, WhoseListNamesFilesElsewhereIsRefused) {
  const Workplace work;
  std::filesystem::create_directory(work.folder() / "a");
  work.file("precious.txt", "mine");
  work.file("a/files.json", R"({"experiment": "e", "files": {"../precious.txt": ""}})");
  EXPECT_EQ(run_into(work, "a", falling("9.81")).status, 2);
  EXPECT_EQ(work.read("precious.txt"), "mine");
}

}  // namespace
}  // namespace hookpoint
