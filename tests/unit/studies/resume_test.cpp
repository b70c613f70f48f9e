// What --resume takes and what it does not: rows of the same run, whole.
#include "output/files/hash.h"
#include "tests/support/study_runner.h"

namespace hookpoint::studies {
namespace {

constexpr const char* study = R"(
Study creep {
  scene = "scene.hook";
  duration = 1 s;
  Subject ours { engine = dts; }
  Subject peer { engine = ode; settings = matched; }
  Sweep slope { values = 10 deg, 20 deg, 30 deg; }
  Measure creep_speed;
  Plot shift { x = time; y = displacement; }
}
)";

constexpr long steps_a_row = 100;

class Resume : public StudyRunner {
 protected:
  /// Steps that `--resume` of `text` takes in the folder that `study` left; `told_` is what it
  /// says.
  long steps_of_resume(const std::string& text) {
    const auto plan = this->plan(text);
    EXPECT_TRUE(plan) << first_error();
    Slider::steps_taken = 0;
    told_.clear();
    RunOptions options{
        2, true, folder_ / "out", {}, [this](const std::string& notice) { told_ += notice; }};
    run_study(*plan, engines_, options, stop_);
    return Slider::steps_taken;
  }
  void run_whole() {
    const auto plan = this->plan(study);
    ASSERT_TRUE(plan) << first_error();
    run(*plan, "out");
  }
  std::string told_;
};

TEST_F(Resume, TakesWhatIsOfTheSameRun) {
  run_whole();
  EXPECT_EQ(steps_of_resume(study), 0);
  EXPECT_EQ(told_, "");
}

TEST_F(Resume, RunsAnewWhatAnotherEngineOfThatNameMade) {
  run_whole();
  EngineEntry other = engines_.at("ode");
  simulation::EngineDescription description = other.describe();
  description.version = "another";
  other.describe = described_as(description);
  engines_.add("ode", other);
  EXPECT_EQ(steps_of_resume(study), 3 * steps_a_row);
  EXPECT_EQ(told_,
            "3 of the finished rows are of another study, scene, input file, program or engine, or "
            "damaged: they are run again");
}

TEST_F(Resume, RunsAnewWhatAnotherSceneMade) {
  run_whole();
  write("scene.hook", replaced(slider_scene, "mu = 0.8", "mu = 0.7"));
  EXPECT_EQ(steps_of_resume(study), 6 * steps_a_row);
}

// Another question, another title, another value of a sweep, another metric: the runs are the same.
TEST_F(Resume, TakesARunInWhateverStudyItStands) {
  run_whole();
  EXPECT_EQ(steps_of_resume(replaced(study, "Study creep {", "Study other { title = \"Again\";")),
            0);
  EXPECT_EQ(told_, "");
  EXPECT_EQ(steps_of_resume(replaced(study, "10 deg, 20 deg", "10 deg, 15 deg, 20 deg")),
            2 * steps_a_row);
  EXPECT_EQ(told_, "");
  // Measured by running again, and kept beside what was there.
  EXPECT_EQ(steps_of_resume(replaced(study, "Measure creep_speed;", "Measure slip_distance;")),
            6 * steps_a_row);
  EXPECT_EQ(steps_of_resume(study), 0);
  EXPECT_EQ(steps_of_resume(replaced(study, "duration = 1 s;", "duration = 1 s; settle = 0.1 s;")),
            6 * steps_a_row)
      << "measured from another time on";
}

// Two rows that are the same run: friction does nothing to the Slider's scene but stand in it.
TEST_F(Resume, MakesARunThatStandsInTwoRowsOnce) {
  const std::string twice = replaced(study, "Subject peer { engine = ode; settings = matched; }",
                                     "Subject again { engine = dts; }");
  Slider::steps_taken = 0;
  const auto plan = this->plan(twice);
  ASSERT_TRUE(plan) << first_error();
  const StudyRun run = this->run(*plan, "twice", 2);
  EXPECT_EQ(Slider::steps_taken, 3 * steps_a_row);
  ASSERT_EQ(run.result.rows.size(), 6u);
  EXPECT_EQ(run.result.rows[0].metrics[0].measured, run.result.rows[1].metrics[0].measured);
  EXPECT_EQ(run.result.rows[1].traces[0].read().time.size(), 101u);
}

TEST_F(Resume, ATimeIsKeptForItsOwnStudyAlone) {
  const std::string timed = replaced(study, "Measure creep_speed;", "Measure step_time;");
  EXPECT_GT(steps_of_resume(timed), 6 * steps_a_row);
  EXPECT_EQ(steps_of_resume(timed), 0);
  EXPECT_EQ(steps_of_resume(replaced(timed, "Study creep", "Study other")), 6 * 5 * 200);
}

TEST_F(Resume, LeavesTheUsersFilesInTheStoresFolder) {
  run_whole();
  write("out/store/notes.txt", "mine");
  run_whole();
  EXPECT_EQ(read(folder_ / "out/store/notes.txt"), "mine");
}

TEST_F(Resume, AFigureMayNotHaveTheNameOfATable) {
  EXPECT_FALSE(plan(replaced(study, "Plot shift", "Plot results")));
  EXPECT_EQ(first_error(), "the study itself leaves results.csv; give the Plot another name");
}

TEST_F(Resume, ProvenanceNamesTheFilesAndTheirHashes) {
  run_whole();
  const std::string provenance = read(folder_ / "out/provenance.json");
  for (const char* file : {"study.hook", "scene.hook"}) {
    const std::string path = (folder_ / file).string();
    EXPECT_NE(provenance.find("\"path\": \"" + path + "\""), std::string::npos) << provenance;
    EXPECT_NE(provenance.find("\"hash\": \"" + output::hash_of_file(path) + "\""),
              std::string::npos);
  }
  EXPECT_EQ(output::read_manifest(folder_ / "out")->experiment, plan(study)->hash);
  EXPECT_EQ(plan(study)->hash.size(), 32u);
}

// What a study was planned with is what runs: a file that is edited meanwhile is no part of it.
TEST_F(Resume, AFileThatIsEditedAfterThePlanIsAnError) {
  write("heights.txt", "0 0\n0 0.5\n");
  write("scene.hook", replaced(slider_scene, "Terrain.Slope ground { angle = slope;",
                               "Terrain.Grid ground { file = \"heights.txt\"; height = mu;"));
  const auto gridded = this->plan(replaced(
      study, "Sweep slope { values = 10 deg, 20 deg, 30 deg; }", "Sweep mu { values = 0, 1; }"));
  ASSERT_TRUE(gridded) << first_error();
  EXPECT_EQ(
      std::get<contact::GridSurface>(gridded->experiment_of(gridded->rows[2]).terrain->surface)
          .heights.size(),
      4u);
  write("heights.txt", "0 0\n0 0.25\n");
  EXPECT_THROW(gridded->experiment_of(gridded->rows[2]), ChangedInput);
}

}  // namespace
}  // namespace hookpoint::studies
