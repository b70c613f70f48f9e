// Studies whose runs a cluster makes: a real Slurm of one node that comes and goes with the test,
// and the same bytes as on one machine, whatever dies meanwhile.
// ctest: full, clock
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <thread>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/slurm_cluster.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
using testing::ChildProcess;
using testing::CommandResult;
using testing::SlurmCluster;
using testing::Workplace;

/// Half a second of work a run, so that something can die on the way.
constexpr const char* fall_study =
    "Study fall { scene = \"scenes/sloped_block.hook\"; duration = 2 s; settle = 0.05 s;\n"
    "  Sweep slope { from = 5 deg; to = 40 deg; step = 5 deg; }\n"
    "  Subject ours { engine = dts; } Subject ode { engine = ode; settings = default; }\n"
    "  Measure slip_acceleration; Measure penetration_max; Measure peer_distance;\n"
    "  Plot shift { x = time; y = displacement; Only slope { values = 20 deg; } } }\n";

// Without a Slurm: what stands in for its program does not answer.
TEST(SilentSlurm, IsNotWaitedForWithoutEnd) {
  const Workplace work;
  work.file("study.hook", fall_study);
  fs::permissions(work.file("sbatch", "#!/bin/sh\nsleep 1000\n"), fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (work.folder().string() + ":" + path).c_str(), 1);
  const CommandResult result = work.hookpoint("study study.hook --slurm --out out");
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("sbatch --version has not answered within 10 s"), std::string::npos)
      << result.err;
  // The version comes at once, the submission does not: the interrupt key ends it.
  work.file("sbatch", "#!/bin/sh\ntest \"$1\" = --version || { touch asked; sleep 1000; }\n");
  {
    ChildProcess front(work.folder(), {"study", "study.hook", "--slurm", "--out", "out"});
    const fs::path asked = work.folder() / "out/cluster/00000/asked";
    ASSERT_TRUE(front.wait_until([&] { return fs::exists(asked); })) << front.err();
    front.signal(SIGINT);
    EXPECT_EQ(front.wait(), 130) << front.err();
  }
  setenv("PATH", path.c_str(), 1);
}

class Slurm : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (SlurmCluster::missing()) return;
    cluster_ = std::make_unique<SlurmCluster>();
  }
  static void TearDownTestSuite() { cluster_.reset(); }

  void SetUp() override {
    if (const auto what = SlurmCluster::missing()) GTEST_SKIP() << "Slurm: not here: " << *what;
    ASSERT_TRUE(cluster_->ready()) << cluster_->log();
    work_.file("study.hook", fall_study);
    ASSERT_EQ(work_.hookpoint("study study.hook --jobs 2 --out whole").status, 0);
  }

  void expect_same(const std::string& folder) {
    for (const char* name :
         {"results.csv", "peer_distance.csv", "experiment.hook", "scene.hook", "shift.svg"})
      EXPECT_EQ(work_.read(fs::path(folder) / name), work_.read(fs::path("whole") / name)) << name;
    EXPECT_EQ(work_.hookpoint("compare whole '" + folder + "' --tolerance 0").status, 0);
  }
  /// Bytes of all journals of the study in `folder`.
  std::uintmax_t journal_bytes(const std::string& folder) const {
    std::uintmax_t bytes = 0;
    std::error_code ignored;
    for (auto entry = fs::recursive_directory_iterator(work_.folder() / folder, ignored);
         entry != fs::recursive_directory_iterator(); entry.increment(ignored))
      if (entry->path().extension() == ".journal") bytes += fs::file_size(entry->path(), ignored);
    return bytes;
  }
  /// The processes that run a task of this test.
  std::vector<pid_t> task_processes(const std::string& folder) const {
    std::vector<pid_t> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const std::string words = testing::read_file(entry.path() / "cmdline");
      if (words.find("--journal") != std::string::npos &&
          words.find((work_.folder() / folder).string()) != std::string::npos)
        found.push_back(std::stoi(name));
    }
    return found;
  }

  static inline std::unique_ptr<SlurmCluster> cluster_;
  Workplace work_;
};

