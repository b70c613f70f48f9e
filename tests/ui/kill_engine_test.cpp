// An engine's program that is killed at any moment of a study: the study ends and says why, and resumed
// it has the bytes of one that was not disturbed.
// ctest: long, released
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/kills.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::Workplace;

constexpr const char* study = R"(Study fall {
  scene = "run.hook"; settle = 0.05 s; duration = 0.45 s;
  Subject mine { engine = particle; }
  Sweep height { from = 0.1 m; to = 0.16 m; step = 0.01 m; }
  Measure penetration_max;
}
)";
constexpr const char* scene = R"(Param height = 0.1 m;
World w {
  gravity = 9.81; deltat = 1 ms; duration = 0.5 s;
  Material felt { normal_stiffness = 20 kN/m; normal_damping = 100; }
  Terrain.Flat ground { material = felt; }
  Robot ball { Base.mobile { location = 0, 0, height / 1 m; mass = 1 kg; Shape.Sphere { radius = 0.1; } } }
}
)";

// The moments are drawn over the time that a whole run takes; which they are decides nothing.
TEST(KilledEngine, AtAnyMomentItsStudyEndsAndCanBeResumed) {
  const Workplace work;
  work.file("study.hook", study);
  work.file("run.hook", scene);
  std::filesystem::create_directory(work.folder() / "engines");
  work.file("engines/particle.hook", "Engine particle { command = \"python3\", \"" +
                                         testing::source_folder() +
                                         "/examples/engines/particle.py\"; }\n");
  const std::string command = "study study.hook --jobs 2 --allow-engines --out ";
  const auto begin = std::chrono::steady_clock::now();
  const auto whole = work.hookpoint(command + "whole");
  ASSERT_EQ(whole.status, 0) << whole.err;
  const auto whole_time = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - begin);
  const std::string expected = work.read("whole/results.csv");
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> moment(0, whole_time.count());
  int kills = 0;
  for (int tried = 0; kills < testing::wanted_kills() && tried < 5 * testing::wanted_kills();
       ++tried) {
    std::filesystem::remove_all(work.folder() / "cut");
    ChildProcess child(work.folder(),
                       {"study", "study.hook", "--jobs", "2", "--allow-engines", "--out", "cut"});
    std::this_thread::sleep_for(std::chrono::microseconds(moment(random)));
    const std::vector<pid_t> engines = child.children();
    for (const pid_t engine : engines) kill(engine, SIGKILL);
    kills += engines.empty() ? 0 : 1;
    const int status = child.wait();
    ASSERT_LE(status, 3) << child.err();
    const bool finished = std::filesystem::exists(work.folder() / "cut/results.csv");
    if (status == 0 && work.read("cut/results.csv") == expected) continue;  // nothing was lost
    const std::string said = child.err() + (finished ? work.read("cut/results.csv") : "");
    ASSERT_NE(said.find("has ended (signal 9)"), std::string::npos) << status << said;
    const auto resumed = work.hookpoint(command + "cut --resume");
    ASSERT_EQ(resumed.status, 0) << resumed.err << said;
    ASSERT_EQ(work.read("cut/results.csv"), expected) << said;
  }
  EXPECT_GE(kills, testing::wanted_kills());
}

}  // namespace
}  // namespace hookpoint
