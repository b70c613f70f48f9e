// What --resume takes and what it does not: rows of the same run, whole.
#include "output/text/hash.h"
#include "studies/run/row_store.h"
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
  engines_["ode"].description.version = "another";
  EXPECT_EQ(steps_of_resume(study), 3 * steps_a_row);
  EXPECT_EQ(told_,
            "3 of the finished rows are of another study, scene, input file, program or engine, or "
            "damaged: they are run anew");
}

TEST_F(Resume, RunsAnewWhatAnotherSceneMade) {
  run_whole();
  write("scene.hook", replaced(slider_scene, "mu = 0.8", "mu = 0.7"));
  EXPECT_EQ(steps_of_resume(study), 6 * steps_a_row);
}

TEST_F(Resume, KnowsARowWhoseFileWasCutOffOrDamaged) {
  run_whole();
  const std::filesystem::path file = folder_ / "out/rows/00002.row";
  const std::string whole = read(file);
  const auto plan = this->plan(study);
  const RowStore store(folder_ / "out/rows", true);
  const std::string identity = plan->identity_of(plan->rows[2], engines_);
  const auto outcome = store.load(2, identity, 1, 1);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->traces[0].time.size(), 101u);
  EXPECT_FALSE(store.load(2, identity + "0", 1, 1));
  EXPECT_FALSE(store.load(2, identity, 2, 1));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write("out/rows/00002.row", whole.substr(0, length));
    ASSERT_FALSE(store.load(2, identity, 1, 1)) << length;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    write("out/rows/00002.row", damaged);
    ASSERT_FALSE(store.load(2, identity, 1, 1)) << i;
  }
  EXPECT_EQ(steps_of_resume(study), steps_a_row);
  EXPECT_EQ(read(file), whole);
  EXPECT_EQ(steps_of_resume(study), 0);
}

TEST_F(Resume, LeavesTheUsersFilesInRows) {
  run_whole();
  write("out/rows/notes.row", "mine");
  run_whole();
  EXPECT_EQ(read(folder_ / "out/rows/notes.row"), "mine");
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

// A study on a ground of 16 million heights has a row for every value of its sweeps.
TEST_F(Resume, RowsStandOnTheSameHeights) {
  write("heights.txt", "0 0\n0 0.5\n");
  write("scene.hook", replaced(slider_scene, "Terrain.Slope ground { angle = slope;",
                               "Terrain.Grid ground { file = \"heights.txt\"; height = mu;"));
  const auto plan =
      this->plan(replaced(study, "Sweep slope {", "Sweep mu { values = 0, 1; } Sweep slope {"));
  ASSERT_TRUE(plan) << first_error();
  const auto heights = [&](std::size_t row) { return plan->rows[row].heights.get(); };
  ASSERT_EQ(plan->rows.size(), 12u);
  EXPECT_EQ(heights(0), heights(5));
  EXPECT_EQ(heights(6), heights(11));
  EXPECT_NE(heights(0), heights(6)) << "0 and 1 m high";
  const auto& ground = std::get<contact::GridSurface>(plan->rows[6].experiment.terrain->surface);
  EXPECT_EQ(ground.heights.capacity(), 0u);
  const simulation::Experiment whole = plan->rows[6].whole();
  EXPECT_EQ(std::get<contact::GridSurface>(whole.terrain->surface).heights, *heights(6));
  EXPECT_EQ(std::ranges::max(*heights(6)), 1.5);
}

}  // namespace
}  // namespace hookpoint::studies