TEST_F(Slurm, MakesTheSameBytesAsOneMachine) {
  const CommandResult result =
      work_.hookpoint("study study.hook --slurm --chunk 3 --array-limit 2 --out there");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("16 runs in 6 tasks"), std::string::npos) << result.err;
  expect_same("there");
  EXPECT_FALSE(fs::exists(work_.folder() / "there/cluster/00000")) << "what is merged goes away";
  // All is there now: nothing is submitted.
  const CommandResult again = work_.hookpoint("study study.hook --slurm --resume --out there");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.err.find("tasks"), std::string::npos) << again.err;
  expect_same("there");
}

TEST_F(Slurm, WhatWasMeasuredGoesAlong) {
  work_.file(
      "scene.hook",
      "Param height = 1 m;\nWorld world { gravity = 9.81; deltat = 1 ms; Robot ball { "
      "Base.mobile { location = 0, 0, height; mass = 1; inertia = 1, 1, 1, 0, 0, 0; } } }\n");
  work_.file("drops.csv", "drop,height [m]\na,1\nb,2\n");
  work_.file(
      "curves.csv",
      "drop,t [s],x [m],y [m],z [m],qw,qx,qy,qz\na,0.1,0,0,1,1,0,0,0\na,0.3,0,0,0.5,1,0,0,0\n"
      "b,0.1,0.1,0.2,2,0.8,0.6,0,0\nb,0.4355,0.1,0.3,1,0.8,0,0.6,0\n");
  work_.file(
      "drops.hook",
      "Study drops { scene = \"scene.hook\"; Cases drop { file = \"drops.csv\"; case = drop;\n"
      "  Trace place { file = \"curves.csv\"; column = x, y, z; time = \"t\"; of = "
      "ball.position; }\n"
      "  Trace turn { file = \"curves.csv\"; column = qw, qx, qy, qz; time = \"t\"; of = "
      "ball.orientation; } }\n"
      "  Subject ours { } Subject ode { engine = ode; } body = ball;\n"
      "  Measure off { trace = place; take = rms; } Measure turned { trace = turn; }\n"
      "  Measure self_error; }\n");
  ASSERT_EQ(work_.hookpoint("study drops.hook --out here").status, 0);
  const CommandResult result = work_.hookpoint("study drops.hook --slurm --chunk 3 --out away");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("4 runs in"), std::string::npos) << result.err;
  EXPECT_EQ(work_.read("away/results.csv"), work_.read("here/results.csv"));
}

TEST_F(Slurm, NamesAreNoCommands) {
  const std::string awkward = "it's a \"$(touch pwned)\" %j folder; \\x";
  fs::create_directory(work_.folder() / awkward);
  std::ofstream(work_.folder() / awkward / "study.hook") << fall_study;
  std::string quoted = std::regex_replace(awkward, std::regex("'"), "'\\''");
  const CommandResult result =
      work_.hookpoint("study '" + quoted + "/study.hook' --slurm --out '" + quoted + "/out'");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(work_.read(fs::path(awkward) / "out/results.csv"), work_.read("whole/results.csv"));
  for (const auto& entry : fs::recursive_directory_iterator(work_.folder()))
    EXPECT_NE(entry.path().filename(), "pwned");
}

TEST_F(Slurm, ATaskThatIsKilledIsSubmittedOnceMore) {
  ChildProcess front(work_.folder(),
                     {"study", "study.hook", "--slurm", "--chunk", "16", "--out", "killed"});
  ASSERT_TRUE(front.wait_until([&] { return journal_bytes("killed") > 0; })) << front.err();
  const auto tasks = task_processes("killed");
  EXPECT_FALSE(tasks.empty());
  for (const pid_t task : tasks) kill(task, SIGKILL);
  EXPECT_EQ(front.wait(), 0) << front.err();
  EXPECT_NE(front.err().find("submitted once more"), std::string::npos) << front.err();
  expect_same("killed");
}

