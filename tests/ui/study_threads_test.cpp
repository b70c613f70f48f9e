// A study of real engines in several threads leaves the bytes that one thread leaves. The preset
// `tsan` watches the threads meanwhile (a race ends the program with its own exit status).
// ctest: threads
#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::Workplace;

constexpr const char* study = R"(
Study threads {
  scene = "scenes/sloped_block.hook";
  duration = 0.2 s;
  settle = 0.1 s;
  Sweep slope { values = 10 deg, 20 deg; }
  Sweep dt { values = 1 ms, 2 ms; }
  Measure creep_speed;
  Measure penetration_mean;
  Measure impacts;
  Subject hook { engine = dts; contact = hookpoint; }
  Subject impulse { engine = dts; contact = impulse; }
  Subject adaptive { engine = dts; contact = hookpoint; integrator = cvode_bdf; }
  Subject ode { engine = ode; settings = matched; }
  Subject bullet { engine = bullet; settings = matched; }
  Plot paths { x = time; y = displacement; Only slope { values = 10 deg; } }
}
)";

TEST(StudyThreads, ManyLeaveTheBytesOfOne) {
  const Workplace work;
  work.file("threads.hook", study);
  for (const char* jobs : {"1", "4"}) {
    const std::string arguments =
        std::string("study threads.hook --jobs ") + jobs + " --out with_" + jobs;
    const auto result = work.hookpoint(arguments);
    ASSERT_EQ(result.status, 0) << arguments << '\n' << result.out << result.err;
  }
  const std::string one = work.read("with_1/results.csv");
  ASSERT_NE(one.find("bullet"), std::string::npos);
  EXPECT_EQ(work.read("with_4/results.csv"), one);
}

}  // namespace
}  // namespace hookpoint