TEST_F(Slurm, WhatADeadFrontEndLeftIsTakenUp) {
  {
    ChildProcess front(work_.folder(), {"study", "study.hook", "--slurm", "--chunk", "8",
                                        "--array-limit", "1", "--out", "dead"});
    ASSERT_TRUE(front.wait_until([&] { return journal_bytes("dead") > 0; })) << front.err();
    front.signal(SIGKILL);
    EXPECT_EQ(front.wait(), 1000 + SIGKILL);
  }
  const CommandResult resumed =
      work_.hookpoint("study study.hook --slurm --resume --chunk 8 --out dead");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("is still in Slurm's queue"), std::string::npos) << resumed.err;
  EXPECT_EQ(resumed.err.find("run again"), std::string::npos) << resumed.err;
  expect_same("dead");
}

TEST_F(Slurm, TheInterruptKeyLeavesTheQueueAndResumeNeedsNoSlurm) {
  ChildProcess front(work_.folder(),
                     {"study", "study.hook", "--slurm", "--chunk", "4", "--out", "cut"});
  ASSERT_TRUE(front.wait_until([&] { return journal_bytes("cut") > 0; })) << front.err();
  front.signal(SIGINT);
  EXPECT_EQ(front.wait(), 130) << front.err();
  EXPECT_NE(front.err().find("--resume waits for it, `scancel "), std::string::npos) << front.err();
  // On this machine, with what had come so far.
  const CommandResult resumed = work_.hookpoint("study study.hook --resume --out cut");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  expect_same("cut");
}

TEST_F(Slurm, ATaskThatFailsTwiceSaysWhy) {
  // The list is of another program than the one that makes it: here, of another identity.
  ASSERT_TRUE(cluster_->hold());
  ChildProcess front(work_.folder(), {"study", "study.hook", "--slurm", "--out", "wrong"});
  const fs::path list = work_.folder() / "wrong/cluster/00000/list_00000.json";
  ASSERT_TRUE(front.wait_until([&] { return fs::exists(list); }));
  std::string text = testing::read_file(list);
  text = std::regex_replace(text, std::regex("\"slope\",\\s*\"5 deg\""), "\"slope\", \"6 deg\"");
  work_.file("wrong/cluster/00000/list_00000.json", text);
  ASSERT_TRUE(cluster_->release());
  EXPECT_EQ(front.wait(), 1);
  EXPECT_NE(front.err().find("failed twice: "), std::string::npos) << front.err();
  EXPECT_NE(front.err().find("this is not the run that was requested"), std::string::npos)
      << front.err();
}

TEST_F(Slurm, ARefusalIsToldInItsOwnWords) {
  const CommandResult result =
      work_.hookpoint("study study.hook --slurm --partition nosuch --out refused");
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("invalid partition"), std::string::npos) << result.err;
}

/// A tuning with a scene, another ground under it, its Params and seeds.
constexpr const char* block_scene =
    "Param speed = 0.5 m/s;\n"
    "World world { Material own; Terrain.Flat ground { material = own; }\n"
    "  Robot block { Base.mobile { rest_on = ground; velocity = speed, 0, 0;\n"
    "    Shape.Box { dimensions = .2, .2, .1; mass = 1; } } } }\n";
constexpr const char* rough_ground =
    "Param seed = 1; Param normal_stiffness = 5 kN/m;\n"
    "Material soil { normal_stiffness = normal_stiffness; }\n"
    "Terrain.Rough ground { amplitude = 1 mm; wavelength = 0.3; seed = seed; size = 4, 4;\n"
    "  material = soil; }\n";
constexpr const char* block_tuning =
    "Tune soil { scene = \"block.hook\"; terrain = \"ground.hook\"; duration = 0.2 s;\n"
    "  Vary normal_stiffness { from = 1 kN/m; to = 100 kN/m; scale = log; }\n"
    "  Vary speed { from = 0.1; to = 1; }\n"
    "  Objective penetration_max { minimise; } Objective slip_distance { minimise; }\n"
    "  population = 8; generations = 2; seeds = 2; samples = 2; }\n";

TEST_F(Slurm, TunesWithTheSameBytesAsOneMachine) {
  work_.file("block.hook", block_scene);
  work_.file("ground.hook", rough_ground);
  work_.file("tune.hook", block_tuning);
  const CommandResult here = work_.hookpoint("tune tune.hook --jobs 2 --out here");
  ASSERT_EQ(here.status, 0) << here.err;
  const CommandResult there = work_.hookpoint("tune tune.hook --slurm --chunk 8 --out there");
  ASSERT_EQ(there.status, 0) << there.err;
  EXPECT_NE(there.err.find("16 runs in 2 tasks"), std::string::npos) << there.err;
  for (const char* name : {"evaluations.csv", "pareto.csv", "sobol.csv", "recommended.json"})
    EXPECT_EQ(work_.read(fs::path("there") / name), work_.read(fs::path("here") / name)) << name;
  EXPECT_FALSE(fs::exists(work_.folder() / "there/cluster/00000")) << "what is merged goes away";
}

TEST_F(Slurm, ATuningThatLostItsFrontEndGoesOn) {
  work_.file("block.hook", block_scene);
  work_.file("ground.hook", rough_ground);
  work_.file("tune.hook", block_tuning);
  ASSERT_EQ(work_.hookpoint("tune tune.hook --jobs 2 --out here").status, 0);
  {
    ChildProcess front(work_.folder(), {"tune", "tune.hook", "--slurm", "--out", "dead"});
    ASSERT_TRUE(front.wait_until([&] { return journal_bytes("dead") > 0; })) << front.err();
    front.signal(SIGKILL);
    EXPECT_EQ(front.wait(), 1000 + SIGKILL);
  }
  const CommandResult resumed = work_.hookpoint("tune tune.hook --slurm --resume --out dead");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  for (const char* name : {"evaluations.csv", "pareto.csv", "sobol.csv", "recommended.json"})
    EXPECT_EQ(work_.read(fs::path("dead") / name), work_.read(fs::path("here") / name)) << name;
}

class Script : public ::testing::Test {
 protected:
  Script() { work_.file("study.hook", fall_study); }
  Workplace work_;
};

TEST_F(Script, OfADryRunIsPrintedAndNothingElseIsDone) {
  const std::size_t before = work_.entries();
  const CommandResult result = work_.hookpoint(
      "study study.hook --slurm --dry-run --partition short,long --account lab --time 1-0:30 "
      "--chunk 5 --array-limit 2 --jobs 3 --out out");
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* line :
       {"#!/bin/bash\n", "#SBATCH --partition=short,long\n", "#SBATCH --account=lab\n",
        "#SBATCH --time=1-0:30\n", "#SBATCH --array=0-3%2\n", "#SBATCH --cpus-per-task=3\n",
        " runs \"$folder/list_$number.json\" --journal \"$folder/runs_$number.journal\" --jobs 3"})
    EXPECT_NE(result.out.find(line), std::string::npos) << line << '\n' << result.out;
  EXPECT_EQ(work_.entries(), before);
}

TEST_F(Script, OfATuningIsThatOfAGeneration) {
  work_.file("block.hook", block_scene);
  work_.file("ground.hook", rough_ground);
  work_.file("tune.hook", block_tuning);
  const std::size_t before = work_.entries();
  const CommandResult result =
      work_.hookpoint("tune tune.hook --slurm --dry-run --chunk 5 --out out");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("#SBATCH --array=0-3\n"), std::string::npos) << result.out;
  EXPECT_EQ(work_.entries(), before);
}

TEST_F(Script, WhatIsNoNameIsRefused) {
  for (const char* option : {"--partition 'a b'", "--partition '$(id)'", "--account 'a;b'",
                             "--time \"1\n#SBATCH --uid=0\"", "--chunk 0", "--array-limit x"}) {
    const CommandResult result =
        work_.hookpoint(std::string("study study.hook --slurm --dry-run ") + option);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_EQ(result.out, "") << option;
  }
  EXPECT_EQ(work_.hookpoint("study study.hook --partition a").status, 2) << "without --slurm";
}

TEST_F(Script, WithoutSlurmThePackageIsNamed) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", work_.folder().c_str(), 1);
  const CommandResult result = work_.hookpoint("study study.hook --slurm --out out");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("slurm-client"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(work_.folder() / "out"));
}

}  // namespace
}  // namespace hookpoint
